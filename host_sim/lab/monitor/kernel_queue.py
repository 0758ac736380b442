"""Where frames wait in the kernel until the monitor reads them: made long, and what did not fit into it counted."""

import contextlib
import socket
import struct

import can

_BYTES = 16 << 20
"""Some 20,000 frames, each with what the kernel keeps of it."""

_SO_RCVBUFFORCE = 33
_SO_MEMINFO = 55
_MEMINFO = struct.Struct("9I")
_DROPS = 8


def lengthen(bus: can.BusABC) -> None:
    """Has the kernel keep as many frames for us as it lets us, where the bus is a socket."""
    if (queue := _socket_of(bus)) is None:
        return
    queue.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, _BYTES)
    with contextlib.suppress(PermissionError):  # beyond the limit of this machine: only for its administrator
        queue.setsockopt(socket.SOL_SOCKET, _SO_RCVBUFFORCE, _BYTES)


def dropped(bus: can.BusABC) -> int:
    """Number of frames for which the kernel had no room, where the bus is a socket."""
    if (queue := _socket_of(bus)) is None:
        return 0
    drops: int = _MEMINFO.unpack(queue.getsockopt(socket.SOL_SOCKET, _SO_MEMINFO, _MEMINFO.size))[_DROPS]
    return drops


def _socket_of(bus: can.BusABC) -> socket.socket | None:
    found = getattr(bus, "socket", None)
    return found if isinstance(found, socket.socket) else None
