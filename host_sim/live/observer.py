"""Observes a robot that runs by itself, without sending anything: its senses, memory, actions and reasons."""

import shutil
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, TextIO

from host_sim.base.errors import OctetError
from host_sim.client.frame_log import FrameLog
from host_sim.live.text_picture import View, draw_text
from host_sim.protocol.codec import Frame, Protocol
from host_sim.protocol.generated import CELL_COUNT, MESSAGES, PARAMETERS, Senses
from host_sim.recording.phrases import sentence
from host_sim.recording.recording import TickReader, after
from host_sim.recording.run_recorder import RunRecorder
from host_sim.recording.state_types import EnvironmentScene, State
from host_sim.transport.buses import open_bus, receive
from host_sim.world.geometry import Point, Pose, SimParams

if TYPE_CHECKING:
    import can

_WAIT_S, _DRAW_S = 0.1, 0.1
_HOME, _REST_OF_LINE, _REST_OF_SCREEN = "\x1b[H", "\x1b[K", "\x1b[J"
_ENTER, _LEAVE = "\x1b[?1049h\x1b[?25l", "\x1b[?25h\x1b[?1049l"
_TRAIL_MAX = 3000
_PART_TICKS = 50_000
"""Ticks after which earlier ones may be forgotten: an observation has no environments to forget."""

_NOTHING: EnvironmentScene = {
    "number": 1, "of": 1, "seed": 0, "first_tick": 0, "start_tick": 0, "bars": [], "food": []
}  # fmt: skip
_KEYS = (
    "Ctrl-C ends it. Nothing is sent to the robot.\n"
    "Its path comes from its wheels alone, from where it was first seen."
)


@dataclass(frozen=True)
class Line:
    """The line on which a robot is observed.

    Attributes:
        bus: `INTERFACE:CHANNEL`.
        node: The robot's number there.
        bitrate: Bits a second, for an adapter that is set up when opened.
    """

    bus: str
    node: int
    bitrate: int


class Observer:
    """Follows one robot: its ticks, and its path from the origin, where it was first seen.

    Attributes:
        params: Its dimensions, those of the simulated robot.
    """

    def __init__(self, node: int) -> None:
        """Starts without the robot's memory, until it is reported."""
        self.params = SimParams()
        self._node = node
        limit = PARAMETERS["boredom_limit"].default
        self._recorder = RunRecorder(self.params, limit, {node: (0,) * CELL_COUNT})
        self._recorder.enter(_NOTHING)
        self._pose = Pose(0.0, 0.0, 0.0)
        self._senses: Senses | None = None
        self._meals: list[Point] = []

    def follow(self, frames: Iterable[Frame]) -> Iterator[State]:
        """Yields the robot's state after each tick, as frames arrive."""
        recorder, trajectory = self._recorder, self._recorder.trajectory
        for tick in TickReader(Protocol(self._node), bytes(CELL_COUNT)).read(frames):
            if self._senses is not None:
                self._pose = after(self._pose, self._senses, tick.senses, self.params)
            self._senses = tick.senses
            if tick.drive.eat:
                self._meals.append(self._pose[:2])
            if trajectory.ticks - trajectory.scenes[-1][0] >= _PART_TICKS:
                recorder.enter({**_NOTHING, "first_tick": trajectory.ticks})
            recorder.add(0, tick, self._pose)
            yield trajectory.at(trajectory.ticks - 1)

    def view(self, state: State) -> View:
        """The picture: the robot in the middle, with its path and its meals around it."""
        trajectory, middle = self._recorder.trajectory, (self.params.width_mm / 2, self.params.height_mm / 2)

        def placed(x: float, y: float) -> Point:
            return x - self._pose.x_mm + middle[0], y - self._pose.y_mm + middle[1]

        first = max(trajectory.ticks - _TRAIL_MAX, trajectory.first_tick)
        trail = trajectory.tracks[0].trail(first, trajectory.ticks)
        food = [placed(*meal) for meal in self._meals]
        here: State = {**state, "x": middle[0], "y": middle[1], "eaten": [1] * len(food)}
        scene: EnvironmentScene = {**_NOTHING, "food": [list(it) for it in food]}
        trails = [[placed(x, y) for x, y, _ in trail]]
        return View(self.params, scene, [here], trails, trajectory.boredom_limit, "as it runs", _KEYS)


def observe(line: Line, log: FrameLog, out: TextIO, goes_on: Callable[[], bool]) -> None:
    """Follows a robot on a bus, and records its frames; shows a picture on a terminal, else a line per change.

    Args:
        line: The line to observe.
        log: Records the frames, timed from the first one.
        out: Stream for the picture or the lines.
        goes_on: Called repeatedly; ends the observation by returning False.

    Raises:
        UsageError: The bus cannot be opened.
        OctetError: The bus was closed or failed, or the robot was not heard.
    """
    protocol, observer = Protocol(line.node), Observer(line.node)
    tell = _draw if out.isatty() else _write
    with open_bus(line.bus, [protocol.id_of(name) for name in MESSAGES], line.bitrate) as bus:
        heard = tell(observer, observer.follow(_frames(bus, log, goes_on)), out)
    if not heard:
        raise OctetError(f"node {line.node} was not heard on {line.bus}: is the robot on, and its number right?")


def _draw(observer: Observer, states: Iterable[State], out: TextIO) -> bool:
    """Draws states now and then; returns whether there were any."""
    drawn_s = None
    with full_screen(out) as draw:
        for state in states:
            if drawn_s is None or time.monotonic() - drawn_s >= _DRAW_S:
                drawn_s = time.monotonic()
                columns, rows = shutil.get_terminal_size()
                draw(draw_text(observer.view(state), columns, rows - 1))
    return drawn_s is not None


def _write(observer: Observer, states: Iterable[State], out: TextIO) -> bool:
    """Writes a line for each change; returns whether there were any."""
    told: object = None
    for state in states:
        if (what := (state["reason"], state["pattern"], state["memory"])) != told:
            told = what
            out.write(f"{state['tick'] * observer.params.tick_s:8.2f} s  {_line(state)}\n")
            out.flush()
    return told is not None


def _frames(bus: "can.BusABC", log: FrameLog, goes_on: Callable[[], bool]) -> Iterator[Frame]:
    start_s: float | None = None
    while goes_on():
        message = receive(bus, _WAIT_S)
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


@contextmanager
def full_screen(out: TextIO) -> Iterator[Callable[[Sequence[str]], None]]:
    """Yields a function that draws lines, cut to the screen's size; restores the terminal at the end."""

    def draw(lines: Sequence[str]) -> None:
        width, height = shutil.get_terminal_size()
        shown = [f"{line[:width]}{_REST_OF_LINE}" for line in lines[: height - 1]]
        out.write(f"{_HOME}{chr(10).join(shown)}\n{_REST_OF_SCREEN}")
        out.flush()

    out.write(_ENTER)
    try:
        yield draw
    finally:
        out.write(_LEAVE)
        out.flush()
