"""A socket pair with SocketCAN's 16-byte frames as datagrams; needs neither CAN in the kernel nor python-can."""

import math
import select
import socket
import struct
import time
from collections.abc import Callable
from typing import NamedTuple

from host_sim.base.errors import LinkDownError
from host_sim.transport.link import Frame, LineStats

EXTENDED, REMOTE, ERROR = 0x80000000, 0x40000000, 0x20000000
"""Flags of an identifier, as Linux has them."""

FLAGS = EXTENDED | REMOTE | ERROR
_FRAME = struct.Struct("=IB3x8s")  # struct can_frame of Linux, in the machine's own byte order
_DATA_MAX = 8
_SEND_S = 0.1
_NO_FRAME = Frame(-1, b"")


class CanFrame(NamedTuple):
    """A `struct can_frame`.

    Attributes:
        can_id: Identifier and flags.
        length: Number of data bytes, 0..8; of a remote frame, the number asked for.
        data: The data; from `SocketPair.receive_by`, always 8 bytes.
    """

    can_id: int
    length: int
    data: bytes


class SocketPair:
    """One end of a `SOCK_SEQPACKET` socket pair.

    Attributes:
        garbled: Number of datagrams received so far that are not frames; they are skipped.
    """

    def __init__(self, end: socket.socket) -> None:
        """Takes over the socket: `close` closes it."""
        self._socket = end
        self._socket.setblocking(True)  # for C code that waits; here, each call says that it does not
        self.garbled = 0

    def fileno(self) -> int:
        """The socket, for select."""
        return self._socket.fileno()

    def send_by(self, frame: CanFrame, deadline: float) -> bool:
        """Sends a frame; False if there is no room until the deadline, s on the monotonic clock.

        Raises:
            OSError: The far end is closed.
            ValueError: This end is closed.
        """
        packed = _FRAME.pack(frame.can_id, frame.length, frame.data)
        if self._try_send(packed):
            return True
        while self._await(select.POLLOUT, deadline):
            if self._try_send(packed):
                return True
        return False

    def receive_by(self, deadline: float) -> CanFrame | None:
        """The next frame; None if none arrives until the deadline, s on the monotonic clock.

        Raises:
            OSError: The far end is closed.
            ValueError: This end is closed.
        """
        frame = self._try_receive()
        while frame is None and self._await(select.POLLIN, deadline):
            frame = self._try_receive()
        return frame

    def close(self) -> None:
        """Closes this end."""
        self._socket.close()

    def _try_send(self, packed: bytes) -> bool:
        try:
            self._socket.send(packed, socket.MSG_DONTWAIT)
        except BlockingIOError:
            return False
        return True

    def _try_receive(self) -> CanFrame | None:
        """The next datagram that is a frame; None if none has arrived."""
        while True:
            try:
                packed = self._socket.recv(_FRAME.size + 1, socket.MSG_DONTWAIT)
            except BlockingIOError:
                return None
            if len(packed) == _FRAME.size and packed[4] <= _DATA_MAX:
                return CanFrame(*_FRAME.unpack(packed))
            if not packed and self._poll(select.POLLRDHUP, 0):  # an empty datagram reads like the end
                raise ConnectionResetError("it sends no more")
            self.garbled += 1

    def _await(self, event: int, deadline: float) -> bool:
        """Waits for an event until a deadline; returns whether it occurred."""
        if deadline == math.inf:
            return self._poll(event, None)
        left_s = deadline - time.monotonic()
        return left_s > 0 and self._poll(event, math.ceil(left_s * 1000))

    def _poll(self, event: int, timeout_ms: int | None) -> bool:
        poll = select.poll()
        poll.register(self._socket, event)
        return bool(poll.poll(timeout_ms))


class SocketPairLink(SocketPair):
    """A `SocketLink` over a socket pair.

    Attributes:
        explain: Called when the far end is closed, before the error is raised; it may raise one that says more.
        closing: As in `FrameSocket`.
        takes_extended: Whether `receive` returns frames with 29-bit identifiers, flagged `EXTENDED`, as frames.
    """

    def __init__(self, end: socket.socket, stats: LineStats | None = None) -> None:
        """Takes over the socket: `close` closes it.

        Args:
            end: The socket.
            stats: Counts the frames for which there was no room.
        """
        super().__init__(end)
        self.explain: Callable[[], object] = lambda: None
        self.closing: Callable[[], object] = lambda: None
        self.takes_extended = False
        self._stats = stats or LineStats()
        self._back: Frame | None = None

    def send(self, frame: Frame) -> None:
        """As in `Link`."""
        try:
            sent = self.send_by(CanFrame(frame.id, len(frame.data), frame.data), time.monotonic() + _SEND_S)
        except (OSError, ValueError) as error:
            self.explain()
            raise LinkDownError("cannot send to the robot: the far end is closed") from error
        self._stats.unsent += not sent

    def receive(self, timeout_s: float) -> Frame | None:
        """As in `Link`."""
        if self._back is not None:
            frame, self._back = self._back, None
            return frame
        try:
            heard = self.receive_by(time.monotonic() + timeout_s)
        except (OSError, ValueError) as error:
            self.explain()
            raise LinkDownError("cannot hear the robot: the far end is closed") from error
        if heard is None:
            return None
        refused = FLAGS & ~EXTENDED if self.takes_extended else FLAGS
        return _NO_FRAME if heard.can_id & refused else Frame(heard.can_id, heard.data[: heard.length])

    def frame_socket(self) -> "SocketPairLink | None":
        """As in `SocketLink`."""
        return self if self._back is None else None

    def put_back(self, frame: Frame) -> None:
        """As in `FrameSocket`."""
        self._back = frame

    def close(self) -> None:
        """As in `Link`."""
        self.closing()
        super().close()
