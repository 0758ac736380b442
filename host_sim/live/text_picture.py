"""Draws a run as text: arena, senses, memory and reason, on a screen of at least 60 x 20 characters."""

import math
import textwrap
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from host_sim.protocol.generated import FEEL, PATTERNS, SIDES, Reason
from host_sim.recording.phrases import sentence, verdict
from host_sim.recording.state_types import EnvironmentScene, State
from host_sim.world.geometry import Point, Pose, SimParams

COLUMNS_MIN, ROWS_MIN = 60, 20
"""Minimum size of the screen, characters."""

_PANEL, _ROWS_BELOW, _WORD_ROWS = 22, 8, 2
_TALL = 2.0
_FOOD, _EATEN, _BAR, _PLANT, _TRAIL, _ROBOT = "O", "x", "#", "*", ".", "@"
_LEGEND = f"{_ROBOT} robot   {_FOOD} food   {_EATEN} eaten   {_BAR} obstacle   {_PLANT} plant   {_TRAIL} path"
_DISC_STEPS = 8
_NOSES = "-\\|/"
_FEELERS = (("LEFT", "<"), ("FRONT_LEFT", "\\"), ("FRONT", "|"), ("FRONT_RIGHT", "/"), ("RIGHT", ">"))
_FRONT = ((4, "\\"), (2, "|"), (1, "/"))


@dataclass(frozen=True)
class View:
    """The contents of the picture.

    Attributes:
        params: The dimensions of the world.
        scene: The arena.
        states: The robots' states; senses and memory are those of the first robot.
        trails: Each robot's positions in this arena.
        boredom_limit: Number of remembered turns in a row at which a robot is bored.
        pace: The speed, in words.
        keys: The keys and their meaning, two lines.
        news: A sentence about the latest change or end; empty if there was none.
    """

    params: SimParams
    scene: EnvironmentScene
    states: Sequence[State]
    trails: Sequence[Sequence[Point]]
    boredom_limit: int
    pace: str
    keys: str
    news: str = ""

    @property
    def state(self) -> State:
        """The first robot's state."""
        return self.states[0]


def draw_text(view: View, columns: int, rows: int) -> list[str]:
    """Draws the picture.

    Args:
        view: The contents.
        columns: Width of the screen, characters.
        rows: Height of the screen, lines.

    Returns:
        At most `rows` lines of at most `columns` characters; on a screen that is too small, a message.
    """
    if columns < COLUMNS_MIN or rows < ROWS_MIN:
        message = f"{columns} x {rows} characters are too few: at least {COLUMNS_MIN} x {ROWS_MIN} are needed"
        return textwrap.wrap(message, columns)[:rows]
    arena = _draw_arena(view, columns - _PANEL, rows - _ROWS_BELOW - 1)
    panel = _draw_panel(view)
    width = len(arena[0])
    middle = [f"{left:{width}}  {right}" for left, right in zip(arena, _padded(panel, len(arena)), strict=True)]
    texts = sentence(view.state), verdict(view.state["trial"])
    words = [line for text in texts for line in _padded(textwrap.wrap(text, columns), _WORD_ROWS)]
    lines = (_head(view), *middle, _LEGEND, view.news, *words, *view.keys.splitlines())
    return [line[:columns].rstrip() for line in lines]


def _head(view: View) -> str:
    scene, state = view.scene, view.state
    seconds = state["tick"] * view.params.tick_s
    food = f"eaten {sum(state['eaten'])} of {len(state['eaten'])}"
    clock = f"{int(seconds // 60)}:{seconds % 60:04.1f}"
    return f"environment {scene['number']} of {scene['of']}   {food}   {clock}   {view.pace}"


