"""A robot in a process of its own on an independent line: the robot can restart, and the line can drop and return."""

import subprocess
import threading
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

from host_sim.base.errors import UsageError
from host_sim.lab.campaign.host_events import process_events
from host_sim.lab.campaign.setup import Happen, Setup
from host_sim.sim.robot_process import RobotProcess
from host_sim.sim.run_config import RunConfig
from host_sim.transport.cable import Cable, Socket

_BUS = "vcan0"


class OnLine(Setup):
    """The setup of a robot at one end of a line, `link`; the simulator is at the other end, `bus`."""

    def __init__(self, link: str, bus: str, events: Mapping[str, Happen]) -> None:
        self._link, self._bus = link, bus
        self.robot = RobotProcess(link, 1)
        own: Mapping[str, Happen] = {"reset": lambda _: self._restart()}
        self.events = {**process_events(lambda: self.robot.pid), **own, **events}
        self.of_opener = {*self.events} - {"hold-up"}  # it has the line's threads, and is the robot's parent

    def configured(self, config: RunConfig) -> RunConfig:
        """As in `Setup`."""
        return replace(config, bus=self._bus, robot="external")

    def _restart(self) -> None:
        self.robot.close()
        self.robot = RobotProcess(self._link, 1)


@contextmanager
def serial_line() -> Iterator[OnLine]:
    """Sets up a robot with slcan on a serial line."""
    with TemporaryDirectory() as folder, ExitStack() as stack:
        cable, socket = Cable(), Socket(Path(folder) / "tty")
        stack.callback(cable.close)
        socket.plug(cable.ends[1])

        def plug() -> None:
            cable.plug()
            socket.plug(cable.ends[1])

        def unplug(span_ms: int) -> None:
            socket.unplug()
            cable.unplug()
            _later(stack, span_ms, plug)

        def disturb(percent: int) -> None:
            cable.noise = percent / 100

        setup = OnLine(f"slcan:{cable.ends[0]}", f"slcan:{socket.path}", {"unplug": unplug, "noise": disturb})
        stack.callback(lambda: setup.robot.close())  # noqa: PLW0108 - the robot may be another one by then
        yield setup


@contextmanager
def virtual_bus() -> Iterator[OnLine]:
    """Sets up a robot on SocketCAN.

    Raises:
        UsageError: There is no vcan0.
    """
    if not Path(f"/sys/class/net/{_BUS}").exists():
        raise UsageError(f"there is no {_BUS} here: put tools/with-vcan before the command")

    with ExitStack() as stack:

        def go_down(span_ms: int) -> None:
            stack.callback(_set_bus, "up")
            _set_bus("down")
            _later(stack, span_ms, lambda: _set_bus("up"))

        _set_bus("up")
        setup = OnLine(f"socketcan:{_BUS}", f"socketcan:{_BUS}", {"bus-down": go_down})
        stack.callback(lambda: setup.robot.close())  # noqa: PLW0108 - the robot may be another one by then
        yield setup


def _set_bus(state: str) -> None:
    done = subprocess.run(["ip", "link", "set", _BUS, state], capture_output=True, text=True, check=False)
    if done.returncode:
        raise UsageError(f"cannot set {_BUS} {state}: {done.stderr.strip()}")


def _later(stack: ExitStack, span_ms: int, happen: Callable[[], None]) -> None:
    """Schedules an action after a span; it is cancelled if the stack is closed earlier: the line is gone then."""
    timer = threading.Timer(span_ms / 1000, happen)
    timer.start()
    stack.callback(timer.join)
    stack.callback(timer.cancel)
