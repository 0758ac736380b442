"""A link over a python-can bus."""

import can

from host_sim.errors import RobotError
from host_sim.protocol.codec import Frame


class BusLink:
    """A link over any python-can bus."""

    def __init__(self, bus: can.BusABC) -> None:
        """Takes over the bus: `close` shuts it down."""
        self._bus = bus

    def send(self, frame: Frame) -> None:
        """As in `Link`."""
        message = can.Message(arbitration_id=frame.id, data=frame.data, is_extended_id=False, check=False)
        try:
            self._bus.send(message, timeout=1.0)
        except (can.CanError, OSError) as error:
            raise RobotError(f"cannot send to the robot: {error}") from error

    def receive(self, timeout_s: float) -> Frame | None:
        """As in `Link`. Frames with a 29-bit identifier, remote and error frames are no one's here: id -1."""
        try:
            message = self._bus.recv(timeout_s)
        except (can.CanError, OSError) as error:
            raise RobotError(f"cannot hear the robot: {error}") from error
        if message is None:
            return None
        if message.is_extended_id or message.is_remote_frame or message.is_error_frame:
            return Frame(-1, b"")
        return Frame(message.arbitration_id, bytes(message.data))

    def close(self) -> None:
        """As in `Link`."""
        self._bus.shutdown()
