"""The files that a run writes, and what can befall them on this host."""

import hashlib
import resource
import shutil
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import ExitStack, suppress
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

from host_sim.campaign.permissions import obey_permissions
from host_sim.campaign.setups import Happen
from host_sim.client.frame_log import FrameLog
from host_sim.errors import OctetError
from host_sim.faults.event import Event
from host_sim.recording.memory_file import MemorySaver

_READ_ONLY = 0o555


class NoFiles:
    """A run that writes nothing: of its log there is only the digest.

    Attributes:
        log: The log.
        events: What can befall the files, by name.
        struck: Whether something has befallen them.
        told: What was said about them, in sentences.
    """

    def __init__(self, log: FrameLog | None = None) -> None:
        """Nothing was written yet."""
        self.log = log or FrameLog()
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
        """What the files do not hold as it was handed over though nobody was told; empty if they hold all."""
        return ""


class RunFiles(NoFiles):
    """A log and a memory file in a folder of their own, kept as `tools/run` keeps them."""

    def __init__(self, folder: Path, undo: ExitStack) -> None:
        """Begins to write.

        Args:
            folder: An empty folder.
            undo: Takes back what befell the files.
        """
        self._folder, self._undo = folder, undo
        self._log_path, self._memory_path = folder / "run.log", folder / "robot.mem"
        super().__init__(FrameLog(self._log_path))
        self.events = {name: partial(self._strike, happen) for name, happen in _EVENTS.items()}
        self._saver = MemorySaver(self._memory_path, None, lambda line: self.told.append(self.without_folder(line)))
        self._saved: bytes | None = None
        self._finished = False

    def save(self, memory: Sequence[int]) -> None:
        """As in `NoFiles`."""
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


_EVENTS: Mapping[str, Callable[[RunFiles, int], None]] = {
    "disk-full": RunFiles.fill_disk,
    "read-only": RunFiles.forbid,
    "folder-gone": RunFiles.remove_folder,
    "log-gone": RunFiles.remove_log,
    "memory-gone": RunFiles.remove_memory,
}

FILE_EVENTS = frozenset(_EVENTS)
"""What can befall the files of a run, by name."""


def open_files(events: Iterable[Event], undo: ExitStack) -> NoFiles:
    """The files of a run: none, unless something is to befall them.

    Args:
        events: All that is to happen in the run.
        undo: Takes back what befell the files, closes them, and removes them.
    """
    if FILE_EVENTS.isdisjoint(event.name for event in events):
        files = NoFiles()
    else:
        folder = Path(undo.enter_context(TemporaryDirectory())) / "out"
        folder.mkdir()
        files = RunFiles(folder, undo)
    undo.callback(files.close)
    return files


def _digest(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest() if path.exists() else ""
