"""Whole runs, and what they leave behind."""

import base64
import contextlib
import io
import json
import os
import signal
import subprocess
import sys
import time
import zlib
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import zip_longest
from pathlib import Path
from typing import Any, NamedTuple
from unittest import mock

from host_sim.cli.main import main
from host_sim.client.frame_log import FrameLog
from host_sim.lab.bench.short_run import run_ticks
from host_sim.protocol.codec import COUNTERS, Frame, Protocol, counter_of
from host_sim.protocol.generated import Opcode
from host_sim.sim.access import BOARDS
from host_sim.sim.run_config import RunConfig

ROOT = Path(__file__).resolve().parents[2]
ROBOT = ROOT / "build/host/hal/port/posix/octet-robot"
DEADLINE_S = 600
BUSY_HOST = ("--gap-max-s", "60", "--unanswered-max", "100", "--late-max", "100")
"""What lets a run in real time be right on a host that has little time for it."""

Ended = subprocess.CompletedProcess[str]


@dataclass(frozen=True)
class Run:
    """One run that has ended."""

    code: int
    output: str
    errors: str
    out: Path

    @property
    def summary(self) -> dict:
        return json.loads((self.out / "summary.json").read_text())

    @property
    def memory(self) -> list[int]:
        """What the first robot remembered at the end."""
        return self.summary["robots"][0]["memory"]

    @property
    def log(self) -> bytes:
        return (self.out / "run.log").read_bytes()


def octet(*words: str | Path) -> Ended:
    """`tools/octet WORDS` by a call in this process, without what takes long to write: a hundred are to be cheap."""
    output, errors = io.StringIO(), io.StringIO()
    with (
        mock.patch("host_sim.report.picture.write_picture", lambda path, _: path.touch()),
        mock.patch("host_sim.cli.outputs.PAGE_WASM", Path(os.devnull) / "left out"),
        mock.patch("host_sim.cli.replay_command.PAGE_WASM", Path(os.devnull) / "left out"),
        mock.patch("os.execve", side_effect=AssertionError("`--bus auto` needs a process of its own")),
        contextlib.redirect_stdout(output),
        contextlib.redirect_stderr(errors),
    ):
        try:
            code = main([os.fspath(word) for word in words])
        except SystemExit as end:
            code = end.code
    return subprocess.CompletedProcess(words, code, output.getvalue(), errors.getvalue())


def octet_process(*words: str | Path, **kwargs) -> Ended:
    """`tools/octet WORDS` as a person starts it, without setting up anew."""
    command = [sys.executable, "-m", "host_sim", *map(os.fspath, words)]
    return subprocess.run(command, capture_output=True, text=True, check=False, **kwargs)


def data_in(html: str, name: str) -> Any:
    """The data in an element of a page."""
    text = unpacked(html).partition(f'<script type="application/json" id="{name}">')[2].partition("</script>")[0]
    return json.loads(text)


def unpacked(html: str) -> str:
    """What the one script of a page writes into it."""
    data = html.partition('const text = "')[2].partition('"')[0].replace(",", "<")
    return zlib.decompress(base64.b85decode(data)).decode() if data else html


def is_right(memory: Sequence[int]) -> bool:
    """Whether nothing wrong was learned: from what is on one side, the robot turns to the other."""
    right = {1: (0, 1), 3: (0, 1), 4: (0, 2), 6: (0, 2)}
    return all(memory[pattern] in sides for pattern, sides in right.items())


def assert_healthy(summary: dict) -> None:
    """Not a frame was lost or refused, and no robot counted a fault."""
    for robot in summary["robots"]:
        assert (robot["frames"]["lost"], robot["frames"]["refused"]) == (0, 0)
        assert set(robot["faults"].values()) == {0}


def start_octet(*words: str | Path) -> subprocess.Popen:
    """The same, going on in the background; the caller ends it."""
    command = [sys.executable, "-m", "host_sim", *map(os.fspath, words)]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


@contextlib.contextmanager
def robot_at(link: str, node: int = 1) -> Iterator[subprocess.Popen]:
    """A robot in a process of its own, which listens on a link."""
    with subprocess.Popen([os.fspath(ROBOT), "--node", str(node), link], stdout=subprocess.PIPE) as robot:
        try:
            assert b"listens" in robot.stdout.readline()
            yield robot
        finally:
            robot.kill()


def wait_until(is_so: Callable[[], object], what: str) -> None:
    """Waits for something to become true, in bounded time."""
    give_up = time.monotonic() + DEADLINE_S
    while not is_so():
        assert time.monotonic() < give_up, f"waited in vain: {what}"
        time.sleep(0.02)


def robot_of(process: subprocess.Popen) -> int:
    """The process of the robot that a run started."""
    children = Path(f"/proc/{process.pid}/task/{process.pid}/children")
    wait_until(lambda: process.poll() is not None or children.read_text(), "a robot")
    return int(children.read_text().split()[0])


