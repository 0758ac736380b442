"""A python-can bus over a socket pair, with SocketCAN's 16-byte frames as datagrams; needs no CAN in the kernel."""

import errno
import math
import select
import socket
import struct
import time
from typing import Any

import can

_FRAME = struct.Struct("=IB3x8s")  # struct can_frame of Linux, in the machine's own byte order
_DATA_MAX = 8
_EXTENDED, _REMOTE, _ERROR = 0x80000000, 0x40000000, 0x20000000
_FLAGS = _EXTENDED | _REMOTE | _ERROR


class SocketPairBus(can.BusABC):
    """One end of a `SOCK_SEQPACKET` socket pair. The far end is a process that opened its own end as `fd:N`.

    Registered with python-can as interface `octet`; its channel is the number of the open socket.

    Attributes:
        garbled: Datagrams received so far that are not frames; they are skipped.
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
            self._socket.setblocking(True)  # for C code that waits; here, each call says that it does not
        except (OSError, TypeError, ValueError) as error:
            raise can.CanInitializationError(f"channel {channel!r} is not an open socket: {error}") from error
        self.garbled = 0
        self.channel_info = f"socket pair, fd {channel}"
        super().__init__(channel=channel, can_filters=can_filters, **kwargs)

    def fileno(self) -> int:
        """The socket, for select."""
        return self._socket.fileno()

    def send(self, msg: can.Message, timeout: float | None = None) -> None:
        """Sends one frame.

        Args:
            msg: The frame.
            timeout: Seconds to wait for room; None blocks until there is some.

        Raises:
            can.CanOperationError: The far end is closed, or made no room in time.
        """
        flags = (_EXTENDED if msg.is_extended_id else 0) | (_REMOTE if msg.is_remote_frame else 0)
        packed = _FRAME.pack(msg.arbitration_id | flags, msg.dlc, bytes(msg.data))
        try:
            sent = self._try_send(packed) or self._send_by(_deadline(timeout), packed)
        except (OSError, ValueError) as error:  # ValueError: this end was shut down
            raise can.CanOperationError("the far end is closed", errno.EPIPE) from error
        if not sent:
            raise can.CanOperationError(f"the far end made no room for {timeout} s")

    def _try_send(self, packed: bytes) -> bool:
        try:
            self._socket.send(packed, socket.MSG_DONTWAIT)
        except BlockingIOError:
            return False
        return True

    def _send_by(self, deadline: float, packed: bytes) -> bool:
        while self._await(select.POLLOUT, deadline):
            if self._try_send(packed):
                return True
        return False

    def _recv_internal(self, timeout: float | None) -> tuple[can.Message | None, bool]:
        try:
            packed = self._try_receive()
            if packed is None:
                packed = self._receive_by(_deadline(timeout))
        except (OSError, ValueError) as error:
            raise can.CanOperationError("the far end is closed", errno.EPIPE) from error
        return (None if packed is None else self._message_from(packed)), False

    def _try_receive(self) -> bytes | None:
        """The next datagram that is a frame; None if none has arrived."""
        while True:
            try:
                packed = self._socket.recv(_FRAME.size + 1, socket.MSG_DONTWAIT)
            except BlockingIOError:
                return None
            if len(packed) == _FRAME.size and packed[4] <= _DATA_MAX:
                return packed
            if not packed and self._poll(select.POLLRDHUP, 0):  # an empty datagram reads like the end
                raise ConnectionResetError("it sends no more")
            self.garbled += 1

    def _receive_by(self, deadline: float) -> bytes | None:
        while self._await(select.POLLIN, deadline):
            packed = self._try_receive()
            if packed is not None:
                return packed
        return None

    def _await(self, event: int, deadline: float) -> bool:
        """Waits for an event until a deadline on the monotonic clock; returns whether it occurred."""
        if deadline == math.inf:
            return self._poll(event, None)
        left_s = deadline - time.monotonic()
        return left_s > 0 and self._poll(event, math.ceil(left_s * 1000))

    def _poll(self, event: int, timeout_ms: int | None) -> bool:
        poll = select.poll()
        poll.register(self._socket, event)
        return bool(poll.poll(timeout_ms))

    def _message_from(self, packed: bytes) -> can.Message:
        can_id, length, data = _FRAME.unpack(packed)
        remote = bool(can_id & _REMOTE)
        return can.Message(
            timestamp=time.time(),
            arbitration_id=can_id & ~_FLAGS,
            is_extended_id=bool(can_id & _EXTENDED),
            is_remote_frame=remote,
            is_error_frame=bool(can_id & _ERROR),
            dlc=length,
            data=None if remote else data[:length],
        )

    def shutdown(self) -> None:
        """Closes this end."""
        super().shutdown()
        self._socket.close()


def _deadline(timeout: float | None) -> float:
    return math.inf if timeout is None else time.monotonic() + timeout
