"""The files that a run writes, and the harm that this host can do to them."""

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
from host_sim.faults.event import Event
from host_sim.lab.campaign.killed import Tell, kill_at
from host_sim.lab.campaign.setup import Happen
from host_sim.protocol.codec import Protocol
from host_sim.recording.memory_file import MemorySaver, load_memory
from host_sim.world.memory_kinds import Memory

_NODE = 1
_OF_COURSE = tuple(f" {Protocol(_NODE).id_of(name):03X}#".encode() for name in ("SENSES", "DRIVE"))


class CourseLog(FrameLog):
    """A log that knows the course of its run, too."""

    def __init__(self, path: Path | None = None) -> None:
        """As in `FrameLog`."""
        self._course = hashlib.sha256()
        super().__init__(path)

    @property
    def course(self) -> str:
        """SHA-256 of the lines of the course that were written, in hexadecimal."""
        return self._course.hexdigest()

    def _write(self, block: bytes) -> None:
        for line in block.splitlines():
            if any(name in line for name in _OF_COURSE):
                self._course.update(line)
        super()._write(block)


_VERSION = 0x20080522
_WORDS = 6
_OVERRIDE = 1 << 1
"""CAP_DAC_OVERRIDE, by which permissions mean nothing to root."""


def obey_permissions(undo: ExitStack) -> None:
    """Has this thread obey the permissions of files, even as root.

    Args:
        undo: Takes it back.
    """
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
_MEMORY = "robot.mem"


def _ignore(*_: object) -> None:
    """The run is in no danger of being killed."""


class NoFiles:
    """A run that writes nothing: of its log there is only the digest.

    Attributes:
        log: The log.
        events: The harm that can be done to the files, by name.
        struck: Whether harm was done to them.
        told: What was said about them, in sentences.
        memory: What the memory file held before; None if there was none.
        note: Takes what is to be known of the run, whatever becomes of it.
    """

    memory: Memory | None = None
    note: Tell = staticmethod(_ignore)

    def __init__(self, log: CourseLog | None = None) -> None:
        """Nothing was written yet."""
        self.log = log or CourseLog()
        self.events: Mapping[str, Happen] = {}
        self.struck = False
        self.told: list[str] = []

    def save(self, memory: Sequence[int]) -> None:
        """Takes over the memory after a tick.

        Raises:
            OctetError: It cannot be saved.
        """

    def finish(self, memory: Sequence[int]) -> None:  # noqa: ARG002 - saved where there is a file
        """Takes over the memory at the end, and closes the log.

        Raises:
            OctetError: One of them cannot be written.
        """
        self.log.flush()
        self.log.close()

    def close(self) -> str:
        """Closes the log, however the run ended; the digest of what was handed over."""
        with suppress(OctetError):  # the run ended with it, or with something worse
            self.log.close()
        return self.log.close()

    def without_folder(self, text: str) -> str:
        """A message about a file, whatever the name of its folder."""
        return text

    def lost(self) -> str:
        """What is missing from the files without a warning, in words; empty if they hold all that was handed over."""
        return ""


