"""Logs that are compressed, cut off, of another protocol, or none."""

import errno
import gzip
import io
import json
import os
import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from unittest import mock

import pytest

from host_sim.client.frame_log import FrameLog
from host_sim.protocol.codec import crc8
from host_sim.recording.log_reader import read_log
from host_sim.recording.memory_file import MemorySaver
from host_sim.recording.resimulation import resimulate
from tests.runs.endurance.interrupted_runs import Witness, run_interrupted, with_full_disk
from tests.runs.support import Ended, octet, start_octet, wait_until

SHORT = ("--environments", "1", "--limit-s", "20", "--bus", "none", "--quiet")
FILES = {"run.world.json", "summary.json", "arena.png", "replay.html"}
KEPT_BACK = 1 << 16


@pytest.fixture(scope="module")
def plain(tmp_path_factory) -> Path:
    out = tmp_path_factory.mktemp("plain")
    assert octet("run", *SHORT, "--out", out).returncode == 0
    return out


def test_compressed_log_has_the_same_lines_and_digest(plain, tmp_path):
    assert octet("run", *SHORT, "--compress-log", "--out", tmp_path).returncode == 0

    digests = {json.loads((out / "summary.json").read_text())["log_sha256"] for out in (plain, tmp_path)}
    assert {path.name for path in tmp_path.iterdir()} == {"run.log.gz", *FILES}
    assert gzip.decompress((tmp_path / "run.log.gz").read_bytes()) == (plain / "run.log").read_bytes()
    assert len(digests) == 1
    assert octet("replay", tmp_path / "run.log.gz").returncode == 0


def test_compressed_log_replaces_a_plain_one_and_vice_versa(tmp_path):
    for words, name in (((), "run.log"), (("--compress-log",), "run.log.gz"), ((), "run.log")):
        done = octet("run", *SHORT[:-1], *words, "--out", tmp_path)

        assert {path.name for path in tmp_path.iterdir()} == {name, *FILES}
        assert f"{tmp_path / name}\n" in done.stdout
    assert f"replaced  the run in {tmp_path} (seed 1), which" in done.stdout


