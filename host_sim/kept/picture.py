"""One picture of a whole run: every environment with the robot's path, and below the eight cells of its memory."""

import math
from collections.abc import Sequence
from os import PathLike
from typing import Protocol

from PIL import Image

from host_sim.kept.drawing import (
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
from host_sim.world.environment import Environment, Point, Pose, World

_CELLS, _MOST_ENVIRONMENTS, _COLUMNS = 8, 9, 3
_WIDTH_PX, _MARGIN_PX, _GAP_PX = 1608, 36, 24
_LEGEND_COLUMNS, _LINE_PX, _TEXT_PX, _HEADING_PX = 6, 30, 18, 21
_LEGEND_PX_PER_MM = 0.25
_TURNS = ("nothing yet", "turn left", "turn right")


class Chapter(Protocol):
    """What happened in one environment, as far as the picture shows it."""

    @property
    def environment(self) -> Environment:
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


def draw_run(path: str | PathLike[str], world: World, environments: Sequence[Chapter], memory: Sequence[int]) -> None:
    """Writes the picture of a run as PNG, below 400 kB; equal runs give equal bytes.

    Args:
        path: The file to write; one that is there is replaced.
        world: The measures.
        environments: What happened, in order, at least one; of more than nine the last nine are shown.
        memory: The eight cells at the end: 0 nothing, 1 left, 2 right.

    Raises:
        ValueError: There is no environment, or there are not eight cells.
        OSError: The file cannot be written.
    """
    if not environments or len(memory) != _CELLS:
        raise ValueError(f"no picture of {len(environments)} environments and {len(memory)} cells")
    shown = list(enumerate(environments, 1))[-_MOST_ENVIRONMENTS:]
    rows = [_legend(world), *_environment_rows(shown, world), _memory_row(memory, world)]
    _stacked(rows).quantize().save(path, "PNG", optimize=True)


def _environment_rows(chapters: Sequence[tuple[int, Chapter]], world: World) -> list[Image.Image]:
    """The numbered environments, side by side, each under its caption."""
    columns = min(_COLUMNS, len(chapters))
    width_px = (_WIDTH_PX - (columns - 1) * _GAP_PX) // columns
    panels = [_titled(_caption(*chapter), _environment(chapter[1], world, width_px)) for chapter in chapters]
    return [_abreast(panels[first : first + columns], _GAP_PX) for first in range(0, len(panels), columns)]


def _caption(number: int, chapter: Chapter) -> str:
    outcome = "finished in" if chapter.finished else "not finished in"
    food = f"{sum(chapter.eaten)} of {len(chapter.eaten)} food"
    return f"environment {number}: {outcome} {chapter.robot_s:.0f} s, {food}"


def _environment(chapter: Chapter, world: World, width_px: int) -> Image.Image:
    """The arena from above, with what the robot did in it."""
    plan = Plan(world.width_mm, world.height_mm, width_px, FLOOR)
    draw_trail(plan, chapter.environment.start[:2], chapter.trail)
    draw_obstacles(plan, chapter.environment.bars, world)
    for food, eaten in zip(chapter.environment.food, chapter.eaten, strict=True):
        draw_food(plan, food, FOOD_MM, eaten)
    draw_robot(plan, chapter.environment.start, 2 * world.body_radius_mm, PAPER)
    draw_robot(plan, _end(chapter), 2 * world.body_radius_mm, INK)
    return plan.done()


def _end(chapter: Chapter) -> Pose:
    """Where the trail ends, looking along its last way."""
    start, points = chapter.environment.start, [(x, y) for x, y, _ in chapter.trail]
    if not points:
        return start
    end = points[-1]
    before = next((point for point in reversed(points) if point != end), None)
    return Pose(*end, math.atan2(end[1] - before[1], end[0] - before[0]) if before else start.heading_rad)


def _legend(world: World) -> Image.Image:
    """What the colours and signs mean."""
    words = [mark.words for mark in MARKS] + ["start", "end", "food left", "food eaten"]
    column_px = _WIDTH_PX // _LEGEND_COLUMNS
    places = [(i % _LEGEND_COLUMNS * column_px, i // _LEGEND_COLUMNS * _LINE_PX) for i in range(len(words))]
    height = places[-1][1] + _LINE_PX
    plan = Plan(_WIDTH_PX, height, _WIDTH_PX, PAPER)
    middles = [(x + _LINE_PX / 2, y + _LINE_PX / 2) for x, y in places]
    for reason, (x, y) in enumerate(middles[: len(MARKS)]):
        draw_mark(plan, reason, [(x - 12, y), (x + 12, y)] if reason in PATHS else [(x, y)], _LEGEND_PX_PER_MM)
    _draw_signs(plan, middles[len(MARKS) :], world)
    image = plan.done()
    for text, (x, y) in zip(words, middles, strict=True):
        write(image, (x + _LINE_PX * 0.7, y), text, _TEXT_PX, "lm")
    return image


def _draw_signs(plan: Plan, middles: Sequence[Point], world: World) -> None:
    """Start, end, food left and food eaten."""
    body, food = 0.5 * _LEGEND_PX_PER_MM * 2 * world.body_radius_mm, 0.7 * _LEGEND_PX_PER_MM * FOOD_MM
    for middle, colour in zip(middles[:2], (PAPER, INK), strict=True):
        draw_robot(plan, Pose(*middle, 0.0), body, colour)
    for middle, eaten in zip(middles[2:], (False, True), strict=True):
        draw_food(plan, middle, food, eaten)


def _memory_row(memory: Sequence[int], world: World) -> Image.Image:
    """The eight cells: what the front sensors feel, and the turn learned for it."""
    cells = [_cell(pattern, action, world) for pattern, action in enumerate(memory)]
    return _titled("The robot's memory: one cell for each pattern of its three front sensors", _abreast(cells, 0))


def _cell(pattern: int, action: int, world: World) -> Image.Image:
    """One cell, and in words what it holds."""
    width_px = _WIDTH_PX // _CELLS
    drawing = draw_cell(pattern, action, world, width_px)
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


