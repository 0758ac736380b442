"""Memory files, exactly eight bytes, cell 0 first, and their locks: only one run at a time learns into one."""

import os
import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from host_sim.base.errors import UsageError
from host_sim.base.files import lock, read_bytes, write_bytes
from host_sim.base.system import NO_LINK, NO_WAIT
from host_sim.protocol.generated import CELL_COUNT
from host_sim.world.memory_kinds import Memory, kinds_of, sides_of

_SIZE_MAX = 1 << 20
"""Larger files are not read."""


def load_memory(path: Path) -> tuple[int, ...] | None:
    """The memory in a file, or None if the file does not exist.

    Raises:
        UsageError: The file cannot be read, or is not a memory file.
    """
    try:
        content = read_bytes(path, _SIZE_MAX)
    except FileNotFoundError:
        return None
    if len(content) != CELL_COUNT:
        raise UsageError(f"{path} is not a memory file: {len(content)} bytes, expected {CELL_COUNT} (file unchanged)")
    if not kinds_of(tuple(content)):
        raise UsageError(f"{path} is not a memory file: no behaviour writes {content.hex(' ')} (file unchanged)")
    return tuple(content)


def check_writable(path: Path) -> None:
    """Checks that a memory file can be written, so that nothing learned is lost.

    Raises:
        UsageError: It cannot be written.
    """
    target = Path(os.path.realpath(path))
    try:
        if target.exists() and not target.is_file():
            raise UsageError(f"cannot write {path}: it is not a regular file")
        descriptor, name = tempfile.mkstemp(prefix=f".{target.name}.", dir=target.parent)
        os.close(descriptor)
        Path(name).unlink()
    except OSError as error:
        raise UsageError(f"cannot write {path}: {error.strerror}; choose another file with --memory") from None


class MemorySaver:
    """Keeps a memory file up to date while a robot learns.

    If the new memory knows less than the file did before the run, as after a reset, the old one is kept as `FILE.1`.
    Turns learned in the same run may be forgotten without a message. The memory of a doubtful run goes to
    `FILE.doubtful`, and the file is restored to its content before the run.
    """

    def __init__(self, path: Path, loaded: Sequence[int] | None, report: Callable[[str], object]) -> None:
        """Takes the file; nothing is saved yet.

        Args:
            path: The memory file.
            loaded: The eight cells that it holds; None if it does not exist yet.
            report: Called with one line when the old memory is kept.
        """
        self._path, self._report = path, report
        self._loaded = self._held = self._saved = None if loaded is None else tuple(loaded)
        self._set_aside: Memory | None = None

    def save(self, memory: Sequence[int], *, doubtful: bool = False) -> None:
        """Saves a memory if it has changed; that of a run that is doubtful by now, beside the file.

        Raises:
            OctetError: The file cannot be written; the old one is unchanged.
        """
        if doubtful:
            self._save_beside(tuple(memory))
            return
        if memory == self._saved:
            return
        if self._held is not None and _knows_more(self._held, tuple(memory)):
            self._back_up(self._held)
        write_bytes(self._path, bytes(memory))
        self._saved = tuple(memory)

    def finish(self, memory: Sequence[int], *, doubtful: bool = False) -> None:
        """Saves the last memory of a run, even if it was saved before and the file has vanished since.

        Raises:
            OctetError: As in `save`.
        """
        if self._saved is not None and not doubtful and not self._path.exists():
            self._report(f"{self._path} has vanished during the run, and is written again")
            self._saved = None
        self.save(memory, doubtful=doubtful)

    def _save_beside(self, memory: Memory) -> None:
        """Saves a doubtful memory; the first time, the file is restored to its content before the run.

        It is restored first, so that a run that is killed in between leaves no doubtful memory in it.
        """
        if memory == self._set_aside:
            return
        beside = self._path.with_name(self._path.name + ".doubtful")
        if self._set_aside is None:
            self._restore()
        write_bytes(beside, bytes(memory))
        if self._set_aside is None:
            self._report(f"the run is doubtful: its memory is in {beside}, and {self._path} is as it was before")
        self._set_aside = memory

    def _restore(self) -> None:
        if self._loaded is None:
            Path(os.path.realpath(self._path)).unlink(missing_ok=True)
        elif self._saved != self._loaded:
            write_bytes(self._path, bytes(self._loaded))

    def _back_up(self, held: Memory) -> None:
        kept = self._path.with_name(self._path.name + ".1")
        write_bytes(kept, bytes(held))
        self._report(f"cells of {self._path} were erased; the memory before that is in {kept}")
        self._held = None


def _knows_more(old: Memory, new: Memory) -> bool:
    """Whether there is a pattern for which only the old memory has a turn."""
    return any(before and not after for before, after in zip(sides_of(old), sides_of(new), strict=True))


def memory_path(path: Path, node: int, robots: int) -> Path:
    """The memory file of a robot: the path itself in a run with one robot, else with the node number added.

    >>> memory_path(Path("robot.mem"), node=2, robots=3).name
    'robot-2.mem'
    """
    return path if robots == 1 else path.with_name(f"{path.stem}-{node}{path.suffix}")


_INSTEAD = "choose another file with --memory"


@contextmanager
def memory_lock(path: Path) -> Iterator[None]:
    """Keeps other runs away from a memory file, whether or not it exists yet.

    The lock is on an empty file beside it, since the memory file itself is replaced whenever something is learned. A
    run that is killed leaves the empty file; the next run locks it again.

    Raises:
        UsageError: The file cannot be locked, or another run is using it.
    """
    target = Path(os.path.realpath(path))
    beside = target.with_name(f".{target.name}.lock")
    descriptor = _open_locked(beside, path)
    try:
        yield
    finally:
        with suppress(OSError):
            beside.unlink()  # on Windows it stays, since it is open
        os.close(descriptor)


def _open_locked(beside: Path, path: Path) -> int:
    """Opens and locks the file; retries if the run that held the lock removed it in between."""
    while True:
        descriptor = _open(beside, path)
        try:
            lock(descriptor, str(path), _INSTEAD)
            if _is_still(beside, descriptor):
                return descriptor
        except BaseException:
            os.close(descriptor)
            raise
        os.close(descriptor)


def _open(beside: Path, path: Path) -> int:
    try:
        return os.open(beside, os.O_RDONLY | os.O_CREAT | NO_LINK | NO_WAIT, 0o666)
    except OSError as error:
        raise UsageError(f"cannot lock {path} by {beside}: {error.strerror}; {_INSTEAD}") from None


def _is_still(beside: Path, descriptor: int) -> bool:
    """Whether the path still leads to the open file."""
    try:
        return os.path.samestat(beside.stat(), os.fstat(descriptor))
    except FileNotFoundError:
        return False