@contextlib.contextmanager
def halted(process: subprocess.Popen) -> Iterator[None]:
    """Whatever is done meanwhile is done in the midst of the run, however slow the machine."""
    process.send_signal(signal.SIGSTOP)
    yield
    process.send_signal(signal.SIGCONT)


def wait_for_lines(process: subprocess.Popen, path: Path, count: int) -> None:
    """Waits until a run has recorded so many frames; the log of a run that goes on is beside the old one.

    Fails with what the run printed if it ends before.
    """
    part = path.with_name(path.name + ".part")

    def recorded() -> bool:
        return part.exists() and part.read_bytes().count(b"\n") >= count

    wait_until(lambda: recorded() or process.poll() is not None, f"{count} frames in {part}")
    assert process.poll() is None, "".join(process.communicate())


OPCODES = [opcode.name.lower() for opcode in Opcode]
SAID = {"stop": "somebody else stopped node 1"}
PACES = {"lockstep": ("--limit-s", "40"), "real time": ("--limit-s", "4", "--real-time")}


def next_command(protocol: Protocol, log: bytes, opcode: str) -> Frame:
    """What somebody who has heard the frames on the bus sends."""
    told = [bytes.fromhex(line.split(b"021#")[1].decode()) for line in log.splitlines() if b" 021#" in line][-1]
    counter = (counter_of(Frame(protocol.id_of("COMMAND"), told)) + 1) % COUNTERS
    any_content = {"profile": 1, "lockstep": 1, "seed": 9, "parameter": 0, "value": 90, "half": 1, "mask": 15}
    any_content |= {"byte_0": 1, "byte_1": 2, "byte_2": 1, "byte_3": 2, "freeze": 1, "wanted": 1}
    signals = {"counter": counter, "opcode": Opcode[opcode.upper()], "owner": told[2]}
    return protocol.encode("COMMAND", {**any_content, **signals})


def forge_on_vcan(out: Path, pace: str, opcode: str) -> None:
    """Forges a command in the midst of a run on vcan0, which has to say so."""
    listening = subprocess.Popen(["candump", "-L", "-n", "200", "vcan0"], stdout=subprocess.PIPE)
    words = ("--environments", "1", *PACES[pace], "--quiet", "--bus", "socketcan:vcan0")
    process = start_octet("run", "--out", out, *words)
    heard, _ = listening.communicate(timeout=DEADLINE_S)

    with halted(process):
        frame = next_command(Protocol(), heard, opcode)
        subprocess.run(["cansend", "vcan0", f"{frame.id:03X}#{frame.data.hex()}"], check=True)

    _, errors = process.communicate(timeout=DEADLINE_S)
    assert process.returncode == 1
    assert SAID.get(opcode, "somebody else commands the robot") in errors


REFERENCE = "host"
"""The firmware built for the host, in this process: the reference for the images."""

IMAGES = ("qemu", *BOARDS)
"""The machines on which the flash images run."""


class Verdict(NamedTuple):
    """The comparison of one run with the reference.

    Attributes:
        seed: The run's seed.
        where: One of `IMAGES`.
        difference: The first line that differs, as text; None if all frames are the same.
    """

    seed: int
    where: str
    difference: str | None


def record(where: str, seed: int, ticks: int, log: Path, profile: str = "article") -> None:
    """Records the frames of a run on the `REFERENCE`, or on one of the `IMAGES`.

    Raises:
        OctetError: The robot cannot be started there, or it fails.
    """
    robots = {REFERENCE: "spawn", **dict.fromkeys(BOARDS, "emulated")}
    board = where if where in BOARDS else ""
    config = RunConfig(seed=seed, profile=profile, robot=robots.get(where, where), board=board)
    run_ticks(config, ticks, FrameLog(log))


def first_difference(reference: Path, other: Path) -> str | None:
    """The first line in which two logs differ; None if there is none."""
    if reference.read_bytes() == other.read_bytes():
        return None
    lines = (path.read_text(encoding="ascii").splitlines() for path in (reference, other))
    for number, (ours, theirs) in enumerate(zip_longest(*lines, fillvalue="(end)"), start=1):
        if ours != theirs:
            return f"line {number}: {ours} on the {REFERENCE}, {theirs} in {other.name}"
    return "only the ends of lines differ"


def compare(seeds: Sequence[int], ticks: int, folder: Path, images: Sequence[str] = IMAGES) -> Iterator[Verdict]:
    """Compares runs on the host and on images; yields a verdict for each seed and image.

    The logs of the reference, and of runs that differ, stay in the folder.

    Raises:
        OctetError: As for `record`.
    """
    for seed in seeds:
        reference = folder / f"{REFERENCE}-{seed}.log"
        record(REFERENCE, seed, ticks, reference)
        for where in images:
            log = folder / f"{where}-{seed}.log"
            record(where, seed, ticks, log)
            verdict = Verdict(seed, where, first_difference(reference, log))
            if verdict.difference is None:
                log.unlink()
            yield verdict
