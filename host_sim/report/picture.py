"""The picture of a whole run: every environment with the robots' paths, and the robots' memories below."""

import math
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path

from PIL import Image

from host_sim.protocol.generated import CELL_COUNT, SIDES
from host_sim.recording.trajectory import Trajectory, at
from host_sim.report.drawing import (
    FLOOR,
    FOOD_MM,
    GAP_PX,
    INK,
    LINE_PX,
    MARKS,
    PAPER,
    PATHS,
    TEXT_PX,
    WIDTH_PX,
    Plan,
    abreast,
    draw_cell,
    draw_food,
    draw_mark,
    draw_robot,
    draw_scene,
    draw_trail,
    in_palette,
    stacked,
    titled,
    write,
    write_image,
)
from host_sim.world.geometry import Point, Pose, SimParams

_MOST_ENVIRONMENTS, _COLUMNS = 9, 3
_LEGEND_COLUMNS = 6
_LEGEND_PX_PER_MM = 0.25
_MOST_MEMORIES = 8
_MOST_NEWS = 12


def write_picture(path: Path, trajectory: Trajectory) -> None:
    """Writes the picture of a run as PNG, below 400 kB for one robot; equal runs give equal bytes.

    Raises:
        OctetError: The file cannot be written.
    """
    write_image(path, draw_run(trajectory), "PNG")


def draw_run(trajectory: Trajectory) -> Image.Image:
    """The picture of a run of at least one tick.

    At most the last nine environments and the memories of the first eight robots are shown.
    """
    params, tracks = trajectory.params, trajectory.tracks
    rows = [_legend(params), *(_line(text) for text in omissions(trajectory.environments, len(tracks)))]
    rows += _environment_rows(trajectory)
    for track in tracks[:_MOST_MEMORIES]:
        whose = f"Robot {track.node}" if len(tracks) > 1 else "The robot"
        rows.append(_memory_row(whose, at(track.memories, trajectory.ticks - 1), params))
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


def _lines(texts: Sequence[str]) -> list[Image.Image]:
    """The lines of a paragraph as one image; none if there are none."""
    sheet = Image.new("RGB", (WIDTH_PX, len(texts) * LINE_PX), PAPER)
    for number, text in enumerate(texts):
        write(sheet, (0, (number + 0.4) * LINE_PX), text, TEXT_PX, "lm")
    return [sheet] if texts else []


def _line(text: str) -> Image.Image:
    """A line of text."""
    return titled(text, Image.new("RGB", (WIDTH_PX, 1), PAPER))


def _environment_rows(trajectory: Trajectory) -> list[Image.Image]:
    """The last environments, side by side, each under its caption; then the changes in them."""
    spans = list(pairwise([*trajectory.begun(), trajectory.ticks]))[-_MOST_ENVIRONMENTS:]
    columns = min(_COLUMNS, len(spans))
    width_px = (WIDTH_PX - (columns - 1) * GAP_PX) // columns
    images = [titled(_caption(trajectory, *span), _environment(trajectory, *span, width_px)) for span in spans]
    news = [line for span in spans for line in _news(trajectory, *span)]
    rows = [abreast(images[first : first + columns], GAP_PX) for first in range(0, len(images), columns)]
    more = len(news) - _MOST_NEWS
    return rows + _lines(news if more <= 0 else [*news[:_MOST_NEWS], f"and {more} more changes"])


def _caption(trajectory: Trajectory, first: int, end: int) -> str:
    """The outcome of the environment from tick `first` to before tick `end`."""
    number, eaten = at(trajectory.scenes, end - 1)["number"], at(trajectory.meals, end - 1)
    outcome = "finished in" if eaten and all(eaten) else "not finished in"
    robot_s = (end - first) * trajectory.params.tick_s
    return f"environment {number}: {outcome} {robot_s:.0f} s, {sum(eaten)} of {len(eaten)} food"


def _news(trajectory: Trajectory, first: int, end: int) -> list[str]:
    """The changes in an environment, one per line."""
    name, tick_s = f"environment {at(trajectory.scenes, end - 1)['number']}", trajectory.params.tick_s
    return [
        f"{name}, after {(tick - first) * tick_s:.0f} s: {sentence}"
        for tick, sentence in trajectory.news
        if first <= tick < end
    ]


def _environment(trajectory: Trajectory, first: int, end: int, width_px: int) -> Image.Image:
    """The arena from above at the end of an environment, with the robots' paths."""
    params = trajectory.params
    plan = Plan(params.width_mm, params.height_mm, width_px, FLOOR)
    starts = [track.pose(first) for track in trajectory.tracks]
    ends = []
    for start, track in zip(starts, trajectory.tracks, strict=True):
        trail = track.trail(first, end)
        draw_trail(plan, start[:2], trail)
        ends.append(_end(start, trail))
    draw_scene(plan, at(trajectory.scenes, end - 1), at(trajectory.meals, end - 1), params)
    for start, last in zip(starts, ends, strict=True):
        draw_robot(plan, start, 2 * params.body_radius_mm, PAPER)
        draw_robot(plan, last, 2 * params.body_radius_mm, INK)
    image = plan.done()
    if len(trajectory.tracks) > 1:
        for track, *poses in zip(trajectory.tracks, starts, ends, strict=True):
            _write_node(image, params, track.node, poses)
    return image


def _write_node(image: Image.Image, params: SimParams, node: int, poses: Sequence[Pose]) -> None:
    """Writes a robot's number below each of its poses."""
    px_per_mm = image.width / params.width_mm
    for pose in poses:
        place = pose.x_mm * px_per_mm, (pose.y_mm + 1.5 * params.body_radius_mm) * px_per_mm
        write(image, place, str(node), TEXT_PX, "mm")


def _end(start: Pose, trail: Sequence[tuple[float, float, int]]) -> Pose:
    """The end of a trail, with the heading of its last move."""
    if not trail:
        return start
    end = trail[-1][:2]
    before = next((tick[:2] for tick in reversed(trail) if tick[:2] != end), None)
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
