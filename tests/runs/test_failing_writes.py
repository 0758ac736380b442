"""Short runs in which one write of a file fails, once: each is told, and what was written before stays whole."""

import errno
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

from host_sim.recording.memory_file import MemorySaver
from tests.runs.support import Ended, octet

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
def test_whichever_write_fails_the_run_says_so_and_loses_nothing(clean, tmp_path, number):
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


def test_a_write_whose_failure_is_not_told_is_found(clean, tmp_path, monkeypatch):
    monkeypatch.setattr(
        "host_sim.recording.memory_file.write_bytes", lambda path, content: path.write_bytes(content[:4])
    )
    disk = Disk(tmp_path)

    run_on(disk, tmp_path)

    assert lost(tmp_path, disk, clean[1]) == ["the memory"]
