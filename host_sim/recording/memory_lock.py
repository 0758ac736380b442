"""Locks a memory file, so that only one run at a time learns into it."""

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from host_sim.base.errors import UsageError
from host_sim.base.files import lock
from host_sim.base.system import NO_LINK, NO_WAIT

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
