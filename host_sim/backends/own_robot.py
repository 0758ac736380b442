"""A user's own robot: a program that is started here, monitored, and restarted when it ends."""

from collections.abc import Callable
from contextlib import ExitStack, suppress
from dataclasses import dataclass

from host_sim.backends.bus_lines import BusLines
from host_sim.backends.relay import RelayedLink
from host_sim.base.errors import LinkDownError, UsageError
from host_sim.base.frame import Frame
from host_sim.client.connection import Connection
from host_sim.transport.bus_process import BusProcess, start_on_socket_pair
from host_sim.transport.line_stats import LineStats
from host_sim.transport.link import Link
from host_sim.transport.reconnecting_link import ReconnectingLink
from host_sim.transport.socket_pair import SocketPairLink

BOOT_S = 10.0
"""Time within which a robot must send its first frame, s."""

_SLICE_S = 0.1


@dataclass
class OwnRobot:
    """The program.

    Attributes:
        command: Program and arguments.
        node: The robot's node number.
        process: The running program; None before the first start.
        was_there: Whether it has ever sent a frame.
    """

    command: str
    node: int
    process: BusProcess | None = None
    was_there: bool = False

    @property
    def environment(self) -> dict[str, str]:
        """Its environment variables, apart from those for the bus."""
        return {"OCTET_NODE": str(self.node)}

    def on_socket_pair(self, stats: LineStats) -> SocketPairLink:
        """Starts or restarts it, and waits for its first frame.

        Raises:
            UsageError: It has never sent a frame.
            LinkDownError: It has ended again, or stays silent.
        """
        self.close()
        link, self.process = start_on_socket_pair(self.command, self.environment, stats)
        try:
            link.put_back(self._first_word(link.receive))
        except BaseException:
            link.close()
            raise
        return link

    def on_bus(self, bus: str, link: Link) -> None:
        """Starts it on a bus, and waits for its first frame.

        Raises:
            UsageError: It has never sent a frame.
            LinkDownError: As for `on_socket_pair`.
        """
        self.process = BusProcess(self.command, bus, self.environment)
        self._first_word(link.receive)

    def status(self) -> str:
        """As in `Connection`."""
        assert self.process is not None
        return self.process.status()

    def close(self) -> None:
        """Kills it."""
        if self.process is not None:
            self.process.close()

    def _first_word(self, receive: Callable[[float], Frame | None]) -> Frame:
        for _ in range(round(BOOT_S / _SLICE_S)):
            try:
                frame = receive(_SLICE_S)
                self.status()
            except LinkDownError as error:
                if self.was_there:
                    raise
                raise UsageError(f"the robot {error}") from None
            if frame is not None:
                self.was_there = True
                return frame
        silent = f"the robot {self.command!r} says nothing within {BOOT_S:g} s: at power-up it sends BOOT"
        raise LinkDownError(silent) if self.was_there else UsageError(silent)


@dataclass
class _WatchedLink:
    """A link over a bus that restarts the robot's program when it has ended: a bus does not report that."""

    link: Link
    robot: OwnRobot
    bus: str
    stats: LineStats

    def send(self, frame: Frame) -> None:
        """As in `Link`."""
        self.link.send(frame)

    def receive(self, timeout_s: float) -> Frame | None:
        """As in `Link`."""
        frame = self.link.receive(timeout_s)
        if frame is None:
            try:
                self.robot.status()
            except LinkDownError as error:
                self.stats.outages, self.stats.reason = self.stats.outages + 1, str(error)
                self.robot.close()
                with suppress(LinkDownError):  # it has ended again or is silent; the next start may succeed
                    self.robot.on_bus(self.bus, self.link)
        return frame

    def close(self) -> None:
        """As in `Link`."""
        self.link.close()


def own_robot(stack: ExitStack, lines: BusLines, node: int) -> Connection:
    """Starts `lines.command` as a robot.

    Args:
        stack: Closes everything that is opened here.
        lines: The lines to all robots of this run.
        node: The robot's node number.

    Raises:
        UsageError: It cannot be started, ends at once, or sends nothing; or the bus cannot be opened.
    """
    robot = OwnRobot(lines.command, node)
    stack.callback(robot.close)
    link: Link
    if lines.bus == "fd":
        stats = LineStats()
        link = ReconnectingLink("the robot", lambda: robot.on_socket_pair(stats), stats, lines.reconnect_s)
        stack.callback(link.close)
        relay = lines.relay
        return Connection(RelayedLink(link, relay, node) if relay else link, "fd", robot.status, line=stats)
    link, stats = lines.open(stack, node)
    robot.on_bus(lines.bus, link)
    return Connection(_WatchedLink(link, robot, lines.bus, stats), lines.bus, robot.status, line=stats)
