"""The picture of a fleet: each robot's finishing time as a square, what they learned, and their common world."""

from collections.abc import Sequence
from math import ceil, sqrt
from pathlib import Path

from PIL import Image, ImageDraw

from host_sim.protocol.generated import CELL_COUNT
from host_sim.recording.fleet_summary import learned
from host_sim.report.drawing import (
    FLOOR,
    FOOD_MM,
    GAP_PX,
    INK,
    LINE_PX,
    PAPER,
    TEXT_PX,
    WIDTH_PX,
    Plan,
    abreast,
    draw_cell,
    draw_food,
    draw_obstacles,
    draw_robot,
    stacked,
    titled,
    write,
    write_image,
)
from host_sim.sim.fleet import FleetResult
from host_sim.world.geometry import SimParams
from host_sim.world.layouts import Layout

_MOST_ENVIRONMENTS, _MOST_NAMES = 5, 100
_CURVE_PX, _SQUARE_MAX_PX, _BAR_PX = 360, 40, 26
_AXIS_PX, _SECONDS_APART, _LABELS = 48, (1, 2, 5, 10, 30, 60, 120, 300, 600, 1800, 3600), 10
_UNFINISHED = "#d55e00"
_FAST, _SLOW = (229, 245, 224), (0, 68, 27)
_SIDES = {1: "#0072b2", 2: "#e69f00", 0: "#e1e4e8"}
_WORDS = {1: "turn left", 2: "turn right", 0: "nothing yet"}


def write_fleet_picture(
    path: Path, results: Sequence[FleetResult], params: SimParams, world: tuple[Layout, Sequence[bool]] | None = None
) -> None:
    """Writes the picture of a fleet as PNG; equal runs give equal bytes.

    Args:
        path: The file to write; an existing one is replaced.
        results: The result of each robot in each environment. The last five environments are shown.
        params: The dimensions of the worlds.
        world: For robots that share one: its last environment, and for each piece of food whether it was eaten.

    Raises:
        OctetError: The file cannot be written.
    """
    last = max(result.environment for result in results)
    numbers = range(max(1, last - _MOST_ENVIRONMENTS + 1), last + 1)
    groups = {number: _of_environment(results, number) for number in numbers}
    longest_s = max(result.ticks for result in results) * params.tick_s
    if world is None:
        rows = [_curves(groups, params.tick_s, longest_s), _mosaics(groups, params.tick_s, longest_s)]
    else:
        rows = [_arena(groups[last], *world, params)]
    rows.append(_memories(groups[last], params))
    write_image(path, stacked(rows).quantize(), "PNG", optimize=True)


def _of_environment(results: Sequence[FleetResult], number: int) -> list[FleetResult]:
    return sorted((result for result in results if result.environment == number), key=lambda result: result.robot)


def _shade(part: float) -> str:
    """A colour between that of the fastest and that of the slowest robot."""
    return "#" + "".join(f"{round(fast + (slow - fast) * part):02x}" for fast, slow in zip(_FAST, _SLOW, strict=True))


def _curves(groups: dict[int, list[FleetResult]], tick_s: float, longest_s: float) -> Image.Image:
    """The share of robots that have finished by a time: a curve for each environment."""
    image = Image.new("RGB", (WIDTH_PX, _CURVE_PX + _AXIS_PX), PAPER)
    draw, width = ImageDraw.Draw(image), WIDTH_PX - _AXIS_PX * 3
    _axes(image, width, longest_s)
    for i, (number, results) in enumerate(groups.items()):
        colour = _shade((i + 1) / len(groups))
        times = sorted(result.ticks * tick_s for result in results if result.finished)
        points = [(_AXIS_PX * 2.0, float(_CURVE_PX))]
        for count, time_s in enumerate(times, 1):
            x = _AXIS_PX * 2 + width * time_s / longest_s
            points += [(x, points[-1][1]), (x, _CURVE_PX * (1 - count / len(results)))]
        points.append((_AXIS_PX * 2.0 + width, points[-1][1]))
        draw.line(points, colour, 4)
        draw.line([(WIDTH_PX - 260, 190 + i * LINE_PX), (WIDTH_PX - 220, 190 + i * LINE_PX)], colour, 8)
        write(image, (WIDTH_PX - 210, 190 + i * LINE_PX), f"environment {number}", TEXT_PX, "lm")
    return titled("robots that have found all food, by robot time", image)


def _axes(image: Image.Image, width: int, longest_s: float) -> None:
    draw = ImageDraw.Draw(image)
    for percent in range(0, 101, 25):
        y = _CURVE_PX * (1 - percent / 100)
        draw.line([(_AXIS_PX * 2, y), (_AXIS_PX * 2 + width, y)], _SIDES[0], 1)
        write(image, (_AXIS_PX * 2 - 8, max(y, 10)), f"{percent} %", TEXT_PX, "rm")
    apart = next((step for step in _SECONDS_APART if longest_s / step <= _LABELS), _SECONDS_APART[-1])
    for second in range(0, int(longest_s) + 1, apart):
        x = _AXIS_PX * 2 + width * second / longest_s
        write(image, (x, _CURVE_PX + _AXIS_PX / 2), f"{second} s", TEXT_PX, "mm")


