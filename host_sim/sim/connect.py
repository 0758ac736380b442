"""Connects to the robots of a run; starts them first if necessary."""

import os
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from host_sim.client.commands import handshake
from host_sim.client.connection import Connection
from host_sim.client.frame_log import FrameLog
from host_sim.client.robot_client import RobotClient
from host_sim.protocol.codec import Protocol
from host_sim.sim.access import BOARDS, PICO, Access
from host_sim.sim.in_process_link import InProcessLink, Relay, RelayedLink
from host_sim.transport.link import LineStats, Link, VirtualClock, WallClock

if TYPE_CHECKING:
    from host_sim.emulator.board import EmulatedBoard
    from host_sim.emulator.pins_board import SensesByPins
    from host_sim.sim.debugger import Gdb
    from host_sim.sim.qemu import SerialEmulator
    from host_sim.sim.robot_process import RobotProcess
    from host_sim.transport.shared_line import SharedLine

_EMULATED_S = 30.0
"""Timeout for emulators, which may be slow on a busy machine, s."""

_EXTERNAL_S = 15.0
_IN_DEBUGGER_S = 1e9
"""Timeout for a robot in a debugger, which may stand at a breakpoint, s."""

# Modules are loaded on demand: a run in this process starts faster without python-can and processes.


class Connector:
    """Opens the bus of a run and, unless its robots are external, starts them on it."""

    def __init__(self, stack: ExitStack, access: Access) -> None:
        """Opens nothing yet.

        Args:
            stack: Closes everything that is opened here.
            access: How the robots are reached.
        """
        self._stack, self._access = stack, access
        self._relay = Relay(access.nodes) if len(access.nodes) > 1 else None
        self._shared: SharedLine | None = None
        self._shared_stats = LineStats()
        self._ways = {"qemu": self._in_qemu, "emulated": self._on_emulated_board, "none": self._in_process}
        self._ways["fd"] = self._over_socket_pair
        if access.own and not access.fast:
            self._ways["none"] = self._over_socket_pair
        if access.command:
            self._ways["spawn"] = self._own_program

    def client(self, node: int, log: FrameLog, *, senses_itself: bool = False) -> RobotClient:
        """Connects to one of the robots. It is stopped and identified, but not started.

        Args:
            node: Its number.
            log: Records the frames.
            senses_itself: Whether an external robot has a body of its own; then senses on the bus are its own.

        Raises:
            UsageError: The bus cannot be opened, or the robot cannot be started.
            OctetError: Something that must be built or installed is missing.
            RobotError: The robot does not answer.
        """
        access, protocol, connection = self._access, Protocol(node), self.connection(node)
        external = access.robot == "external"
        if access.faults:
            connection = self._with_faults(connection, protocol)
        if senses_itself and connection.sense is None:
            connection = replace(connection, sense=lambda _body, senses, _tick: senses)
        client = RobotClient(connection, protocol, log, lockstep=access.lockstep, owner=access.owner)
        client.deadlines.limits = access.limits
        handshake(client, _EXTERNAL_S if external else connection.deadline_s, shared=external and not senses_itself)
        return client

    def connection(self, node: int) -> Connection:
        """Connects to one of the robots, without sending anything to it; raises as `client` does."""
        way = self._ways.get(self._access.robot) or self._ways.get(self._access.bus, self._over_bus)
        return way(node)

    def _with_faults(self, connection: Connection, protocol: Protocol) -> Connection:
        """Adds the requested faults to a connection.

        For a robot in this process, delays are simulated on a virtual clock and cost no wall time.
        """
        from host_sim.protocol.forgery import forgers  # noqa: PLC0415 - see above
        from host_sim.transport.faulty_link import FaultyLink, Schedule  # noqa: PLC0415 - see above

        clock = VirtualClock() if connection.answers_at_once else WallClock()
        schedule = Schedule(self._access.faults, self._access.fault_seed, forgers(protocol))
        return replace(connection, link=FaultyLink(connection.link, schedule, clock), now=clock.now)

    def _in_qemu(self, _: int) -> Connection:
        from host_sim.sim.qemu import IMAGE, Qemu  # noqa: PLC0415 - see above

        if self._access.gdb:
            return self._in_qemu_with_gdb()
        return self._in_emulator(Qemu(self._image(*IMAGE)), "qemu")

    def _image(self, board: str, link: str) -> Path:
        """The flash image of a board, with the user's behaviour if there is one."""
        from host_sim.base.paths import image_path  # noqa: PLC0415 - see above

        return self._access.own.image(board, link) if self._access.own else image_path(board, link)

    def _in_emulator(self, emulator: "SerialEmulator", name: str) -> Connection:
        self._stack.callback(emulator.close)
        emulator.link.explain = emulator.account_for_silence
        return Connection(emulator.link, name, emulator.status, pid=emulator.pid, deadline_s=_EMULATED_S)

    def _in_qemu_with_gdb(self) -> Connection:
        from host_sim.sim.qemu import IMAGE, Qemu  # noqa: PLC0415 - see above

        image, path = self._image(*IMAGE), self._gdb_socket()
        qemu = Qemu(image, gdb=path)
        self._stack.callback(qemu.close)
        gdb = self._attach_gdb(image, path)
        qemu.link.explain = gdb.account_for_silence
        return Connection(qemu.link, "qemu", gdb.status, pid=qemu.pid, deadline_s=_IN_DEBUGGER_S)

    def _gdb_socket(self) -> Path:
        return Path(self._stack.enter_context(TemporaryDirectory(prefix="octet-gdb-"))) / "gdb"

    def _attach_gdb(self, image: Path, path: Path) -> "Gdb":
        """Starts gdb on the socket of an emulator that runs an image."""
        from host_sim.base.paths import ROOT  # noqa: PLC0415 - see above
        from host_sim.sim.debugger import Gdb  # noqa: PLC0415 - see above

        attach = ["-d", os.fspath(ROOT), "-ex", f"target remote {path}", "-ex", "break respond_to_senses"]
        gdb = Gdb([os.fspath(image), *attach], "gdb-multiarch")
        self._stack.callback(gdb.close)
        return gdb

    def _in_gdb(self, node: int, link: str, pass_fds: Sequence[int]) -> "Gdb":
        from host_sim.sim.debugger import OCTET_ROBOT, Gdb, debug_program  # noqa: PLC0415 - see above

        own = self._access.own
        program, where = (own.process, "own_next") if own else (debug_program(OCTET_ROBOT), "robot.c:step")
        robot = [os.fspath(program), "--with-parent", "--node", str(node), link]
        gdb = Gdb(["-ex", f"break {where}", "-ex", "run", "--args", *robot], pass_fds=pass_fds)
        self._stack.callback(gdb.close)
        return gdb

    def _on_emulated_board(self, _: int) -> Connection:
        if self._access.board == PICO and self._access.pins:
            from host_sim.sim.pico_pins import PicoOnPins  # noqa: PLC0415 - see above

            return self._on_pins(PicoOnPins(self._image(PICO, "pins").with_suffix(".bin")), PICO)
        if self._access.board == PICO:
            from host_sim.sim.pico import Pico  # noqa: PLC0415 - see above

            return self._in_emulator(Pico(self._image(PICO, "slcan").with_suffix(".bin")), f"emulated {PICO}")
        from host_sim.emulator.board import start_board  # noqa: PLC0415 - says what to install if Unicorn is missing
        from host_sim.emulator.pins_board import start_robot  # noqa: PLC0415 - see above

        name = self._access.board or BOARDS[0]
        if self._access.pins:
            return self._on_pins(start_robot(name, image=self._image), name)
        board = start_board(name, image=self._image)
        self._stack.callback(board.close)
        connection = Connection(board, f"emulated {name}", board.status, deadline_s=_EMULATED_S)
        return self._with_gdb(connection, board) if self._access.gdb else connection

    def _with_gdb(self, connection: Connection, board: "EmulatedBoard") -> Connection:
        from host_sim.emulator.gdb_stub import GdbStub  # noqa: PLC0415 - see above

        path = self._gdb_socket()
        stub = GdbStub(board.hardware.core, path)
        self._stack.callback(stub.close)
        stub.check_client = self._attach_gdb(board.image, path).status
        return replace(connection, deadline_s=_IN_DEBUGGER_S)

    def _on_pins(self, board: "SensesByPins", name: str) -> Connection:
        self._stack.callback(board.close)
        connection = Connection(board, f"emulated {name} on its pins", board.status, deadline_s=_EMULATED_S)
        return replace(connection, sense=board.sense, pins=board.robot.figures)

    def _own_program(self, node: int) -> Connection:
        from host_sim.sim.robot_process import OwnRobot, WatchedLink  # noqa: PLC0415 - see above

        bus, robot = self._access.bus, OwnRobot(self._access.command, node)
        self._stack.callback(robot.close)
        if bus == "fd":
            stats = LineStats()
            link = self._reconnecting("the robot", lambda: robot.on_socket_pair(stats), stats)
            return Connection(self._relayed(link, node), bus, robot.status, line=stats)
        link, stats = self._line(node)
        robot.on_bus(bus, link)
        return Connection(WatchedLink(link, robot, bus, stats), bus, robot.status, line=stats)

    def _in_process(self, node: int) -> Connection:
        brain = self._access.own or self._access.program
        link = brain.robot(node, relay=self._relay) if brain else InProcessLink(node, relay=self._relay)
        return Connection(link, self._access.bus, link.status, link.printed, answers_at_once=True)

    def _over_socket_pair(self, node: int) -> Connection:
        import socket  # noqa: PLC0415 - see above

        from host_sim.transport.socket_pair import SocketPairLink  # noqa: PLC0415 - see above

        ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        line = LineStats()
        with theirs:
            link = SocketPairLink(ours, line)
            self._stack.callback(link.close)
            if self._access.gdb:
                gdb = self._in_gdb(node, f"fd:{theirs.fileno()}", [theirs.fileno()])
                link.explain = gdb.account_for_silence
                return Connection(link, "fd", gdb.status, line=line, deadline_s=_IN_DEBUGGER_S)
            process = self._process(f"fd:{theirs.fileno()}", node, [theirs.fileno()])
        link.explain = process.account_for_silence
        return Connection(self._relayed(link, node), "fd", process.status, process.printed, process.pid, line)

    def _over_bus(self, node: int) -> Connection:
        bus = self._access.bus
        link, line = self._line(node)
        if self._access.robot == "external":
            return Connection(link, bus, lambda: "was not started here", line=line)
        process = self._process(bus, node)
        return Connection(link, bus, process.status, process.printed, process.pid, line)

    def _process(self, link: str, node: int, pass_fds: Sequence[int] = ()) -> "RobotProcess":
        from host_sim.sim.robot_process import PROGRAM, RobotProcess  # noqa: PLC0415 - see above

        brain = self._access.own or self._access.program
        process = RobotProcess(link, node, pass_fds, brain.command if brain else [PROGRAM])
        if self._access.own:
            process.mistake = self._access.own.mistake
        self._stack.callback(process.close)
        return process

    def _relayed(self, link: Link, node: int) -> Link:
        return RelayedLink(link, self._relay, node) if self._relay else link

    def _line(self, node: int) -> tuple[Link, LineStats]:
        """The line to a robot on a bus, with its statistics: one per robot where the bus allows that, else shared."""
        nodes = self._access.nodes
        if len(nodes) == 1 or self._access.bus.startswith("socketcan:"):
            stats = LineStats()
            return self._on_bus([node], stats), stats
        if self._shared is None:
            from host_sim.transport.shared_line import SharedLine  # noqa: PLC0415 - only for a bus that lines share

            line = self._on_bus(nodes, self._shared_stats)
            self._shared = SharedLine(line, {other: _ids(other) for other in nodes})
        return self._shared.share(node), self._shared_stats

    def _on_bus(self, nodes: Sequence[int], stats: LineStats) -> Link:
        # Loaded on demand: python-can takes a quarter of the import time.
        from host_sim.transport.buses import open_bus_link  # noqa: PLC0415 - see above

        ids, access = [frame_id for node in nodes for frame_id in _ids(node)], self._access
        return self._reconnecting(
            f"the bus {access.bus}", lambda: open_bus_link(access.bus, ids, stats, access.bitrate), stats
        )

    def _reconnecting(self, what: str, reopen: Callable[[], Link], stats: LineStats) -> Link:
        from host_sim.transport.reconnecting_link import ReconnectingLink  # noqa: PLC0415 - see above

        link = ReconnectingLink(what, reopen, stats, self._access.reconnect_s)
        self._stack.callback(link.close)
        return link


def _ids(node: int) -> list[int]:
    """The identifiers to listen for, including simulators' messages: their sender commands the same robot."""
    protocol = Protocol(node)
    return [*protocol.ids_from("ROBOT"), *protocol.ids_from("SIM")]
