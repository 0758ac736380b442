"""The interface of links that carry frames to a robot and back."""

from collections.abc import Callable
from typing import Protocol, runtime_checkable

from host_sim.base.frame import Frame


class Link(Protocol):
    """Carries single frames to one robot and back."""

    def send(self, frame: Frame) -> None:
        """Sends one frame, or counts it as unsent where there is no room for it.

        Raises:
            LinkDownError: The line is gone.
        """

    def receive(self, timeout_s: float) -> Frame | None:
        """The next frame, or None after `timeout_s`; 0 polls. Anything received that is not a frame has the id -1.

        Raises:
            LinkDownError: The line is gone.
        """

    def close(self) -> None:
        """Ends it."""


class FrameSocket(Protocol):
    """A socket that carries a frame a datagram, as SocketCAN does, so that C code can send and receive as well.

    Attributes:
        garbled: Number of datagrams that were not frames.
        closing: Called before it closes.
    """

    garbled: int
    closing: Callable[[], object]

    def fileno(self) -> int:
        """The socket."""

    def put_back(self, frame: Frame) -> None:
        """Has the next `receive` return a frame that was received from the socket already."""


@runtime_checkable
class SocketLink(Link, Protocol):
    """A link that may have such a socket."""

    def frame_socket(self) -> FrameSocket | None:
        """Its socket, when all that is to be sent before the next frame has been sent; None if there is none now."""
