"""The lines to the robots of a run on one bus: one per robot where the bus allows that, else a shared one."""

from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from host_sim.backends.relay import Relay
from host_sim.protocol.codec import Protocol
from host_sim.transport.bit_rates import BIT_RATE
from host_sim.transport.line_stats import LineStats
from host_sim.transport.link import Link

if TYPE_CHECKING:
    from host_sim.transport.shared_line import SharedLine


@dataclass
class BusLines:
    """Opens lines to robots on a bus.

    Attributes:
        bus: python-can's `INTERFACE:CHANNEL`.
        nodes: The robots.
        bitrate: Bits a second, for a bus that is set up when opened.
        reconnect_s: Time to wait for a bus that is gone, s of wall-clock time.
        command: Program to start as each robot; empty for the firmware.
        program: The file with the program that is each robot's brain; empty for the firmware's own.
        relay: Relays memories between the robots if there is no bus; None for one robot.
    """

    bus: str
    nodes: Sequence[int]
    bitrate: int = BIT_RATE
    reconnect_s: float = 0.0
    command: str = ""
    program: str = ""
    relay: Relay | None = field(init=False)
    _shared: "SharedLine | None" = None
    _shared_stats: LineStats = field(default_factory=LineStats)

    def __post_init__(self) -> None:
        self.relay = Relay(self.nodes) if len(self.nodes) > 1 else None

    def open(self, stack: ExitStack, node: int) -> tuple[Link, LineStats]:
        """Opens the line to a robot; returns it with its statistics.

        Args:
            stack: Closes what is opened here.
            node: The robot, one of `nodes`.

        Raises:
            UsageError: The bus cannot be opened.
        """
        if len(self.nodes) == 1 or self.bus.startswith("socketcan:"):
            stats = LineStats()
            return self._opened(stack, [node], stats), stats
        if self._shared is None:
            from host_sim.transport.shared_line import SharedLine  # noqa: PLC0415 - only for a bus that lines share

            line = self._opened(stack, self.nodes, self._shared_stats)
            self._shared = SharedLine(line, {other: _ids(other) for other in self.nodes})
        return self._shared.share(node), self._shared_stats

    def _opened(self, stack: ExitStack, nodes: Sequence[int], stats: LineStats) -> Link:
        # Loaded on demand: a run in this process needs neither, and python-can takes a quarter of the import time.
        from host_sim.transport.buses import open_bus_link  # noqa: PLC0415 - see above
        from host_sim.transport.reconnecting_link import ReconnectingLink  # noqa: PLC0415 - see above

        ids = [frame_id for node in nodes for frame_id in _ids(node)]
        link = ReconnectingLink(
            f"the bus {self.bus}", lambda: open_bus_link(self.bus, ids, stats, self.bitrate), stats, self.reconnect_s
        )
        stack.callback(link.close)
        return link


def _ids(node: int) -> list[int]:
    """The identifiers to listen for, including simulators' messages: their sender commands the same robot."""
    protocol = Protocol(node)
    return [*protocol.ids_from("ROBOT"), *protocol.ids_from("SIM")]
