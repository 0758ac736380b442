"""A link over a python-can bus."""

import errno
import select
import time
from collections import deque
from collections.abc import Callable

import can

from host_sim.base.errors import LinkDownError
from host_sim.transport.link import OWN_MAX, Frame, LineStats
from host_sim.transport.socket_pair import EXTENDED

_SEND_S = 0.1
_NO_FRAME = Frame(-1, b"")


class BusLink:
    """A link over any python-can bus.

    Attributes:
        garbled: As in `FrameSocket`.
        closing: As in `FrameSocket`.
        takes_extended: As in `SocketPairLink`.
    """

    def __init__(
        self, bus: can.BusABC, stats: LineStats | None = None, *, is_socket: bool = False, echoes: bool = False
    ) -> None:
        """Takes over the bus: `close` shuts it down.

        Args:
            bus: The bus.
            stats: Counts the line's outages and errors.
            is_socket: Whether the bus is a socket that carries one frame per datagram, as SocketCAN does.
            echoes: Whether a copy of a frame just sent counts as returned by the adapter, and is skipped. Frames that
                the adapter itself marks as its own are always skipped.
        """
        self.closing: Callable[[], object] = lambda: None
        self.garbled, self.takes_extended = 0, False
        self._bus, self._is_socket = bus, is_socket
        self._back: Frame | None = None
        self._own: deque[Frame] = deque(maxlen=OWN_MAX if echoes else 0)
        self._stats = stats or LineStats()

    def send(self, frame: Frame) -> None:
        """As in `Link`."""
        self._own.append(frame)
        is_extended = bool(frame.id & EXTENDED)
        message = can.Message(
            arbitration_id=frame.id & ~EXTENDED, data=frame.data, is_extended_id=is_extended, check=False
        )
        try:
            self._bus.send(message, timeout=_SEND_S)
        except (can.CanError, OSError) as error:
            if not _has_no_room(error):
                raise LinkDownError(f"cannot send to the robot: {error}") from error
            self._stats.unsent += 1

    def receive(self, timeout_s: float) -> Frame | None:
        """As in `Link`."""
        if self._back is not None:
            frame, self._back = self._back, None
            return frame
        give_up = time.monotonic() + timeout_s
        while (heard := self._next(give_up)) is not None and heard in self._own:
            pass
        return heard

    def _next(self, give_up: float) -> Frame | None:
        """The next frame of others, until a time on the monotonic clock."""
        try:
            while (message := self._heard(max(give_up - time.monotonic(), 0.0))) is not None and self._is_own(
                message
            ):
                pass
        except (can.CanError, OSError) as error:
            raise LinkDownError(f"cannot hear the robot: {error}") from error
        except (ValueError, LookupError):  # some of python-can's interfaces raise these for noise on the line
            return _NO_FRAME
        if message is None:
            return None
        is_strange = message.is_extended_id and not self.takes_extended
        if is_strange or message.is_remote_frame or message.is_error_frame or message.is_fd:
            return _NO_FRAME
        return Frame(message.arbitration_id | (EXTENDED if message.is_extended_id else 0), bytes(message.data))

    def _is_own(self, message: can.Message) -> bool:
        """Whether the bus marks it as sent here. SocketCAN marks all that any program of this host has sent."""
        return not message.is_rx and not self._is_socket

    def _heard(self, timeout_s: float) -> can.Message | None:
        """The next message. python-can waits by the wall clock: for hours if the clock is set back meanwhile."""
        if not self._is_socket:
            return self._bus.recv(timeout_s)
        give_up = time.monotonic() + timeout_s
        poll = select.poll()
        poll.register(self._bus.fileno(), select.POLLIN)
        while poll.poll(max(give_up - time.monotonic(), 0.0) * 1000):
            message = self._bus.recv(0.0)
            if message is not None:
                return message
        return None

    def frame_socket(self) -> "BusLink | None":
        """As in `SocketLink`."""
        return self if self._is_socket and self._back is None else None

    def fileno(self) -> int:
        """As in `FrameSocket`."""
        return self._bus.fileno()

    def put_back(self, frame: Frame) -> None:
        """As in `FrameSocket`."""
        self._back = frame

    def close(self) -> None:
        """As in `Link`."""
        self.closing()
        self._bus.shutdown()


def _has_no_room(error: Exception) -> bool:
    """Whether a frame could not be sent because the queue of a working line is full."""
    code = getattr(error, "error_code", None) or getattr(error, "errno", None)
    return code == errno.ENOBUFS or (code is None and isinstance(error, can.CanOperationError))
