"""Looks on while a robot runs by itself, without a word on the bus: what it senses, knows and does, and why."""

import shutil
import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, TextIO

from host_sim.base.errors import OctetError
from host_sim.client.frame_log import FrameLog
from host_sim.live.text_picture import View, draw_text
from host_sim.protocol.codec import Frame, Protocol
from host_sim.protocol.generated import CELL_COUNT, MESSAGES, PARAMETERS, Senses
from host_sim.recording.dead_reckoning import Reckoned, after
from host_sim.recording.recording import TickReader
from host_sim.recording.run_recorder import RunRecorder
from host_sim.transport.buses import open_bus
from host_sim.view.phrases import sentence
from host_sim.view.state_types import EnvironmentScene, State
from host_sim.world.geometry import Point, Pose
from host_sim.world.params import SimParams

if TYPE_CHECKING:
    import can

_WAIT_S, _DRAW_S = 0.1, 0.1
_TRAIL_MAX = 3000
_NOTHING: EnvironmentScene = {
    "number": 1, "of": 1, "seed": 0, "first_tick": 0, "start_tick": 0, "bars": [], "food": []
}  # fmt: skip
_HOME, _REST_OF_LINE, _REST_OF_SCREEN = "\x1b[H", "\x1b[K", "\x1b[J"
_ENTER, _LEAVE = "\x1b[?1049h\x1b[?25l", "\x1b[?25h\x1b[?1049l"
_KEYS = "Ctrl-C ends it. Nothing is sent to the robot.\nIts way is by its wheels alone, from where it was first seen."


@dataclass(frozen=True)
class Line:
    """Where the robot is heard.

    Attributes:
        bus: `INTERFACE:CHANNEL`.
        node: The robot's number there.
        bitrate: Bits a second, for an adapter that is set up when opened.
    """

    bus: str
    node: int
    bitrate: int


class Observer:
    """Follows one robot: its ticks, and its way from where it was first seen, the origin.

    Attributes:
        params: Its dimensions, as the simulated robot has them.
    """

    def __init__(self, node: int) -> None:
        """Knows nothing of the robot's memory until it is reported."""
        self.params = SimParams()
        self._node = node
        limit = PARAMETERS["boredom_limit"].default
        self._recorder = RunRecorder(self.params, limit, {node: (0,) * CELL_COUNT})
        self._recorder.enter(_NOTHING)
        self._pose = Pose(0.0, 0.0, 0.0)
        self._senses: Senses | None = None
        self._meals: list[Point] = []

    def follow(self, frames: Iterable[Frame]) -> Iterator[State]:
        """The robot's state after each tick, as frames come."""
        recorder, trajectory = self._recorder, self._recorder.trajectory
        for tick in TickReader(Protocol(self._node), bytes(CELL_COUNT)).read(frames):
            if self._senses is not None:
                self._pose = after(self._pose, self._senses, tick.senses, self.params)
            self._senses = tick.senses
            if tick.drive.eat:
                self._meals.append(self._pose[:2])
            recorder.between(0, tick.started, tick.written)
            recorder.histories[0].frozen = tick.frozen
            recorder.add(0, Reckoned(self._pose), tick.senses, tick.drive, tick.memory)
            yield trajectory.at(trajectory.ticks - 1)

    def view(self, state: State) -> View:
        """The picture of it: the robot in the middle, and around it where it came from and where it ate."""
        trajectory, middle = self._recorder.trajectory, (self.params.width_mm / 2, self.params.height_mm / 2)

        def placed(x: float, y: float) -> Point:
            return x - self._pose.x_mm + middle[0], y - self._pose.y_mm + middle[1]

        trail = trajectory.tracks[0].trail(max(trajectory.ticks - _TRAIL_MAX, 0), trajectory.ticks)
        food = [placed(*meal) for meal in self._meals]
        here: State = {**state, "x": middle[0], "y": middle[1], "eaten": [1] * len(food)}
        scene: EnvironmentScene = {**_NOTHING, "food": [list(it) for it in food]}
        trails = [[placed(x, y) for x, y, _ in trail]]
        return View(self.params, scene, [here], trails, trajectory.boredom_limit, "as it runs", _KEYS)


def observe(line: Line, log: FrameLog, out: TextIO, goes_on: Callable[[], bool]) -> None:
    """Follows a robot on a bus, and records what is said: on a terminal as a picture, else a line for each change.

    Args:
        line: Where it is.
        log: Takes the frames, timed from the first one.
        out: Where the picture or the lines go.
        goes_on: Asked again and again.

    Raises:
        UsageError: The bus cannot be opened.
        OctetError: The bus is gone, or the robot was not heard.
    """
    protocol, observer, draws = Protocol(line.node), Observer(line.node), out.isatty()
    ids = [protocol.id_of(name) for name in MESSAGES]
    heard, due_s = False, 0.0
    told: object = None
    with open_bus(line.bus, ids, line.bitrate) as bus:
        try:
            out.write(_ENTER * draws)
            for state in observer.follow(_frames(bus, log, goes_on)):
                heard = True
                if draws and time.monotonic() >= due_s:
                    due_s = time.monotonic() + _DRAW_S
                    _draw(observer.view(state), out)
                elif not draws and (what := (state["reason"], state["pattern"], state["memory"])) != told:
                    told = what
                    out.write(f"{state['tick'] * observer.params.tick_s:8.2f} s  {_line(state)}\n")
                    out.flush()
        finally:
            out.write(_LEAVE * draws)
    if not heard:
        raise OctetError(f"node {line.node} was not heard on {line.bus}: is the robot on, and its number right?")


def _frames(bus: "can.BusABC", log: FrameLog, goes_on: Callable[[], bool]) -> Iterator[Frame]:
    import can  # noqa: PLC0415 - other runs begin sooner without

    start_s: float | None = None
    while goes_on():
        try:
            message = bus.recv(_WAIT_S)
        except (can.CanError, OSError) as error:
            raise OctetError(f"the bus is gone: {error}") from None
        if message is None or message.is_error_frame or message.is_extended_id or message.is_remote_frame:
            continue
        start_s = message.timestamp if start_s is None else start_s
        frame = Frame(message.arbitration_id, bytes(message.data))
        log.set_time(round((message.timestamp - start_s) * 1e6))
        log.add(frame)
        yield frame


def _line(state: State) -> str:
    memory = "".join(".LR"[side] for side in state["memory"])
    place = f"{state['x']:.0f}, {state['y']:.0f} mm"
    return f"{place:14}  {memory}  {sentence(state)}"


def _draw(view: View, out: TextIO) -> None:
    columns, rows = shutil.get_terminal_size()
    shown = "\n".join(f"{line}{_REST_OF_LINE}" for line in draw_text(view, columns, rows - 1))
    out.write(f"{_HOME}{shown}\n{_REST_OF_SCREEN}")
    out.flush()
