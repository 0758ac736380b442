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
from pathlib import Path
from typing import Any
from unittest import mock

from host_sim.cli.main import main

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


def wait_for_lines(path: Path, count: int) -> None:
    """Waits until a run has recorded so many frames; the log of a run that goes on is beside the old one."""
    part = path.with_name(path.name + ".part")
    wait_until(lambda: part.exists() and part.read_bytes().count(b"\n") >= count, f"{count} frames in {part}")
