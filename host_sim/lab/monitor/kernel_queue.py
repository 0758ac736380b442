"""The kernel's receive queue: lengthens it, and counts dropped frames."""

import contextlib
import socket
import struct

import can

_BYTES = 16 << 20
"""Room for some 20,000 frames, including the kernel's overhead."""

_SO_RCVBUFFORCE = 33
_SO_MEMINFO = 55
_MEMINFO = struct.Struct("9I")
_DROPS = 8


def lengthen(bus: can.BusABC) -> None:
    """Makes the receive queue as long as the kernel allows, if the bus is a socket."""
    if (queue := _socket_of(bus)) is None:
        return
    queue.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, _BYTES)
    with contextlib.suppress(PermissionError):  # beyond this machine's limit, which only an administrator may exceed
        queue.setsockopt(socket.SOL_SOCKET, _SO_RCVBUFFORCE, _BYTES)


def dropped(bus: can.BusABC) -> int:
    """Number of frames that the kernel dropped, if the bus is a socket; else 0."""
    if (queue := _socket_of(bus)) is None:
        return 0
    drops: int = _MEMINFO.unpack(queue.getsockopt(socket.SOL_SOCKET, _SO_MEMINFO, _MEMINFO.size))[_DROPS]
    return drops


def _socket_of(bus: can.BusABC) -> socket.socket | None:
    found = getattr(bus, "socket", None)
    return found if isinstance(found, socket.socket) else None
