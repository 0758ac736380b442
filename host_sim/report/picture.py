"""One picture of a whole run: every environment with the robot's path, and below the eight cells of its memory."""

import math
from collections.abc import Sequence
from os import PathLike
from typing import Protocol

from PIL import Image

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
    draw_obstacles,
    draw_robot,
    draw_trail,
    write,
)
from host_sim.world.geometry import Point, Pose
from host_sim.world.layouts import Layout
from host_sim.world.params import SimParams

_CELLS, _MOST_ENVIRONMENTS, _COLUMNS = 8, 9, 3
_WIDTH_PX, _MARGIN_PX, _GAP_PX = 1608, 36, 24
_LEGEND_COLUMNS, _LINE_PX, _TEXT_PX, _HEADING_PX = 6, 30, 18, 21
_LEGEND_PX_PER_MM = 0.25
_TURNS = ("nothing yet", "turn left", "turn right")


class EpisodeResult(Protocol):
    """What happened in one environment, as far as the picture shows it."""

    @property
    def layout(self) -> Layout:
        """The layout."""

    @property
    def trail(self) -> Sequence[tuple[float, float, int]]:
        """For each control tick, where it ended (x and y in mm) and the reason of its drive, 0..7."""

    @property
    def eaten(self) -> Sequence[bool]:
        """For each piece of food, whether it was eaten."""

    @property
    def robot_s(self) -> float:
        """How long it took, s, in the robot's time."""

    @property
    def finished(self) -> bool:
        """Whether all the food was eaten in the time allowed."""


def draw_run(
    path: str | PathLike[str], params: SimParams, environments: Sequence[EpisodeResult], memory: Sequence[int]
) -> None:
    """Writes the picture of a run as PNG, below 400 kB; equal runs give equal bytes.

    Args:
        path: The file to write; one that is there is replaced.
        params: The measures.
        environments: What happened, in order, at least one; of more than nine the last nine are shown.
        memory: The eight cells at the end: 0 nothing, 1 left, 2 right.

    Raises:
        ValueError: There is no environment, or there are not eight cells.
        OSError: The file cannot be written.
    """
    if not environments or len(memory) != _CELLS:
        raise ValueError(f"no picture of {len(environments)} environments and {len(memory)} cells")
    shown = list(enumerate(environments, 1))[-_MOST_ENVIRONMENTS:]
    rows = [_legend(params), *_environment_rows(shown, params), _memory_row(memory, params)]
    _stacked(rows).quantize().save(path, "PNG", optimize=True)


def _environment_rows(episodes: Sequence[tuple[int, EpisodeResult]], params: SimParams) -> list[Image.Image]:
    """The numbered environments, side by side, each under its caption."""
    columns = min(_COLUMNS, len(episodes))
    width_px = (_WIDTH_PX - (columns - 1) * _GAP_PX) // columns
    panels = [_titled(_caption(*episode), _environment(episode[1], params, width_px)) for episode in episodes]
    return [_abreast(panels[first : first + columns], _GAP_PX) for first in range(0, len(panels), columns)]


def _caption(number: int, episode: EpisodeResult) -> str:
    outcome = "finished in" if episode.finished else "not finished in"
    food = f"{sum(episode.eaten)} of {len(episode.eaten)} food"
    return f"environment {number}: {outcome} {episode.robot_s:.0f} s, {food}"


def _environment(episode: EpisodeResult, params: SimParams, width_px: int) -> Image.Image:
    """The arena from above, with what the robot did in it."""
    plan = Plan(params.width_mm, params.height_mm, width_px, FLOOR)
    draw_trail(plan, episode.layout.start[:2], episode.trail)
    draw_obstacles(plan, episode.layout.bars, params)
    for food, eaten in zip(episode.layout.food, episode.eaten, strict=True):
        draw_food(plan, food, FOOD_MM, eaten)
    draw_robot(plan, episode.layout.start, 2 * params.body_radius_mm, PAPER)
    draw_robot(plan, _end(episode), 2 * params.body_radius_mm, INK)
    return plan.done()


