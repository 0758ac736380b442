"""Connects to the robot that the command line names; starts it first if necessary."""

from collections.abc import Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING

from host_sim.backends.bus_choice import check_robot
from host_sim.backends.bus_lines import BusLines
from host_sim.backends.images import BOARDS
from host_sim.backends.in_process_link import InProcessLink
from host_sim.backends.relay import RelayedLink
from host_sim.client.connection import Connection
from host_sim.transport.line_stats import LineStats

if TYPE_CHECKING:
    from host_sim.backends.robot_process import RobotProcess

_EMULATED_S = 30.0
"""Timeout for emulators, which may be slow on a busy machine, s."""


def connect(  # noqa: PLR0913, PLR0917 - the options of the command line
    stack: ExitStack,
    bus: str,
    robot: str,
    node: int,
    board: str = "",
    lines: BusLines | None = None,
    *,
    pins: bool = False,
) -> Connection:
    """Opens a bus and, unless the robot is external, starts a robot on it.

    Args:
        stack: Closes everything that is opened here.
        bus: `none`, `fd`, or python-can's `INTERFACE:CHANNEL`; for emulated robots, which bring their own bus, `none`
            or `fd`.
        robot: `spawn` to start the firmware, `external` for a robot that is on the bus already, `qemu` or `emulated`
            to run the flash image.
        node: Node number of the robot, 1..31.
        board: One of `BOARDS`, for an emulated robot; empty for the first.
        lines: The lines to all robots of this run on that bus; by default, this one is alone.
        pins: Whether an emulated robot senses and drives by itself, through its pins.

    Raises:
        UsageError: The options contradict each other, or the bus cannot be opened.
        OctetError: Something that must be built or installed is missing.
        RobotError: The robot does not start.
    """
    check_robot(bus, robot, [node])
    if robot == "qemu":
        return _in_qemu(stack)
    if robot == "emulated":
        return (_on_pins if pins else _on_emulated_board)(stack, board or BOARDS[0])
    lines = lines or BusLines(bus, [node])
    if lines.command:
        return _of_ones_own(stack, lines, node)
    if bus == "none":
        return _in_process(lines, node)
    if bus == "fd":
        return _over_socket_pair(stack, node, lines)
    return _over_bus(stack, lines, robot, node)


# Modules are loaded on demand: a run in this process starts faster without python-can and processes.


def _in_qemu(stack: ExitStack) -> Connection:
    from host_sim.backends.qemu import Qemu  # noqa: PLC0415 - see above

    qemu = Qemu()
    stack.callback(qemu.close)
    qemu.link.explain = qemu.account_for_silence
    return Connection(qemu.link, "qemu", qemu.status, qemu.pid, deadline_s=_EMULATED_S)


def _on_emulated_board(stack: ExitStack, name: str) -> Connection:
    from host_sim.emulator.board import start_board  # noqa: PLC0415 - says what to install if Unicorn is missing

    board = start_board(name, boot=True)
    stack.callback(board.close)
    return Connection(board, f"emulated {name}", board.status, deadline_s=_EMULATED_S)


def _on_pins(stack: ExitStack, name: str) -> Connection:
    from host_sim.emulator.pins_board import start_robot  # noqa: PLC0415 - see above

    board = start_robot(name)
    stack.callback(board.close)
    bus = f"emulated {name} on its pins"
    return Connection(board, bus, board.status, deadline_s=_EMULATED_S, sense=board.sense, pins=board.robot.figures)


def _of_ones_own(stack: ExitStack, lines: BusLines, node: int) -> Connection:
    from host_sim.backends.own_robot import own_robot  # noqa: PLC0415 - see above

    return own_robot(stack, lines, node)


def _in_process(lines: BusLines, node: int) -> Connection:
    if not lines.program:
        link = InProcessLink(node, relay=lines.relay)
        return Connection(link, lines.bus, lambda: "runs in this process", answers_at_once=True)
    from host_sim.backends.programmed_robot import ProgrammedLink  # noqa: PLC0415 - see above

    programmed = ProgrammedLink(Path(lines.program), node, lines.relay)
    return Connection(programmed, lines.bus, programmed.status, answers_at_once=True)


def _process(link: str, node: int, brain: str, pass_fds: Sequence[int] = ()) -> "RobotProcess":
    from host_sim.backends.programmed_robot import PROCESS  # noqa: PLC0415 - see above
    from host_sim.backends.robot_process import PROGRAM, RobotProcess  # noqa: PLC0415 - see above

    return RobotProcess(link, node, pass_fds, PROCESS if brain else PROGRAM, brain)


def _over_socket_pair(stack: ExitStack, node: int, lines: BusLines) -> Connection:
    import socket  # noqa: PLC0415 - see above

    from host_sim.transport.socket_pair import SocketPairLink  # noqa: PLC0415 - see above

    ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    line = LineStats()
    with theirs:
        link = SocketPairLink(ours, line)
        stack.callback(link.close)
        process = _process(f"fd:{theirs.fileno()}", node, lines.program, [theirs.fileno()])
    stack.callback(process.close)
    link.explain = process.account_for_silence
    relay = lines.relay
    return Connection(RelayedLink(link, relay, node) if relay else link, "fd", process.status, process.pid, line)


def _over_bus(stack: ExitStack, lines: BusLines, robot: str, node: int) -> Connection:
    bus = lines.bus
    link, line = lines.open(stack, node)
    if robot == "external":
        return Connection(link, bus, lambda: "was not started here", line=line)
    process = _process(bus, node, lines.program)
    stack.callback(process.close)
    return Connection(link, bus, process.status, process.pid, line)
