"""Locks against other runs; they end with the process that holds them, however it ends."""

import os
from pathlib import Path

from host_sim.base.errors import UsageError
from host_sim.base.system import lock_at_once

_LOCKS = Path("/proc/locks")


def lock(descriptor: int, name: str, instead: str) -> None:
    """Locks an open file or folder until it is closed.

    Args:
        descriptor: Descriptor of the open file or folder.
        name: Name of the protected object, for the message.
        instead: Advice if it is locked already, for the message.

    Raises:
        UsageError: It cannot be locked, or another run has locked it.
    """
    try:
        lock_at_once(descriptor)
    except BlockingIOError:
        raise UsageError(f"{name} is in use by another run{_owner(descriptor)}; {instead}") from None
    except OSError as error:
        raise UsageError(f"cannot lock {name}: {error.strerror}; {instead}") from None


def _owner(descriptor: int) -> str:
    """The process that holds the lock, for a message; empty where the kernel does not say."""
    inode = f":{os.fstat(descriptor).st_ino}"
    for line in _LOCKS.read_text(encoding="ascii").splitlines() if _LOCKS.exists() else ():
        words = line.split()
        if "FLOCK" in words and any(word.endswith(inode) for word in words):
            return f" (process {words[words.index('WRITE') + 1]})" if "WRITE" in words else ""
    return ""
