"""Relays memories between robots that have a line each, as a shared bus would."""

from collections.abc import Iterable
from dataclasses import dataclass

from host_sim.protocol.codec import MEMORY_IDS, Frame
from host_sim.transport.link import FrameSocket, Link, SocketLink


class Relay:
    """Passes memories on. Each robot hears those of the others, in order, before the next frame for itself."""

    def __init__(self, nodes: Iterable[int]) -> None:
        """Starts with nothing to pass on.

        Args:
            nodes: The robots.
        """
        self._waiting: dict[int, list[Frame]] = {node: [] for node in nodes}

    def hear(self, node: int, frame: Frame) -> None:
        """Notes a frame sent by a robot, if it is for the others."""
        if frame.id not in MEMORY_IDS:
            return
        for other, waiting in self._waiting.items():
            if other != node:
                waiting.append(frame)

    def take(self, node: int) -> list[Frame]:
        """Returns, once, the frames that a robot has not received yet."""
        waiting, self._waiting[node] = self._waiting[node], []
        return waiting


@dataclass(frozen=True)
class RelayedLink:
    """A link to a robot that receives memories from others.

    Attributes:
        link: Carries the frames.
        relay: Relays memories between the robots.
        node: The robot.
    """

    link: Link
    relay: Relay
    node: int

    def send(self, frame: Frame) -> None:
        """As in `Link`."""
        self._pass_on()
        self.link.send(frame)

    def receive(self, timeout_s: float) -> Frame | None:
        """As in `Link`."""
        frame = self.link.receive(timeout_s)
        if frame is not None:
            self.relay.hear(self.node, frame)
        return frame

    def frame_socket(self) -> FrameSocket | None:
        """As in `SocketLink`."""
        self._pass_on()
        return self.link.frame_socket() if isinstance(self.link, SocketLink) else None

    def _pass_on(self) -> None:
        for heard in self.relay.take(self.node):
            self.link.send(heard)

    def close(self) -> None:
        """As in `Link`."""
        self.link.close()
