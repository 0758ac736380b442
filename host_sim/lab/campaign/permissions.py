"""Permissions of files, for root too."""

import ctypes
from contextlib import ExitStack

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
