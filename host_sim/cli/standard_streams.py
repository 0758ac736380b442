"""The standard streams of a command: any of them may be closed, and standard output may be full."""

import errno
import os
import sys

_FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO)


def open_closed() -> None:
    """Opens the null device for each stream that is closed: else a file of the run would get the stream's number."""
    for number in filter(_is_closed, range(3)):
        os.dup2(os.open(os.devnull, os.O_RDWR), number)
        os.set_inheritable(number, True)
    sys.stdin = sys.stdin or open(0, closefd=False)  # noqa: SIM115 - as long as the process lasts
    sys.stdout = sys.stdout or open(1, "w", closefd=False)  # noqa: SIM115
    sys.stderr = sys.stderr or open(2, "w", closefd=False)  # noqa: SIM115


def is_full(error: OSError) -> bool:
    """Whether standard output takes no more. An error of a file that a command writes names the file."""
    return error.filename is None and error.errno in _FULL


def drop_output() -> None:
    """Drops what is not written to standard output yet: it must not fail a second time at exit."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _is_closed(number: int) -> bool:
    try:
        os.fstat(number)
    except OSError:
        return True
    return False
