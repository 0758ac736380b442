"""Reads of regular files, up to a size."""

import os
import stat
from pathlib import Path

from host_sim.errors import UsageError


def read_bytes(path: Path, limit: int) -> bytes:
    """The content of a regular file.

    Args:
        path: The file. A pipe or a device is refused before a byte of it is read: some never end.
        limit: The greatest size accepted, bytes.

    Raises:
        FileNotFoundError: There is no such file.
        UsageError: It cannot be read, is not a regular file, or is larger than the limit.
    """
    try:
        with open(path, "rb", opener=_open_without_waiting) as file:
            status = os.fstat(file.fileno())
            if not stat.S_ISREG(status.st_mode):
                raise UsageError(f"cannot read {path}: it is not a regular file")
            if status.st_size > limit:
                raise UsageError(f"cannot read {path}: {status.st_size} bytes, at most {limit} are accepted")
            return file.read(status.st_size)
    except FileNotFoundError:
        raise
    except OSError as error:
        raise UsageError(f"cannot read {path}: {error.strerror}") from None


def _open_without_waiting(path: str, flags: int) -> int:
    return os.open(path, flags | os.O_NONBLOCK)
