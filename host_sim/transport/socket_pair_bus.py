"""A python-can bus over a socket pair, for programs that are started with their end of it."""

import errno
import math
import socket
import time
from typing import Any

import can

from host_sim.transport.socket_pair import ERROR, EXTENDED, FLAGS, REMOTE, CanFrame, SocketPair


class SocketPairBus(can.BusABC):
    """One end of a `SOCK_SEQPACKET` socket pair, such as a process inherits from the one that started it.

    Registered with python-can as interface `octet`; its channel is the number of the open socket. Datagrams that are
    not frames are skipped.
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
            self._pair = SocketPair(socket.socket(fileno=int(channel)))
        except (OSError, TypeError, ValueError) as error:
            raise can.CanInitializationError(f"channel {channel!r} is not an open socket: {error}") from error
        self.channel_info = f"socket pair, fd {channel}"
        super().__init__(channel=channel, can_filters=can_filters, **kwargs)

    def fileno(self) -> int:
        """The socket, for select."""
        return self._pair.fileno()

    def send(self, msg: can.Message, timeout: float | None = None) -> None:
        """Sends one frame.

        Args:
            msg: The frame.
            timeout: Seconds to wait for room; None blocks until there is some.

        Raises:
            can.CanOperationError: The far end is closed, or made no room in time.
        """
        flags = (EXTENDED if msg.is_extended_id else 0) | (REMOTE if msg.is_remote_frame else 0)
        frame = CanFrame(msg.arbitration_id | flags, msg.dlc, bytes(msg.data))
        try:
            sent = self._pair.send_by(frame, _deadline(timeout))
        except (OSError, ValueError) as error:  # ValueError: this end was shut down
            raise can.CanOperationError("the far end is closed", errno.EPIPE) from error
        if not sent:
            raise can.CanOperationError(f"the far end made no room for {timeout} s")

    def _recv_internal(self, timeout: float | None) -> tuple[can.Message | None, bool]:
        try:
            frame = self._pair.receive_by(_deadline(timeout))
        except (OSError, ValueError) as error:
            raise can.CanOperationError("the far end is closed", errno.EPIPE) from error
        return (None if frame is None else _message_from(frame)), False

    def shutdown(self) -> None:
        """Closes this end."""
        super().shutdown()
        self._pair.close()


def _message_from(frame: CanFrame) -> can.Message:
    remote = bool(frame.can_id & REMOTE)
    return can.Message(
        timestamp=time.time(),
        arbitration_id=frame.can_id & ~FLAGS,
        is_extended_id=bool(frame.can_id & EXTENDED),
        is_remote_frame=remote,
        is_error_frame=bool(frame.can_id & ERROR),
        dlc=frame.length,
        data=None if remote else frame.data[: frame.length],
    )


def _deadline(timeout: float | None) -> float:
    return math.inf if timeout is None else time.monotonic() + timeout
