"""Ways for frames to get to a robot and back."""

from typing import Protocol

from host_sim.protocol.codec import Frame


class Link(Protocol):
    """Carries single frames to one robot and back."""

    def send(self, frame: Frame) -> None:
        """Sends one frame.

        Raises:
            RobotError: It cannot be sent.
        """

    def receive(self, timeout_s: float) -> Frame | None:
        """The next frame, or None if none comes for so long; 0 just looks.

        Raises:
            RobotError: The robot is gone.
        """

    def close(self) -> None:
        """Ends it."""