def _mosaics(groups: dict[int, list[FleetResult]], tick_s: float, longest_s: float) -> Image.Image:
    """For each environment, a square for each robot, row by row, coloured by its finishing time."""
    gaps = (len(groups) - 1) * GAP_PX
    side_px = (WIDTH_PX - gaps) // max(2, len(groups))
    panels = [
        titled(f"environment {number}", _mosaic(results, side_px, tick_s, longest_s))
        for number, results in groups.items()
    ]
    row = Image.new("RGB", (WIDTH_PX, panels[0].height), PAPER)
    row.paste(abreast(panels, GAP_PX))
    shades = ", ".join(
        [f"pale: finished at once, dark: after {longest_s:.0f} s", "orange: not finished", "robot 1 top left"]
    )
    return titled(f"each robot ({shades})", row)


def _mosaic(results: Sequence[FleetResult], side_px: int, tick_s: float, longest_s: float) -> Image.Image:
    columns = ceil(sqrt(len(results)))
    square = min(_SQUARE_MAX_PX, side_px // columns)
    gap = 1 if square > 2 else 0  # noqa: PLR2004 - a gap as wide as the square would hide it
    image = Image.new("RGB", (side_px, ceil(len(results) / columns) * square), PAPER)
    draw = ImageDraw.Draw(image)
    for i, result in enumerate(results):
        x, y = i % columns * square, i // columns * square
        colour = _shade(result.ticks * tick_s / longest_s) if result.finished else _UNFINISHED
        draw.rectangle((x, y, x + square - 1 - gap, y + square - 1 - gap), colour)
    return image


def _arena(results: Sequence[FleetResult], layout: Layout, eaten: Sequence[bool], params: SimParams) -> Image.Image:
    """The robots' common world at the end of its last environment."""
    plan = Plan(params.width_mm, params.height_mm, WIDTH_PX, FLOOR)
    draw_obstacles(plan, layout.bars, params)
    for at, is_eaten in zip(layout.food, eaten, strict=True):
        draw_food(plan, at, FOOD_MM, is_eaten)
    for result in results:
        draw_robot(plan, result.pose, 2 * params.body_radius_mm, INK)
    image = plan.done()
    px_per_mm = WIDTH_PX / params.width_mm
    for result in results if len(results) <= _MOST_NAMES else ():
        place = result.pose.x_mm * px_per_mm, (result.pose.y_mm + 1.4 * params.body_radius_mm) * px_per_mm
        write(image, place, str(result.robot), TEXT_PX, "mm")
    found = f"{sum(eaten)} of {len(eaten)} food eaten"
    return titled(f"environment {results[0].environment}: {len(results)} robots at its end, {found}", image)


def _memories(results: Sequence[FleetResult], params: SimParams) -> Image.Image:
    """For each pattern, how many robots turn left, turn right, and know nothing."""
    width_px, counts = WIDTH_PX // (CELL_COUNT - 1), learned(results)
    cells = [_cell(pattern, counts[pattern], width_px, params) for pattern in range(1, CELL_COUNT)]
    row = Image.new("RGB", (WIDTH_PX, cells[0].height + LINE_PX), PAPER)
    row.paste(abreast(cells, 0))
    draw = ImageDraw.Draw(row)
    for i, (side, words) in enumerate(_WORDS.items()):
        x, y = i * 180, row.height - LINE_PX / 2
        draw.rectangle((x, y - 9, x + 18, y + 9), _SIDES[side])
        write(row, (x + 26, y), words, TEXT_PX, "lm")
    return titled(f"what {len(results)} robots have learned for each pattern of their front sensors", row)


def _cell(pattern: int, counts: Sequence[int], width_px: int, params: SimParams) -> Image.Image:
    drawing = draw_cell(pattern, 0, params, width_px)
    image = Image.new("RGB", (width_px, drawing.height + _BAR_PX + 4 * LINE_PX), PAPER)
    image.paste(drawing)
    draw, x, total, length = ImageDraw.Draw(image), 8.0, sum(counts), width_px - 16
    for i, (side, colour) in enumerate(_SIDES.items()):
        end = x + length * counts[side] / total
        if counts[side]:
            draw.rectangle((x, drawing.height, end, drawing.height + _BAR_PX), colour)
        x = end
        text = f"{_WORDS[side]}: {counts[side]}"
        write(image, (width_px / 2, drawing.height + _BAR_PX + (i + 0.8) * LINE_PX), text, TEXT_PX, "mm")
    return image
