"""From the names that a person types to a robot at the end of a link."""

import socket
from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import dataclass

from host_sim.backends.images import BOARDS
from host_sim.backends.qemu import Qemu
from host_sim.backends.robot_process import RobotProcess
from host_sim.errors import UsageError
from host_sim.protocol.codec import Protocol
from host_sim.transport.buses import open_bus
from host_sim.transport.in_process_link import InProcessLink
from host_sim.transport.link import BusLink, Link
from host_sim.transport.socket_pair_bus import SocketPairBus

_EMULATORS = ("qemu", "emulated")
_IMAGE_NODE = 1


@dataclass(frozen=True)
class Connection:
    """A robot within reach.

    Attributes:
        link: Carries frames to it and back.
        bus: The bus's name, as the summary gives it.
        status: Tells how the robot's process is, and raises RobotError if it has ended.
        pid: Number of that process; None if it is not ours.
    """

    link: Link
    bus: str
    status: Callable[[], str]
    pid: int | None = None


def connect(  # noqa: PLR0913, PLR0917 - what a person can say about it
    stack: ExitStack, bus: str, robot: str, node: int, board: str = "", shared: bool = False
) -> Connection:
    """Opens a bus and, unless it is there already, starts a robot on it.

    Args:
        stack: Ends all that is opened here when it closes.
        bus: `none`, `fd`, or a python-can `INTERFACE:CHANNEL`. Robots in emulators bring their own: any but the last.
        robot: `spawn` to start one, `external` for one that is on the bus, `qemu` or `emulated` for the image that
            is flashed.
        node: 1..63.
        board: One of `BOARDS`, for an emulated robot; empty for the first.
        shared: Whether other robots of this run are on the bus, each with a connection of its own.

    Raises:
        UsageError: The names make no sense together, or the bus cannot be opened.
        OctetError: Something to be built or installed is not there.
        RobotError: The robot does not start.
    """
    if robot in _EMULATORS:
        return _in_emulator(stack, bus, robot, node, board or BOARDS[0])
    if bus in ("none", "fd") and robot == "external":
        raise UsageError(f"--robot external needs a bus that it is on: --bus INTERFACE:CHANNEL, not --bus {bus}")
    if bus == "none":
        return Connection(InProcessLink(node), bus, lambda: "runs in this process")
    if bus == "fd":
        return _over_socket_pair(stack, node)
    if shared and bus.partition(":")[0] != "socketcan":
        raise UsageError(f"several robots can be on socketcan, fd or none, not on {bus}: leave out --robots")
    return _over_bus(stack, bus, robot, node)


def _in_emulator(stack: ExitStack, bus: str, robot: str, node: int, board: str) -> Connection:
    if bus not in ("none", "fd"):
        raise UsageError(
            f"--robot {robot} brings its own bus: leave out --bus {bus}; or put a board on that one with"
            f" python -m host_sim.emulator --bus {bus}, and say --robot external"
        )
    if node != _IMAGE_NODE:
        raise UsageError(f"the image that is flashed is node {_IMAGE_NODE}, not {node}: leave out --node, --robots")
    return _in_qemu(stack) if robot == "qemu" else _on_emulated_board(stack, board)


def _in_qemu(stack: ExitStack) -> Connection:
    qemu = Qemu()
    stack.callback(qemu.close)
    return Connection(qemu.link, "qemu", qemu.status, qemu.pid)


def _on_emulated_board(stack: ExitStack, name: str) -> Connection:
    from host_sim.emulator.board import start_board  # noqa: PLC0415 - says what to install if Unicorn is missing

    board = start_board(name)
    stack.callback(board.close)
    return Connection(board, f"emulated {name}", board.status)


def _over_socket_pair(stack: ExitStack, node: int) -> Connection:
    ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    with theirs:
        link = BusLink(SocketPairBus(ours.detach()))
        stack.callback(link.close)
        process = RobotProcess(f"fd:{theirs.fileno()}", node, [theirs.fileno()])
    stack.callback(process.close)
    return Connection(link, "fd", process.status, process.pid)


def _over_bus(stack: ExitStack, bus: str, robot: str, node: int) -> Connection:
    link = BusLink(open_bus(bus, Protocol(node).ids_from("ROBOT")))
    stack.callback(link.close)
    interface = bus.partition(":")[0]
    if robot == "external":
        return Connection(link, bus, lambda: "is not ours to watch")
    if interface != "socketcan":
        raise UsageError(f"a robot can be started on socketcan or fd, not on {interface}: say --robot external")
    process = RobotProcess(bus, node)
    stack.callback(process.close)
    return Connection(link, bus, process.status, process.pid)
