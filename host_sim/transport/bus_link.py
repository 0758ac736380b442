"""A link over a python-can bus."""

import errno
import select
import time
from collections.abc import Callable

import can

from host_sim.base.errors import LinkDownError
from host_sim.base.frame import Frame
from host_sim.transport.line_stats import LineStats

_SEND_S = 0.1
_NO_FRAME = Frame(-1, b"")


class BusLink:
    """A link over any python-can bus.

    Attributes:
        garbled: As in `FrameSocket`.
        closing: As in `FrameSocket`.
    """

    def __init__(self, bus: can.BusABC, stats: LineStats | None = None, *, is_socket: bool = False) -> None:
        """Takes over the bus: `close` shuts it down.

        Args:
            bus: The bus.
            stats: Counts the line's outages and errors.
            is_socket: Whether the bus is a socket that carries a frame a datagram, as SocketCAN does.
        """
        self.closing: Callable[[], object] = lambda: None
        self.garbled = 0
        self._bus, self._is_socket = bus, is_socket
        self._back: Frame | None = None
        self._stats = stats or LineStats()

    def send(self, frame: Frame) -> None:
        """As in `Link`."""
        message = can.Message(arbitration_id=frame.id, data=frame.data, is_extended_id=False, check=False)
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
        try:
            message = self._heard(timeout_s)
        except (can.CanError, OSError) as error:
            raise LinkDownError(f"cannot hear the robot: {error}") from error
        except (ValueError, LookupError):  # what some of python-can's interfaces make of noise on the line
            return _NO_FRAME
        if message is None:
            return None
        if message.is_extended_id or message.is_remote_frame or message.is_error_frame or message.is_fd:
            return _NO_FRAME
        return Frame(message.arbitration_id, bytes(message.data))

    def _heard(self, timeout_s: float) -> can.Message | None:
        """The next message. python-can waits by the wall clock: for hours, if that is set back meanwhile."""
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
