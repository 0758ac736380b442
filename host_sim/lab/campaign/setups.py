"""The links of cells: the setups of a robot into which a campaign injects faults, and the events possible there."""

import os
import subprocess
import threading
from collections.abc import Callable, Collection, Iterator, Mapping
from contextlib import AbstractContextManager, closing, contextmanager, nullcontext
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

from host_sim.base.errors import UsageError
from host_sim.client.robot_client import RobotClient
from host_sim.lab.campaign.cell import PINS_LINK
from host_sim.lab.campaign.host_events import Trigger, process_events
from host_sim.sim.access import BOARDS
from host_sim.sim.robot_process import RobotProcess
from host_sim.sim.run_config import RunConfig
from host_sim.transport.cable import Cable, Socket
from host_sim.transport.rule import Event


class Setup:
    """A robot and its line: here one in this process, of which only the frames and the body can be faulty.

    Attributes:
        events: The possible events by name.
        opener_only: The events that only the process that opened this setup can trigger.
    """

    events: Mapping[str, Trigger] = {}
    opener_only: Collection[str] = ()

    def configured(self, config: RunConfig) -> RunConfig:
        """The configuration of a run with this robot."""
        return replace(config, bus="none")

    def found(self, client: RobotClient) -> None:
        """Called with the robot's client, once the robot has answered."""

    def settle(self) -> None:
        """Waits until a line that an event has interrupted is there again, so that another run can begin."""


_BUS = "vcan0"


class OnLine(Setup):
    """The setup of a robot at one end of a line, `link`; the simulator is at the other end, `bus`."""

    def __init__(self, link: str, bus: str, events: Mapping[str, Trigger]) -> None:
        self._link, self._bus = link, bus
        self._timers: list[threading.Timer] = []
        self.robot = RobotProcess(link, 1)
        own: Mapping[str, Trigger] = {"reset": lambda _: self._restart()}
        self.events = {**process_events(lambda: self.robot.pid), **own, **events}
        self.opener_only = {*self.events} - {"hold-up"}  # it has the line's threads, and is the robot's parent

    def configured(self, config: RunConfig) -> RunConfig:
        """As in `Setup`."""
        return replace(config, bus=self._bus, robot="external")

    def later(self, span_ms: int, action: Callable[[], None]) -> None:
        """Schedules an action on the line; `close` cancels it."""
        timer = threading.Timer(span_ms / 1000, action)
        timer.start()
        self._timers.append(timer)

    def settle(self) -> None:
        """As in `Setup`."""
        for timer in self._timers:
            timer.join()

    def close(self) -> None:
        """Ends the robot and all that is scheduled."""
        for timer in self._timers:
            timer.cancel()
        self.settle()
        self.robot.close()

    def _restart(self) -> None:
        self.robot.close()
        self.robot = RobotProcess(self._link, 1)


@contextmanager
def serial_line() -> Iterator[OnLine]:
    """Sets up a robot with slcan on a serial line."""
    with TemporaryDirectory() as folder, closing(Cable()) as cable:
        socket = Socket(Path(folder) / "tty")
        socket.plug(cable.ends[1])

        def plug() -> None:
            cable.plug()
            socket.plug(cable.ends[1])

        def unplug(span_ms: int) -> None:
            socket.unplug()
            cable.unplug()
            setup.later(span_ms, plug)

        def disturb(percent: int) -> None:
            cable.noise = percent / 100

        events = {"unplug": unplug, "noise": disturb}
        with closing(OnLine(f"slcan:{cable.ends[0]}", f"slcan:{socket.path}", events)) as setup:
            yield setup


@contextmanager
def virtual_bus() -> Iterator[OnLine]:
    """Sets up a robot on SocketCAN.

    Raises:
        UsageError: There is no vcan0.
    """
    if not Path(f"/sys/class/net/{_BUS}").exists():
        raise UsageError(f"there is no {_BUS} here: put tools/with-vcan before the command")

    def go_down(span_ms: int) -> None:
        _set_bus("down")
        setup.later(span_ms, lambda: _set_bus("up"))

    _set_bus("up")
    try:
        with closing(OnLine(f"socketcan:{_BUS}", f"socketcan:{_BUS}", {"bus-down": go_down})) as setup:
            yield setup
    finally:
        _set_bus("up")


def _set_bus(state: str) -> None:
    done = subprocess.run(["ip", "link", "set", _BUS, state], capture_output=True, text=True, check=False)
    if done.returncode:
        raise UsageError(f"cannot set {_BUS} {state}: {done.stderr.strip()}")


class SocketPair(Setup):
    """The setup of the firmware in a process of its own, which the run starts."""

    def __init__(self) -> None:
        self._before = _children()
        self._pid = 0
        self.events = process_events(lambda: self._pid)

    def configured(self, config: RunConfig) -> RunConfig:
        """As in `Setup`."""
        return replace(config, bus="fd")

    def found(self, client: RobotClient) -> None:  # noqa: ARG002 - as in `Setup`
        """As in `Setup`: the robot is the only new child of this process."""
        self._pid = self._only_child()

    def _only_child(self) -> int:
        (pid,) = _children() - self._before
        return pid


class OwnProgram(SocketPair):
    """The setup of a custom program."""

    def __init__(self, command: str) -> None:
        """Takes the program, which the run starts.

        Raises:
            UsageError: The command is empty.
        """
        if not command:
            raise UsageError("the link external needs --robot-command CMD, the robot")
        super().__init__()
        self._command = command
        # The whole process group, since a shell may have started the program; it changes with each restart.
        events = process_events(lambda: -self._only_child())
        self.events = {**events, "reset": events["kill"]}

    def configured(self, config: RunConfig) -> RunConfig:
        """As in `Setup`."""
        return replace(config, bus="fd", robot_command=self._command)


def _children() -> set[int]:
    path = Path(f"/proc/{os.getpid()}/task/{threading.get_native_id()}/children")
    return set(map(int, path.read_text(encoding="ascii").split()))


LINKS = ("none", "fd", "external", "slcan", "vcan", *BOARDS, PINS_LINK)
"""Robots in this process, on a socket pair, your own, on a serial line, on vcan0, on each board, and on its pins."""


def open_setup(link: str, command: str = "") -> AbstractContextManager[Setup]:
    """Sets up a robot; leaving the context ends it.

    Args:
        link: One of `LINKS`.
        command: The program of a custom robot.

    Raises:
        UsageError: There is no such link, or this machine does not have it.
        OctetError: Something that must be built or installed is missing.
    """
    if link in ("slcan", "vcan"):
        return serial_line() if link == "slcan" else virtual_bus()
    if link in (*BOARDS, PINS_LINK):
        from host_sim.lab.campaign.board_setup import Board, PinsRobot  # noqa: PLC0415 - needs the emulator

        return nullcontext(Board(link) if link in BOARDS else PinsRobot("blue_pill"))
    if link in ("none", "fd"):
        return nullcontext(Setup() if link == "none" else SocketPair())
    if link == "external":
        return nullcontext(OwnProgram(command))
    raise UsageError(f"there is no link {link!r}; there are {', '.join(LINKS)}")


def check_events(possible: Collection[str], link: str, events: tuple[Event, ...]) -> None:
    """Checks that events are among the possible ones of a link.

    Raises:
        UsageError: An event is not possible.
    """
    for event in events:
        if event.name not in possible:
            raise UsageError(f"{event.name} cannot action on {link}; what can: {', '.join(sorted(possible))}")