def _end(episode: EpisodeResult) -> Pose:
    """Where the trail ends, looking along its last way."""
    start, points = episode.layout.start, [(x, y) for x, y, _ in episode.trail]
    if not points:
        return start
    end = points[-1]
    before = next((point for point in reversed(points) if point != end), None)
    return Pose(*end, math.atan2(end[1] - before[1], end[0] - before[0]) if before else start.heading_rad)


def _legend(params: SimParams) -> Image.Image:
    """What the colours and signs mean."""
    words = [mark.words for mark in MARKS] + ["start", "end", "food left", "food eaten"]
    column_px = _WIDTH_PX // _LEGEND_COLUMNS
    places = [(i % _LEGEND_COLUMNS * column_px, i // _LEGEND_COLUMNS * _LINE_PX) for i in range(len(words))]
    height = places[-1][1] + _LINE_PX
    plan = Plan(_WIDTH_PX, height, _WIDTH_PX, PAPER)
    middles = [(x + _LINE_PX / 2, y + _LINE_PX / 2) for x, y in places]
    for reason, (x, y) in enumerate(middles[: len(MARKS)]):
        draw_mark(plan, reason, [(x - 12, y), (x + 12, y)] if reason in PATHS else [(x, y)], _LEGEND_PX_PER_MM)
    _draw_signs(plan, middles[len(MARKS) :], params)
    image = plan.done()
    for text, (x, y) in zip(words, middles, strict=True):
        write(image, (x + _LINE_PX * 0.7, y), text, _TEXT_PX, "lm")
    return image


def _draw_signs(plan: Plan, middles: Sequence[Point], params: SimParams) -> None:
    """Start, end, food left and food eaten."""
    body, food = 0.5 * _LEGEND_PX_PER_MM * 2 * params.body_radius_mm, 0.7 * _LEGEND_PX_PER_MM * FOOD_MM
    for middle, colour in zip(middles[:2], (PAPER, INK), strict=True):
        draw_robot(plan, Pose(*middle, 0.0), body, colour)
    for middle, eaten in zip(middles[2:], (False, True), strict=True):
        draw_food(plan, middle, food, eaten)


def _memory_row(memory: Sequence[int], params: SimParams) -> Image.Image:
    """The eight cells: what the front sensors feel, and the turn learned for it."""
    cells = [_cell(pattern, action, params) for pattern, action in enumerate(memory)]
    return _titled("The robot's memory: one cell for each pattern of its three front sensors", _abreast(cells, 0))


def _cell(pattern: int, action: int, params: SimParams) -> Image.Image:
    """One cell, and in words what it holds."""
    width_px = _WIDTH_PX // _CELLS
    drawing = draw_cell(pattern, action, params, width_px)
    image = Image.new("RGB", (width_px, drawing.height + 2 * _LINE_PX), PAPER)
    image.paste(drawing)
    write(image, (width_px / 2, image.height - 1.5 * _LINE_PX), f"cell {pattern}", _TEXT_PX, "mm")
    words = _TURNS[action] if pattern else "stays empty"
    write(image, (width_px / 2, image.height - 0.7 * _LINE_PX), words, _TEXT_PX, "mm")
    return image


def _titled(title: str, image: Image.Image) -> Image.Image:
    """An image under a line of text."""
    sheet = Image.new("RGB", (image.width, image.height + _LINE_PX), PAPER)
    sheet.paste(image, (0, _LINE_PX))
    write(sheet, (0, _LINE_PX * 0.4), title, _HEADING_PX, "lm")
    return sheet


def _abreast(images: Sequence[Image.Image], gap_px: int) -> Image.Image:
    """Images of one size side by side."""
    step = images[0].width + gap_px
    row = Image.new("RGB", (len(images) * step - gap_px, images[0].height), PAPER)
    for i, image in enumerate(images):
        row.paste(image, (i * step, 0))
    return row


def _stacked(rows: Sequence[Image.Image]) -> Image.Image:
    """Rows one below the other on the finished sheet."""
    height = 2 * _MARGIN_PX + sum(row.height for row in rows) + (len(rows) - 1) * _GAP_PX
    sheet = Image.new("RGB", (_WIDTH_PX + 2 * _MARGIN_PX, height), PAPER)
    y = _MARGIN_PX
    for row in rows:
        sheet.paste(row, (_MARGIN_PX, y))
        y += row.height + _GAP_PX
    return sheet
