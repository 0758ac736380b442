"""The folder of a run's files: one run at a time writes to it."""

import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from host_sim.errors import UsageError

_LOCKS = Path("/proc/locks")


@contextmanager
def run_folder(path: Path) -> Iterator[None]:
    """Creates the folder if it does not exist, and keeps other runs out of it.

    Raises:
        UsageError: It cannot be created or locked, or another run is using it.
    """
    descriptor = _open(path)
    try:
        _lock(descriptor, path)
        yield
    finally:
        os.close(descriptor)


def _open(path: Path) -> int:
    try:
        path.mkdir(parents=True, exist_ok=True)
        return os.open(path, os.O_RDONLY | os.O_DIRECTORY)
    except OSError as error:
        raise UsageError(f"cannot make the folder {path}: {error.strerror}; choose another with --out") from None


def _lock(descriptor: int, path: Path) -> None:
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        owner = _owner(descriptor)
        raise UsageError(f"{path} is in use by another run{owner}; choose another folder with --out") from None
    except OSError as error:
        raise UsageError(f"cannot lock the folder {path}: {error.strerror}; choose another with --out") from None


def _owner(descriptor: int) -> str:
    """The process that holds the lock, for a message; empty where the kernel does not say."""
    inode = f":{os.fstat(descriptor).st_ino}"
    for line in _LOCKS.read_text(encoding="ascii").splitlines() if _LOCKS.exists() else ():
        words = line.split()
        if "FLOCK" in words and any(word.endswith(inode) for word in words):
            return f" (process {words[words.index('WRITE') + 1]})" if "WRITE" in words else ""
    return ""
