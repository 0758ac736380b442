"""The files that a run writes, and the faults of this host that affect them."""

import ctypes
import hashlib
import resource
import shutil
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import ExitStack, suppress
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

from host_sim.base.errors import OctetError
from host_sim.client.frame_log import FrameLog, digest_of
from host_sim.lab.campaign.host_events import Report, Trigger, kill_at
from host_sim.protocol.codec import Protocol
from host_sim.recording.memory_file import MemorySaver, load_memory
from host_sim.transport.rule import Event
from host_sim.world.memory_kinds import Memory

_NODE = 1
_COURSE_MARK = f" {Protocol(_NODE).id_of('SENSES'):03X}#".encode()


class CourseLog(FrameLog):
    """A log that also computes the course of its run."""

    def __init__(self, path: Path | None = None) -> None:
        self._course = hashlib.sha256()
        super().__init__(path)

    @property
    def course(self) -> str:
        """SHA-256 of the written lines of the course, in hexadecimal."""
        return self._course.hexdigest()

    def _write(self, block: bytes) -> None:
        for line in block.splitlines():
            if _COURSE_MARK in line:
                self._course.update(line)
        super()._write(block)


_VERSION = 0x20080522
_WORDS = 6
_OVERRIDE = 1 << 1
"""CAP_DAC_OVERRIDE, which exempts root from permissions."""


def obey_permissions(undo: ExitStack) -> None:
    """Makes this thread obey file permissions, even as root, until `undo` is closed."""
    header, data = (ctypes.c_uint32 * 2)(_VERSION, 0), (ctypes.c_uint32 * _WORDS)()
    libc = ctypes.CDLL(None, use_errno=True)
    _check(libc.capget(header, data))
    before = (ctypes.c_uint32 * _WORDS)(*data)
    data[0] &= ~_OVERRIDE
    _check(libc.capset(header, data))
    undo.callback(libc.capset, header, before)


def _check(result: int) -> None:
    if result:
        raise OSError(ctypes.get_errno(), "cannot set the capabilities of this process")


_READ_ONLY = 0o555
_LOG, _MEMORY = "run.log", "robot.mem"


def _ignore(*_: object) -> None:
    """Discards reports, for a run that is not killed."""


class RunFiles:
    """A log and a memory file in a folder of their own, kept as `tools/run` keeps them; or only the log's digest.

    Attributes:
        folder: The folder; None for a run that writes no files.
        log: The log.
        events: File faults by name.
        struck: Whether a file fault was applied.
        messages: Messages about the files, in sentences.
        memory: The previous content of the memory file; None if there was none.
        note: Takes reports of the run that must survive its end.
        killed_in_save: Number of the Python instruction of the next save at which this process is killed; 0 for none.
    """

    def __init__(self, folder: Path | None, undo: ExitStack, report: Report = _ignore) -> None:
        """Opens the files.

        Args:
            folder: A folder with nothing but the memory file of an earlier run, as returned by `make_folder`.
            undo: Closes the files, and reverts their faults.
            report: Called with each memory before it is saved, and with everything passed to `note`.
        """
        self.folder, self._undo, self.note = folder, undo, report
        self.log = CourseLog(folder and folder / _LOG)
        self.events: Mapping[str, Trigger] = {}
        self.struck, self.messages, self.killed_in_save = False, list[str](), 0
        self.memory: Memory | None = None
        self._saver: MemorySaver | None = None
        self._finished = False
        if folder:
            self.events = {name: partial(self._strike, fault, folder) for name, fault in _EVENTS.items()}
            self.memory = load_memory(folder / _MEMORY)
            self._saver = MemorySaver(
                folder / _MEMORY, self.memory, lambda line: self.messages.append(self.without_folder(line))
            )
        self._saved = None if self.memory is None else bytes(self.memory)
        undo.callback(self.close)

    def save(self, memory: Sequence[int]) -> None:
        """Takes over the memory after a tick.

        Raises:
            OctetError: The memory cannot be saved.
        """
        if not self._saver:
            return
        if bytes(memory) != self._saved:
            self.note("saving", bytes(memory).hex())
            if self.killed_in_save:
                kill_at(self.killed_in_save)
        self._saver.save(memory)
        self._saved = bytes(memory)

    def finish(self, memory: Sequence[int]) -> None:
        """Takes over the memory at the end, and closes the log.

        Raises:
            OctetError: Memory or log cannot be written.
        """
        if self._saver:
            self._saver.finish(memory)
            self._saved = bytes(memory)
        self.log.flush()
        self.log.close()
        self._finished = True

    def close(self) -> str:
        """Closes the log, however the run ended. Returns the digest of the frames handed over."""
        with suppress(OctetError):  # the run ended with this error, or with a worse one
            self.log.close()
        return self.log.close()

    def lost(self) -> str:
        """Data missing from the files without a warning, in words; empty if they are complete."""
        if not self.folder:
            return ""
        log, memory = self.folder / _LOG, self.folder / _MEMORY
        if self._finished and (not log.exists() or digest_of(log.read_bytes()) != self.log.close()):
            return "the log"
        held = memory.read_bytes() if memory.exists() else None
        is_gone = held is None and not self._finished  # a run that ended early has given the reason
        return "" if is_gone or held == self._saved else "the memory"

    def without_folder(self, text: str) -> str:
        """Removes the folder's name from a message about a file."""
        return text.replace(f"{self.folder}/", "")

    def _strike(self, fault: "_Fault", folder: Path, size: int) -> None:
        self.struck = True
        fault(self, folder, size)

    def fill_disk(self, _: Path, room: int) -> None:
        """Limits file sizes, in bytes, so that no file can grow beyond the limit."""
        soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
        self._undo.callback(resource.setrlimit, resource.RLIMIT_FSIZE, (soft, hard))
        resource.setrlimit(resource.RLIMIT_FSIZE, (room, hard))

    def forbid(self, folder: Path, _: int) -> None:
        """Makes the folder read-only, for root too."""
        self._undo.callback(folder.chmod, folder.stat().st_mode)
        folder.chmod(_READ_ONLY)
        obey_permissions(self._undo)


_Fault = Callable[[RunFiles, Path, int], object]

_EVENTS: Mapping[str, _Fault] = {
    "disk-full": RunFiles.fill_disk,
    "read-only": RunFiles.forbid,
    "folder-gone": lambda _, folder, __: shutil.rmtree(folder),
    "log-gone": lambda _, folder, __: (folder / f"{_LOG}.part").unlink(),
    "memory-gone": lambda _, folder, __: (folder / _MEMORY).unlink(),
    "kill-simulator": lambda _, __, number: kill_at(number),
    "kill-saving": lambda files, _, number: setattr(files, "killed_in_save", number),
}

FILE_EVENTS = frozenset(_EVENTS)
"""The faults that can affect a run's files, by name."""


def make_folder(events: Iterable[Event], undo: ExitStack) -> Path | None:
    """Creates a folder for the files of a run, which `undo` removes; None for a run without file faults."""
    if FILE_EVENTS.isdisjoint(event.name for event in events):
        return None
    folder = Path(undo.enter_context(TemporaryDirectory())) / "out"
    folder.mkdir()
    return folder


def is_memory_held(folder: Path | None, saved: Sequence[str]) -> bool:
    """Whether the memory file of a killed run is complete, and not older than permitted.

    Args:
        folder: The run's folder, as returned by `make_folder`.
        saved: Each memory that the run was about to save, in hexadecimal.
    """
    memory = None if folder is None else load_memory(folder / _MEMORY)
    held = "" if memory is None else bytes(memory).hex()
    return held in (["", *saved])[-2:]
