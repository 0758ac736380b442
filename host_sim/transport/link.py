"""Ways for frames to get to a robot and back."""

from typing import Protocol

from host_sim.protocol.codec import Frame


class Link(Protocol):
    """Carries single frames to one robot and back."""

    def send(self, frame: Frame) -> None:
        """Sends one frame, or counts it as unsent where there is no room for it.

        Raises:
            LinkDownError: The line is gone.
        """

    def receive(self, timeout_s: float) -> Frame | None:
        """The next frame, or None after `timeout_s`; 0 polls. Something received that is no such frame has the id -1.

        Raises:
            LinkDownError: The line is gone.
        """

    def close(self) -> None:
        """Ends it."""
