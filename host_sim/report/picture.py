"""The picture of a whole run: every environment with the robots' paths, and the robots' memories below."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from io import BytesIO
from itertools import islice, pairwise
from pathlib import Path
from typing import Protocol

from PIL import Image

from host_sim.base.atomic_file import write_bytes
from host_sim.protocol.generated import CELL_COUNT, SIDES
from host_sim.recording.trajectory import Trajectory, at
from host_sim.report.drawing import (
    FLOOR,
    FOOD_MM,
    INK,
    MARKS,
    PAPER,
    PATHS,
    Plan,
    draw_cell,
    draw_food,
    draw_mark,
    draw_robot,
    draw_scene,
    draw_trail,
    write,
)
from host_sim.report.palette import in_palette
from host_sim.report.sheet import GAP_PX, LINE_PX, TEXT_PX, WIDTH_PX, abreast, stacked, titled
from host_sim.view.state_types import EnvironmentScene
from host_sim.world.geometry import Point, Pose
from host_sim.world.params import SimParams

_MOST_ENVIRONMENTS, _COLUMNS = 9, 3
_LEGEND_COLUMNS = 6
_LEGEND_PX_PER_MM = 0.25
_MOST_MEMORIES = 8
_MOST_NEWS = 12


@dataclass(frozen=True)
class Panel:
    """One environment of the picture.

    Attributes:
        scene: The scene at its end.
        eaten: For each piece of food, 1 if it was eaten, else 0.
        robot_s: Duration, s of robot time.
        trails: For each robot and control tick, the position at its end (x and y in mm) and the reason of its drive.
        starts: Each robot's pose after the first tick.
        nodes: Each robot's node number on the bus.
        news: The changes in it, each with the time since its start, s of robot time.
    """

    scene: EnvironmentScene
    eaten: Sequence[int]
    robot_s: float
    trails: Sequence[Sequence[tuple[float, float, int]]]
    starts: Sequence[Pose]
    nodes: Sequence[int]
    news: Sequence[tuple[float, str]] = ()


def write_picture(path: Path, trajectory: Trajectory) -> None:
    """Writes the picture of a run as PNG, below 400 kB for one robot; equal runs give equal bytes.

    Args:
        path: The file to write; an existing one is replaced.
        trajectory: The run, of at least one tick. At most the last nine environments and the memories of the first
            eight robots are shown.

    Raises:
        OctetError: The file cannot be written.
    """
    memories = {track.node: at(track.memories, trajectory.ticks - 1) for track in trajectory.tracks}
    content = BytesIO()
    picture = draw_run(trajectory.params, _Panels(trajectory), memories, trajectory.environments)
    picture.save(content, "PNG")
    write_bytes(path, content.getvalue())


class _Panels:
    """The panels of a run's last environments, created on demand: many thousand points take much memory."""

    def __init__(self, trajectory: Trajectory) -> None:
        self._trajectory = trajectory
        self._parts = list(pairwise([*trajectory.begun(), trajectory.ticks]))[-_MOST_ENVIRONMENTS:]

    def __len__(self) -> int:
        return len(self._parts)

    def __iter__(self) -> Iterator[Panel]:
        return (_panel(self._trajectory, first, end) for first, end in self._parts)


def _panel(trajectory: Trajectory, first: int, end: int) -> Panel:
    """The panel of the environment from tick `first` to before tick `end`."""
    return Panel(
        scene=at(trajectory.scenes, end - 1),
        eaten=at(trajectory.meals, end - 1),
        robot_s=(end - first) * trajectory.params.tick_s,
        trails=[track.trail(first, end) for track in trajectory.tracks],
        starts=[track.pose(first) for track in trajectory.tracks],
        nodes=[track.node for track in trajectory.tracks],
        news=[((tick - first) * trajectory.params.tick_s, it) for tick, it in trajectory.news if first <= tick < end],
    )


class Panels(Protocol):
    """An ordered collection of panels."""

    def __len__(self) -> int: ...

    def __iter__(self) -> Iterator[Panel]: ...