class RunFiles(NoFiles):
    """A log and a memory file in a folder of their own, kept as `tools/run` keeps them."""

    def __init__(self, folder: Path, undo: ExitStack, tell: Tell = _ignore) -> None:
        """Begins to write.

        Args:
            folder: Holds nothing but the memory file of an earlier run.
            undo: Takes back the harm.
            tell: Told of each memory before it is saved, and of all that `note` gets.
        """
        self._folder, self._undo, self.note = folder, undo, tell
        self._log_path, self._memory_path = folder / "run.log", folder / _MEMORY
        super().__init__(CourseLog(self._log_path))
        self.events = {name: partial(self._strike, happen) for name, happen in _EVENTS.items()}
        self.memory = load_memory(self._memory_path)
        self._saver = MemorySaver(
            self._memory_path, self.memory, lambda line: self.told.append(self.without_folder(line))
        )
        self._saved = None if self.memory is None else bytes(self.memory)
        self._finished, self._killed_in_save = False, 0

    def save(self, memory: Sequence[int]) -> None:
        """As in `NoFiles`."""
        if bytes(memory) != self._saved:
            self.note("saving", bytes(memory).hex())
            if self._killed_in_save:
                kill_at(self._killed_in_save)
        self._saver.save(memory)
        self._saved = bytes(memory)

    def finish(self, memory: Sequence[int]) -> None:
        """As in `NoFiles`."""
        self._saver.finish(memory)
        self._saved = bytes(memory)
        super().finish(memory)
        self._finished = True

    def lost(self) -> str:
        """As in `NoFiles`."""
        if self._finished and _digest(self._log_path) != self.log.close():
            return "the log"
        held = self._memory_path.read_bytes() if self._memory_path.exists() else None
        is_gone = held is None and not self._finished  # a run that ends has said why
        return "" if is_gone or held == self._saved else "the memory"

    def without_folder(self, text: str) -> str:
        """As in `NoFiles`."""
        return text.replace(f"{self._folder}/", "")

    def _strike(self, happen: Callable[["RunFiles", int], None], size: int) -> None:
        self.struck = True
        happen(self, size)

    def fill_disk(self, room: int) -> None:
        """No file can grow any more: beyond a size in bytes, as far as it has not done so already."""
        soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
        self._undo.callback(resource.setrlimit, resource.RLIMIT_FSIZE, (soft, hard))
        resource.setrlimit(resource.RLIMIT_FSIZE, (room, hard))

    def forbid(self, _: int) -> None:
        """The folder becomes read-only, for root too."""
        self._undo.callback(self._folder.chmod, self._folder.stat().st_mode)
        self._folder.chmod(_READ_ONLY)
        obey_permissions(self._undo)

    def remove_folder(self, _: int) -> None:
        """The folder and all that is in it is removed."""
        shutil.rmtree(self._folder)

    def remove_log(self, _: int) -> None:
        """The log is removed while it is written."""
        self._log_path.with_name(self._log_path.name + ".part").unlink()

    def remove_memory(self, _: int) -> None:
        """The memory file is removed."""
        self._memory_path.unlink()

    def kill(self, number: int) -> None:
        """SIGKILL to this process at one of its next Python instructions."""
        kill_at(number)

    def kill_in_save(self, number: int) -> None:
        """SIGKILL to this process at one of the Python instructions that save the next memory."""
        self._killed_in_save = number


_EVENTS: Mapping[str, Callable[[RunFiles, int], None]] = {
    "disk-full": RunFiles.fill_disk,
    "read-only": RunFiles.forbid,
    "folder-gone": RunFiles.remove_folder,
    "log-gone": RunFiles.remove_log,
    "memory-gone": RunFiles.remove_memory,
    "kill-simulator": RunFiles.kill,
    "kill-saving": RunFiles.kill_in_save,
}

KILL_EVENTS = frozenset({"kill-simulator", "kill-saving"})
"""Those that end the process of the run."""

FILE_EVENTS = frozenset(_EVENTS)
"""The harm that can be done to the files of a run, by name."""


def make_folder(events: Iterable[Event], undo: ExitStack) -> Path | None:
    """An empty folder for the files of a run; None for a run in which nothing happens to files.

    Args:
        events: All that is to happen in the run.
        undo: Removes it.
    """
    if FILE_EVENTS.isdisjoint(event.name for event in events):
        return None
    folder = Path(undo.enter_context(TemporaryDirectory())) / "out"
    folder.mkdir()
    return folder


def open_files(folder: Path | None, undo: ExitStack, tell: Tell = _ignore) -> NoFiles:
    """The files of a run.

    Args:
        folder: As `make_folder` has it.
        undo: Takes back the harm, and closes the files.
        tell: As in `RunFiles`.
    """
    files = NoFiles() if folder is None else RunFiles(folder, undo, tell)
    undo.callback(files.close)
    return files


def is_memory_held(folder: Path | None, saved: Sequence[str]) -> bool:
    """Whether the memory file of a run that was killed is whole, and not older than it may be.

    Args:
        folder: The run's, as `make_folder` has it.
        saved: Each memory that it was about to save, in hexadecimal.
    """
    memory = None if folder is None else load_memory(folder / _MEMORY)
    held = "" if memory is None else bytes(memory).hex()
    return held in (["", *saved])[-2:]


def _digest(path: Path) -> str:
    return digest_of(path.read_bytes()) if path.exists() else ""
