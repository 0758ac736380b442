"""Runs in processes of their own that a signal or a full disk interrupts, and what is left of their memory."""

import ctypes
import mmap
import os
import resource
import signal
import sys
import traceback
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from unittest import mock

from host_sim.cli.main import main
from host_sim.lab.campaign.host_events import before_each_instruction
from host_sim.recording.memory_file import MemorySaver

BEFORE = bytes([0, 0, 0, 0, 0, 0, 0, 2])
"""What the memory files hold at first."""

_WORDS = ("run", "--environments", "1", "--limit-s", "25", "--seed", "12", "--bus", "none", "--quiet")

Interruption = Callable[[], None]
Save = Callable[..., None]


class Witness(ctypes.Structure):
    """What a run was about to save, in memory that outlives its process.

    Attributes:
        saves: Number of different memories that were to be saved, one after the other.
        instructions: Number of Python instructions of a run to which nothing happens.
        saving: Number of those that saved a memory.
        is_saving: Whether a memory is being saved.
    """

    _Eight = ctypes.c_ubyte * 8
    _Number = ctypes.c_uint64
    _fields_ = (
        *(("_last", _Eight), ("_saved", _Eight)),
        *(("saves", _Number), ("instructions", _Number), ("saving", _Number)),
    )
    is_saving = False

    def __new__(cls) -> "Witness":
        return cls.from_buffer(mmap.mmap(-1, mmap.PAGESIZE))

    def __init__(self) -> None:
        self._last[:] = self._saved[:] = BEFORE

    def watch(self, save: Save) -> Save:
        """`MemorySaver.save`, watched."""

        def watched(saver: MemorySaver, memory: Sequence[int], *, doubtful: bool = False) -> None:
            self.saves += bytes(memory) != self.last
            self._last[:] = memory
            self.is_saving = self.last != self.saved
            save(saver, memory, doubtful=doubtful)
            self.is_saving = False
            self._saved[:] = memory

        return watched

    @property
    def last(self) -> bytes:
        """What was to be saved last."""
        return bytes(self._last)

    @property
    def saved(self) -> bytes:
        """What was saved last for certain: the last one, or the one before it."""
        return bytes(self._saved)


@dataclass(frozen=True)
class Outcome:
    """How a run ended, and what it left.

    Attributes:
        status: As `os.waitstatus_to_exitcode` has it.
        memory: What is in its memory file, or in the doubtful one beside it if the run has left one.
        errors: What it printed to stderr.
        witness: What it was about to save.
    """

    status: int
    memory: bytes
    errors: str
    witness: Witness

    @property
    def is_kept(self) -> bool:
        """Whether what was learned last is in the file, whole."""
        return self.memory in (self.witness.last, self.witness.saved)

    @property
    def is_orderly(self) -> bool:
        """Whether the run said in at most one line what was wrong, and in another one that its memory is doubtful."""
        lines = [line for line in self.errors.splitlines() if "the run is doubtful: its memory is in" not in line]
        return len(lines) <= 1 and "Traceback" not in self.errors


def at_instruction(number: int, signal_number: int, witness: Witness, *, only_saving: bool = False) -> Interruption:
    """A signal of the process to itself at one of its own Python instructions, counted from its beginning.

    Args:
        number: Number of the instruction, from 1; 0 for none.
        signal_number: The signal.
        witness: Told how many instructions there are.
        only_saving: Whether only those count that save a memory.
    """
    counts = {False: 0, True: 0}

    def count() -> None:
        counts[False] += 1
        counts[True] += witness.is_saving
        if counts[only_saving] == number and (witness.is_saving or not only_saving):
            os.kill(os.getpid(), signal_number)
        elif not number:
            witness.instructions, witness.saving = counts.values()

    return lambda: before_each_instruction(count)


def with_full_disk(size: int) -> Interruption:
    """No file can grow beyond a size: as if the disk were full."""
    return lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, resource.RLIM_INFINITY))


def run_interrupted(folder: Path, interruption: Interruption, witness: Witness, *words: str) -> Outcome:
    """Does a run in a process of its own, which begins with what interrupts it."""
    memory, doubtful = folder / "robot.mem", folder / "robot.mem.doubtful"
    memory.write_bytes(BEFORE)
    doubtful.unlink(missing_ok=True)
    errors, said = os.pipe()
    child = os.fork()
    if child == 0:
        os.dup2(said, 2)
        _run_child(folder, interruption, witness, words)
    os.close(said)
    with os.fdopen(errors) as pipe:
        text = pipe.read()
    _, status = os.waitpid(child, 0)
    left = doubtful if doubtful.exists() else memory
    return Outcome(os.waitstatus_to_exitcode(status), left.read_bytes(), text, witness)


def _run_child(folder: Path, interruption: Interruption, witness: Witness, words: Sequence[str]) -> None:
    """The process of the run; it does not return."""
    code = 70
    try:
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            signal.signal(number, signal.SIG_DFL if number != signal.SIGINT else signal.default_int_handler)
        with (
            mock.patch.object(MemorySaver, "save", witness.watch(MemorySaver.save)),
            mock.patch("host_sim.report.picture.write_picture", lambda path, _: path.touch()),
        ):
            interruption()
            code = main([*_WORDS, "--out", f"{folder}/out", "--memory", f"{folder}/robot.mem", *words])
            sys.settrace(None)
    except BaseException:
        sys.settrace(None)
        traceback.print_exc()
    finally:
        sys.stderr.flush()
        os._exit(code)