def draw_run(
    params: SimParams, panels: Panels, memories: Mapping[int, Sequence[int]], environments: int = 0
) -> Image.Image:
    """The picture of a run.

    Args:
        params: The dimensions of the world.
        panels: The environments in order, at least one; at most the last nine are shown.
        memories: Each robot's eight cells at the end, by node number: 0 nothing, 1 left, 2 right.
        environments: Number of environments of the run, if there are more than panels.

    Raises:
        ValueError: There is no environment, or a memory does not have eight cells.
    """
    if not len(panels) or any(len(memory) != CELL_COUNT for memory in memories.values()):
        raise ValueError(f"no picture of {len(panels)} environments and these memories: {memories}")
    rows = [_legend(params), *(_line(text) for text in omissions(max(environments, len(panels)), len(memories)))]
    rows += _environment_rows(panels, params)
    for node, memory in list(memories.items())[:_MOST_MEMORIES]:
        rows.append(_memory_row(f"Robot {node}" if len(memories) > 1 else "The robot", memory, params))
    return in_palette(stacked(rows))


def omissions(environments: int, robots: int) -> list[str]:
    """Describes what a picture of a number of environments and robots leaves out.

    >>> omissions(environments=20, robots=1)
    ['the last 9 of 20 environments']
    """
    texts = []
    if environments > _MOST_ENVIRONMENTS:
        texts.append(f"the last {_MOST_ENVIRONMENTS} of {environments} environments")
    if robots > _MOST_MEMORIES:
        texts.append(f"the memories of the first {_MOST_MEMORIES} of {robots} robots")
    return texts


def _news(panel: Panel) -> list[str]:
    """The changes in an environment, one per line."""
    name = f"environment {panel.scene['number']}"
    return [f"{name}, after {seconds:.0f} s: {sentence}" for seconds, sentence in panel.news]


def _lines(texts: Sequence[str]) -> list[Image.Image]:
    """The lines of a paragraph as one image; none if there are none."""
    sheet = Image.new("RGB", (WIDTH_PX, len(texts) * LINE_PX), PAPER)
    for number, text in enumerate(texts):
        write(sheet, (0, (number + 0.4) * LINE_PX), text, TEXT_PX, "lm")
    return [sheet] if texts else []


def _line(text: str) -> Image.Image:
    """A line of text."""
    return titled(text, Image.new("RGB", (WIDTH_PX, 1), PAPER))


def _environment_rows(panels: Panels, params: SimParams) -> list[Image.Image]:
    """The last environments, side by side, each under its caption; then the changes in them."""
    columns = min(_COLUMNS, len(panels))
    width_px = (WIDTH_PX - (columns - 1) * GAP_PX) // columns
    shown = islice(panels, max(0, len(panels) - _MOST_ENVIRONMENTS), None)
    images, news = [], []
    for panel in shown:
        images.append(titled(_caption(panel), _environment(panel, params, width_px)))
        news += _news(panel)
    rows = [abreast(images[first : first + columns], GAP_PX) for first in range(0, len(images), columns)]
    more = len(news) - _MOST_NEWS
    return rows + _lines(news if more <= 0 else [*news[:_MOST_NEWS], f"and {more} more changes"])


def _caption(panel: Panel) -> str:
    finished = bool(panel.eaten) and all(panel.eaten)
    outcome = "finished in" if finished else "not finished in"
    food = f"{sum(panel.eaten)} of {len(panel.eaten)} food"
    return f"environment {panel.scene['number']}: {outcome} {panel.robot_s:.0f} s, {food}"


def _environment(panel: Panel, params: SimParams, width_px: int) -> Image.Image:
    """The arena from above, with the robots' paths."""
    plan = Plan(params.width_mm, params.height_mm, width_px, FLOOR)
    for start, trail in zip(panel.starts, panel.trails, strict=True):
        draw_trail(plan, start[:2], trail)
    draw_scene(plan, panel.scene, panel.eaten, params)
    for start, trail in zip(panel.starts, panel.trails, strict=True):
        draw_robot(plan, start, 2 * params.body_radius_mm, PAPER)
        draw_robot(plan, _end(start, trail), 2 * params.body_radius_mm, INK)
    image = plan.done()
    if len(panel.nodes) > 1:
        _write_nodes(image, panel, params)
    return image