def test_truncated_compressed_log_is_read_up_to_the_cut(plain, tmp_path):
    text, cut = (plain / "run.log").read_bytes(), tmp_path / "run.log.gz"
    log = FrameLog(cut)
    for line in text.splitlines(keepends=True):
        log.add_block(line)
    log.close()
    whole, frames = cut.read_bytes(), list(read_log(plain / "run.log"))
    for size in range(200, len(whole), len(whole) // 25):
        cut.write_bytes(whole[:size])

        read = list(read_log(cut))

        assert frames[: len(read)] == read
        assert len(read) > 0


def test_killed_run_keeps_all_but_the_last_64_kb_of_its_log(tmp_path):
    part = tmp_path / "run.log.gz.part"
    long = ("--environments", "30", "--bus", "fd", "--quiet")
    process = start_octet("run", *long, "--compress-log", "--out", tmp_path)
    wait_until(lambda: part.exists() and part.stat().st_size > KEPT_BACK, f"64 kB in {part}")

    process.kill()
    process.communicate()

    replayed = octet("replay", part)
    assert replayed.returncode == 0, replayed.stderr
    assert "; the log ends before the run does" in replayed.stdout
    assert resimulate(part, ignore_world=True).trajectory.ticks > 1000


@pytest.mark.parametrize("size", [3000, 30_000])
def test_run_on_a_full_disk_ends_in_order_and_leaves_a_readable_log(tmp_path, size):
    witness = Witness()

    outcome = run_interrupted(tmp_path, with_full_disk(size), witness, "--compress-log")

    part = tmp_path / "out/run.log.gz.part"
    assert (outcome.status, outcome.is_orderly) == (1, True), outcome.errors
    assert part.stat().st_size == size
    assert sum(1 for _ in read_log(part)) > size // 40


NO_LOGS = {
    "missing": None,
    "empty": b"",
    "binary": bytes(range(256)),
    "something else": b"hello\n",
    "without a heartbeat": b"(0000000000.000000) octet 0C1#9100000000000000\n",
}


@pytest.mark.parametrize("content", NO_LOGS.values(), ids=NO_LOGS.keys())
def test_replay_of_an_invalid_log_says_so_in_one_line(tmp_path, content):
    log = tmp_path / "run.log"
    if content is not None:
        log.write_bytes(content)

    done = octet("replay", log)

    assert done.returncode == 2
    assert done.stderr.startswith("octet: ")
    assert done.stderr.count("\n") == 1
    assert str(log) in done.stderr


def test_replay_of_several_robots_names_each(run):
    done = run("--environments", "1", "--bus", "none", "--limit-s", "2", "--robots", "2", "--node", "3")

    replayed = octet("replay", done.out / "run.log", "--node", "3")

    log = done.out / "run.log"
    assert replayed.stdout == "".join(f"{log}, node {node}: 100 drives, no difference\n" for node in (3, 4))


@pytest.mark.parametrize("cut_off", [1, 7, 30, 50, 70, 90, 110])
def test_truncated_log_is_compared_up_to_the_cut(run, tmp_path, cut_off):
    done = run("--environments", "1", "--bus", "none", "--limit-s", "2")
    cut = tmp_path / "cut.log"
    cut.write_bytes(done.log[: len(done.log) // 2 - cut_off])

    replayed = octet("replay", cut)

    assert (replayed.returncode, replayed.stderr) == (0, "")
    assert "no difference; the log ends before the run does" in replayed.stdout
    page = octet("replay", cut, "--html", tmp_path / "cut.html")
    assert page.returncode == 0
    assert page.stderr == f"octet: {cut} ends before the run does; showing what it has\n"


def with_another_layout(line: str) -> str:
    """A heartbeat of a robot whose messages lie elsewhere."""
    head, data = line.rstrip("\n").split("#")
    frame_id, content = int(head[-3:], 16), bytes.fromhex(data)[:-2] + bytes(2)
    return f"{head}#{crc8(frame_id, content):02X}{content[1:].hex().upper()}\n"


def test_log_of_another_protocol_is_refused(run, tmp_path):
    done = run("--environments", "1", "--bus", "none", "--limit-s", "2")
    other = tmp_path / "other.log"
    lines = done.log.decode().splitlines(keepends=True)
    other.write_text("".join(with_another_layout(line) if " 6A1#" in line else line for line in lines))

    replayed = octet("replay", other)

    assert replayed.returncode == 2
    assert "another octet.dbc" in replayed.stderr


BEFORE = bytes([0, 0, 0, 0, 0, 0, 0, 2])
WORDS = ("run", "--bus", "none", "--environments", "1", "--limit-s", "15", "--seed", "12", "--fault", "drop:1%")


class Disk:
    """Counts the writes, syncs and replacements of files in a folder; one of them fails.

    Attributes:
        done: How many there were.
        memories: What was to be saved, one after the other.
    """

    def __init__(self, folder: Path, failing: int = 0, number: int = errno.ENOSPC) -> None:
        self._folder, self._failing, self._number = os.fspath(folder), failing, number
        self.done, self.memories = 0, [BEFORE]

    def count(self) -> None:
        """Counts one, or lets it fail."""
        self.done += 1
        if self.done == self._failing:
            raise OSError(self._number, os.strerror(self._number))

    def open(self, file: Any, mode: str = "r", *words: Any, **named: Any) -> Any:
        """As `open`, for files that are written whole."""
        there = not isinstance(file, int) and os.fspath(file).startswith(self._folder)
        if not there or "w" not in mode:
            return OPEN(file, mode, *words, **named)
        count = self.count

        class Raw(io.FileIO):
            def write(self, content: Any) -> int | None:
                count()
                return super().write(content)

        raw = io.BufferedWriter(Raw(file, "w", opener=named.get("opener")))
        return raw if "b" in mode else io.TextIOWrapper(raw, named.get("encoding"), newline=named.get("newline"))

    def counted(self, call: Callable[..., Any]) -> Callable[..., Any]:
        """A function that is counted before it is called."""

        def counted(*words: Any, **named: Any) -> Any:
            self.count()
            return call(*words, **named)

        return counted

    @contextmanager
    def watched(self) -> Iterator[None]:
        """Watches what this process writes, and each memory that is to be saved."""
        save = MemorySaver.save

        def noted(saver: MemorySaver, memory: Any, *, doubtful: bool = False) -> None:
            self.memories += [bytes(memory)] * (bytes(memory) != self.memories[-1])
            save(saver, memory, doubtful=doubtful)

        with (
            mock.patch("io.open", self.open),
            mock.patch("builtins.open", self.open),
            mock.patch("os.fsync", self.counted(os.fsync)),
            mock.patch("os.replace", self.counted(os.replace)),
            mock.patch.object(MemorySaver, "save", noted),
        ):
            yield


OPEN = open


def run_on(disk: Disk, folder: Path) -> Ended:
    (folder / "robot.mem").write_bytes(BEFORE)
    with disk.watched():
        return octet(*WORDS, "--out", folder / "out", "--memory", folder / "robot.mem")


@pytest.fixture(scope="module")
def clean(tmp_path_factory):
    folder = tmp_path_factory.mktemp("clean")
    disk = Disk(folder)
    assert run_on(disk, folder).returncode == 0
    return disk, (folder / "out/run.log").read_bytes()


def lost(folder: Path, disk: Disk, log: bytes) -> list[str]:
    """What is not as it must be after a write has failed."""
    out, memory = folder / "out", (folder / "robot.mem").read_bytes()
    parts = [path.read_bytes() for name in ("run.log", "run.log.part") if (path := out / name).exists()]
    summary = out / "summary.json"
    return [
        *["the memory"] * (memory not in disk.memories[-2:]),
        *["the log"] * (len(parts) != 1 or not log.startswith(parts[0])),
        *[path.name for path in folder.rglob(".*") if path.suffix != ".lock"],
        *["the summary"] * (summary.exists() and "memory" not in json.loads(summary.read_text())["robots"][0]),
    ]


@pytest.mark.parametrize("number", [errno.ENOSPC, errno.EIO])
def test_run_reports_any_failed_write_and_loses_nothing(clean, tmp_path, number):
    count, log = clean[0].done, clean[1]
    assert len(clean[0].memories) > 1
    assert count >= 20
    for failing in range(1, count + 1):
        folder = tmp_path / str(failing)
        folder.mkdir()
        disk = Disk(folder, failing, number)

        ended = run_on(disk, folder)

        told = rf"octet: cannot write {folder}/\S+: {os.strerror(number)}\n"
        assert (failing, ended.returncode, lost(folder, disk, log)) == (failing, 1, [])
        assert re.fullmatch(told, ended.stderr)


def test_silently_truncated_memory_is_found(clean, tmp_path, monkeypatch):
    monkeypatch.setattr(
        "host_sim.recording.memory_file.write_bytes", lambda path, content: path.write_bytes(content[:4])
    )
    disk = Disk(tmp_path)

    run_on(disk, tmp_path)

    assert lost(tmp_path, disk, clean[1]) == ["the memory"]
