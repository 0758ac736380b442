"""A python-can bus over a socket pair: SocketCAN's 16-byte frames, one a datagram, with no CAN in the kernel."""

import select
import socket
import struct
import time
from typing import Any

import can

_FRAME = struct.Struct("=IB3x8s")  # struct can_frame of Linux, in the machine's own byte order
_EXTENDED, _REMOTE, _ERROR = 0x80000000, 0x40000000, 0x20000000
_FLAGS = _EXTENDED | _REMOTE | _ERROR
SEND_TIMEOUT_S = 1.0


class SocketPairBus(can.BusABC):
    """One end of a `SOCK_SEQPACKET` socket pair. The far end is a process that opened its own end as `fd:N`.

    Registered with python-can as interface `octet`; its channel is the number of the open socket.
    """

    def __init__(self, channel: Any = None, can_filters: Any = None, **kwargs: Any) -> None:
        """Takes over the socket: shutdown closes it.

        Args:
            channel: File descriptor of the socket, a number.
            can_filters: As in `can.BusABC`.
            **kwargs: As in `can.BusABC`.

        Raises:
            can.CanInitializationError: The channel is not an open socket.
        """
        try:
            self._socket = socket.socket(fileno=int(channel))
            self._socket.setblocking(False)
        except (OSError, TypeError, ValueError) as error:
            raise can.CanInitializationError(f"channel {channel!r} is no open socket: {error}") from error
        self.channel_info = f"socket pair, fd {channel}"
        super().__init__(channel=channel, can_filters=can_filters, **kwargs)

    def fileno(self) -> int:
        """The socket, for select."""
        return self._socket.fileno()

    def send(self, msg: can.Message, timeout: float | None = None) -> None:
        """Sends one frame.

        Args:
            msg: The frame.
            timeout: Seconds to wait for room; None for one second.

        Raises:
            can.CanOperationError: The far end is closed, or made no room in time.
        """
        flags = (_EXTENDED if msg.is_extended_id else 0) | (_REMOTE if msg.is_remote_frame else 0)
        packed = _FRAME.pack(msg.arbitration_id | flags, msg.dlc, bytes(msg.data))
        try:
            self._socket.send(packed)
        except BlockingIOError:
            self._send_later(packed, SEND_TIMEOUT_S if timeout is None else timeout)
        except OSError as error:
            raise can.CanOperationError(f"the far end is closed: {error}") from error

    def _send_later(self, packed: bytes, timeout: float) -> None:
        if not select.select([], [self._socket], [], timeout)[1]:
            raise can.CanOperationError(f"the far end made no room for {timeout} s")
        self._socket.send(packed)

    def _recv_internal(self, timeout: float | None) -> tuple[can.Message | None, bool]:
        try:
            packed = self._socket.recv(_FRAME.size)
        except BlockingIOError:
            if not select.select([self._socket], [], [], timeout)[0]:
                return None, False
            packed = self._socket.recv(_FRAME.size)
        except OSError as error:
            raise can.CanOperationError(f"the far end is closed: {error}") from error
        if not packed:
            raise can.CanOperationError("the far end is closed")
        return (self._message_from(packed) if len(packed) == _FRAME.size else None), False

    def _message_from(self, packed: bytes) -> can.Message:
        can_id, length, data = _FRAME.unpack(packed)
        return can.Message(
            timestamp=time.time(),
            arbitration_id=can_id & ~_FLAGS,
            is_extended_id=bool(can_id & _EXTENDED),
            is_remote_frame=bool(can_id & _REMOTE),
            is_error_frame=bool(can_id & _ERROR),
            dlc=length,
            data=data[:length],
        )

    def shutdown(self) -> None:
        """Closes this end."""
        super().shutdown()
        self._socket.close()