def _write_nodes(image: Image.Image, panel: Panel, params: SimParams) -> None:
    """Writes each robot's number below its start and its end."""
    px_per_mm = image.width / params.width_mm
    for node, start, trail in zip(panel.nodes, panel.starts, panel.trails, strict=True):
        for x, y in (start[:2], _end(start, trail)[:2]):
            place = x * px_per_mm, (y + 1.5 * params.body_radius_mm) * px_per_mm
            write(image, place, str(node), TEXT_PX, "mm")


def _end(start: Pose, trail: Sequence[tuple[float, float, int]]) -> Pose:
    """The end of a trail, with the heading of its last move."""
    points = [(x, y) for x, y, _ in trail]
    if not points:
        return start
    end = points[-1]
    before = next((point for point in reversed(points) if point != end), None)
    return Pose(*end, math.atan2(end[1] - before[1], end[0] - before[0]) if before else start.heading_rad)


def _legend(params: SimParams) -> Image.Image:
    """The legend of colours and signs."""
    words = [mark.words for mark in MARKS.values()] + ["start", "end", "food left", "food eaten"]
    column_px = WIDTH_PX // _LEGEND_COLUMNS
    places = [(i % _LEGEND_COLUMNS * column_px, i // _LEGEND_COLUMNS * LINE_PX) for i in range(len(words))]
    height = places[-1][1] + LINE_PX
    plan = Plan(WIDTH_PX, height, WIDTH_PX, PAPER)
    middles = [(x + LINE_PX / 2, y + LINE_PX / 2) for x, y in places]
    for reason, (x, y) in zip(MARKS, middles, strict=False):
        draw_mark(plan, reason, [(x - 12, y), (x + 12, y)] if reason in PATHS else [(x, y)], _LEGEND_PX_PER_MM)
    _draw_signs(plan, middles[len(MARKS) :], params)
    image = plan.done()
    for text, (x, y) in zip(words, middles, strict=True):
        write(image, (x + LINE_PX * 0.7, y), text, TEXT_PX, "lm")
    return image


def _draw_signs(plan: Plan, middles: Sequence[Point], params: SimParams) -> None:
    """Draws the signs for start, end, food left and food eaten."""
    body, food = 0.5 * _LEGEND_PX_PER_MM * 2 * params.body_radius_mm, 0.7 * _LEGEND_PX_PER_MM * FOOD_MM
    for middle, colour in zip(middles[:2], (PAPER, INK), strict=True):
        draw_robot(plan, Pose(*middle, 0.0), body, colour)
    for middle, eaten in zip(middles[2:], (False, True), strict=True):
        draw_food(plan, middle, food, eaten)


def _memory_row(whose: str, memory: Sequence[int], params: SimParams) -> Image.Image:
    """The eight cells: each pattern of the front sensors, and the turn learned for it."""
    cells = [_cell(pattern, side, params) for pattern, side in enumerate(memory)]
    return titled(f"{whose}'s memory: one cell for each pattern of its three front sensors", abreast(cells, 0))


def _cell(pattern: int, side: int, params: SimParams) -> Image.Image:
    """One cell, with its content in words."""
    width_px = WIDTH_PX // CELL_COUNT
    drawing = draw_cell(pattern, side, params, width_px)
    image = Image.new("RGB", (width_px, drawing.height + 2 * LINE_PX), PAPER)
    image.paste(drawing)
    write(image, (width_px / 2, image.height - 1.5 * LINE_PX), f"cell {pattern} ({pattern:03b})", TEXT_PX, "mm")
    words = "stays empty" if pattern == 0 else f"turn {SIDES[side]}" if side else "nothing yet"
    write(image, (width_px / 2, image.height - 0.7 * LINE_PX), words, TEXT_PX, "mm")
    return image