def _draw_arena(view: View, columns: int, rows: int) -> list[str]:
    """The arena in its frame, as large as fits, true to scale."""
    canvas = _Canvas(view.params, columns - 2, rows - 2)
    for trail in view.trails:
        canvas.mark(trail, _TRAIL)
    for _, ax, ay, bx, by in view.scene["bars"]:
        canvas.line((ax, ay), (bx, by), _BAR)
    for _, x, y, radius in view.scene.get("plants", []):
        canvas.disc((x, y), radius, _PLANT)
    for (x, y), eaten in zip(view.scene["food"], view.state["eaten"], strict=True):
        canvas.mark([(x, y)], _EATEN if eaten else _FOOD)
    for state in view.states:
        sign = _ROBOT if len(view.states) == 1 else str(state["node"])[-1]
        canvas.robot(Pose(state["x"], state["y"], state["heading"] / 1000), sign)
    edge = f"+{'-' * canvas.columns}+"
    return [edge, *(f"|{''.join(row)}|" for row in canvas.rows), edge]


class _Canvas:
    """A grid of characters over the arena's floor; a character is twice as high as wide."""

    def __init__(self, params: SimParams, columns: int, rows: int) -> None:
        per_row = max(params.height_mm / rows, params.width_mm / columns * _TALL)
        self.columns = min(columns, round(params.width_mm / per_row * _TALL))
        count = min(rows, round(params.height_mm / per_row))
        self.rows = [[" "] * self.columns for _ in range(count)]
        self._params = params

    def mark(self, points: Iterable[Point], sign: str) -> None:
        """Puts a sign at each point."""
        for point in points:
            self._put(*self._place(point), sign)

    def line(self, a: Point, b: Point, sign: str) -> None:
        """Puts signs from one point to another."""
        steps = self.columns + len(self.rows)
        parts = [i / steps for i in range(steps + 1)]
        self.mark(((a[0] + (b[0] - a[0]) * part, a[1] + (b[1] - a[1]) * part) for part in parts), sign)

    def disc(self, middle: Point, radius_mm: float, sign: str) -> None:
        """Puts signs all over a disc."""
        steps = [radius_mm * part / _DISC_STEPS for part in range(-_DISC_STEPS, _DISC_STEPS + 1)]
        self.mark(
            ((middle[0] + x, middle[1] + y) for x in steps for y in steps if math.hypot(x, y) <= radius_mm), sign
        )

    def robot(self, pose: Pose, sign: str) -> None:
        """Puts a robot, and a stroke beside it in the direction of its heading."""
        column, row = self._place(pose[:2])
        eighth = round(pose.heading_rad / (math.pi / 4))
        nose = round(math.cos(eighth * math.pi / 4)), round(math.sin(eighth * math.pi / 4))
        self._put(column + nose[0], row + nose[1], _NOSES[eighth % len(_NOSES)])
        self._put(column, row, sign)

    def _place(self, point: Point) -> tuple[int, int]:
        """Column and row of a point."""
        return (
            int(point[0] / self._params.width_mm * self.columns),
            int(point[1] / self._params.height_mm * len(self.rows)),
        )

    def _put(self, column: int, row: int, sign: str) -> None:
        if 0 <= row < len(self.rows) and 0 <= column < self.columns:
            self.rows[row][column] = sign


def _draw_panel(view: View) -> list[str]:
    """Senses, boredom and memory: for each cell its sensors, its content, and how often it was used."""
    state = view.state
    feelers = " ".join(sign if state["feel"] & FEEL[name] else "." for name, sign in _FEELERS)
    count = min(state["repeat_count"], view.boredom_limit)
    bar = "#" * round(8 * count / view.boredom_limit)
    food = f"{state['beacon']} mm" if state["beacon"] else "none"
    return [
        f"senses  {feelers}",
        f"food    {food}",
        f"bored   [{bar:8}] {state['repeat_count']}",
        "memory  frozen used" if state["frozen"] else "memory         used",
        *(_draw_cell(state, cell) for cell in range(1, len(PATTERNS))),
    ]


def _draw_cell(state: State, cell: int) -> str:
    in_use = state["reason"] in (Reason.REMEMBERED, Reason.TRIAL) and state["pattern"] == cell
    front = "".join(sign if cell & bit else "." for bit, sign in _FRONT)
    side = SIDES[state["memory"][cell]] if state["memory"][cell] else "-"
    return f"{'>' if in_use else ' '} {front}  {side:7}{state['uses'][cell]:5}"


def _padded(lines: Sequence[str], count: int) -> list[str]:
    """Cuts or pads the lines to exactly `count`."""
    return [*lines, *[""] * (count - len(lines))][:count]
