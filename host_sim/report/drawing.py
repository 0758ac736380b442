"""Common drawing functions: a plan in mm, robot, food, cones and cells on it, sheets of images, and a palette."""

import math
from collections.abc import Iterable, Sequence
from functools import cache
from io import BytesIO
from itertools import combinations, groupby
from pathlib import Path
from typing import Any, Literal, NamedTuple

from PIL import Image, ImageColor, ImageDraw, ImageFont

from host_sim.base.files import write_bytes
from host_sim.protocol.generated import FEEL, Reason, Side
from host_sim.recording.state_types import EnvironmentScene
from host_sim.world.geometry import Point, Pose, SimParams, ahead_of
from host_sim.world.layouts import Layout
from host_sim.world.native_world import CONE_BEARINGS_DEG, cone_outline

PAPER, INK, FLOOR, OBSTACLE = "#ffffff", "#20262e", "#f6f5f1", "#4b535d"
CONE_LIT, CONE_DARK = "#e69f00", "#e1e4e8"
BEAM, IN_USE, LEARNED = "#d8efe7", "#fdeecb", "#bfe5d8"
WIDTH_PX, MARGIN_PX, GAP_PX = 1608, 36, 24
LINE_PX, TEXT_PX, HEADING_PX = 30, 18, 21
"""Measures of a sheet: rows of images under lines of text."""

FOOD_MM = 100.0
FRONT_BITS = (FEEL["FRONT_RIGHT"], FEEL["FRONT"], FEEL["FRONT_LEFT"])
"""The bits of feel that form the pattern: front-right, front, front-left."""

# Everything but text is drawn this many times too large and then shrunk, for smooth edges. Wide images need less
# and would take much memory.
_OVERSIZE, _WIDE_OVERSIZE, _WIDE_PX = 3, 2, 1000
_LEAF, _POT, _LEAVES = "#5b7f2b", "#8c564b", 8
_FOOD, _FRAME_MM = "#009e73", 16.0
_UP = -math.pi / 2
_JOINED_MM = 15.0  # dots that overlap so much look like a line


class Mark(NamedTuple):
    """How a reason is drawn on a path; higher layers are drawn over lower ones."""

    words: str
    colour: str
    width_mm: float
    layer: int


MARKS = {
    Reason.STOP: Mark("stopped", "#8a8a8a", 30.0, 1),
    Reason.WANDER: Mark("wanders", "#56b4e9", 14.0, 1),
    Reason.TOWARD_FOOD: Mark("goes toward food", "#009e73", 20.0, 2),
    Reason.LOOK_AROUND: Mark("looks around", "#c6ccd4", 34.0, 0),
    Reason.REMEMBERED: Mark("remembered turn", "#0072b2", 36.0, 3),
    Reason.TRIAL: Mark("trial turn", "#d55e00", 68.0, 4),
    Reason.BOREDOM: Mark("bored, about face", "#cc79a7", 68.0, 4),
    Reason.EAT: Mark("eats", "#000000", 44.0, 5),
    Reason.SILENCE: Mark("hears nothing", "#8c564b", 44.0, 5),
    Reason.AVOID: Mark("avoids", "#4b535d", 44.0, 5),
    Reason.PROGRAM: Mark("as its program says", "#4b535d", 36.0, 3),
}
"""Marks by reason; the colours are those of Okabe and Ito, which colour-blind people can tell apart."""

PATHS = (Reason.WANDER, Reason.TOWARD_FOOD)
"""Reasons for which the robot drives instead of turning."""


class Plan:
    """A drawing surface in mm with smooth edges."""

    def __init__(self, width_mm: float, height_mm: float, width_px: int, colour: str) -> None:
        """Starts with a background of one colour; the height in pixels follows from the proportions."""
        self._oversize = _OVERSIZE if width_px < _WIDE_PX else _WIDE_OVERSIZE
        self._px_per_mm = width_px * self._oversize / width_mm
        self._size_px = width_px, round(width_px * height_mm / width_mm)
        large_px = self._size_px[0] * self._oversize, self._size_px[1] * self._oversize
        self._image = Image.new("RGB", large_px, colour)
        self._draw = ImageDraw.Draw(self._image)

    def disc(self, middle: Point, diameter_mm: float, colour: str) -> None:
        """Draws a filled disc."""
        x, y = self._pixels([middle])[0]
        radius = diameter_mm * self._px_per_mm / 2
        self._draw.ellipse((x - radius, y - radius, x + radius, y + radius), colour)

    def line(
        self, points: Sequence[Point], width_mm: float, colour: str, joint: Literal["curve"] | None = "curve"
    ) -> None:
        """Draws a line with round ends, and with round corners unless `joint` is None, which takes less time."""
        self._draw.line(self._pixels(points), colour, max(1, round(width_mm * self._px_per_mm)), joint)
        for end in (points[0], points[-1]):
            self.disc(end, width_mm, colour)

    def polygon(self, points: Sequence[Point], colour: str) -> None:
        """Draws a filled polygon."""
        self._draw.polygon(self._pixels(points), colour)

    def done(self) -> Image.Image:
        """The finished image."""
        return self._image.reduce(self._oversize)

    def _pixels(self, points: Sequence[Point]) -> list[Point]:
        return [(x * self._px_per_mm, y * self._px_per_mm) for x, y in points]


def draw_mark(plan: Plan, reason: int, points: Sequence[Point], scale: float = 1.0) -> None:
    """Draws a path as a line, or a turn as a dot, in the style of its reason in `MARKS`."""
    _, colour, width_mm, _ = MARKS[Reason(reason)]
    if len(points) > 1:
        plan.line(points, width_mm * scale, colour, None)
    else:
        plan.disc(points[0], width_mm * scale, colour)


def draw_trail(plan: Plan, start: Point, trail: Sequence[tuple[float, float, int]]) -> None:
    """Draws a trail, paths as lines and turns as dots, in the order of their layers.

    Args:
        plan: The plan to draw on.
        start: Start of the trail, mm.
        trail: For each control tick, the position at its end (x and y in mm) and the `Reason` of its drive.
    """
    points = [start, *((x, y) for x, y, _ in trail)]
    runs = [(reason, [i for i, _ in ticks]) for reason, ticks in groupby(enumerate(trail), lambda t: t[1][2])]
    ways: list[tuple[int, list[Point]]] = []
    for reason, ticks in sorted(runs, key=lambda run: MARKS[Reason(run[0])].layer):
        # Tick i leads from point i to point i + 1.
        way = points[ticks[0] : ticks[-1] + 2] if reason in PATHS else [points[ticks[0]]]
        if ways and ways[-1][0] == reason and math.dist(ways[-1][1][-1], way[0]) < _JOINED_MM:
            ways[-1][1].extend(way)
        else:
            ways.append((reason, way))
    for reason, way in ways:
        draw_mark(plan, reason, way)


def draw_food(plan: Plan, middle: Point, diameter: float, eaten: bool) -> None:
    """Draws a piece of food: a disc, or a ring once it is eaten."""
    plan.disc(middle, diameter, _FOOD)
    if eaten:
        plan.disc(middle, diameter * 0.7, FLOOR)


def draw_obstacles(plan: Plan, bars: Iterable[Sequence[Point]], params: SimParams) -> None:
    """Draws the bars, given by the ends of their centre lines in mm, and the walls."""
    for bar in bars:
        plan.line(bar, params.bar_thickness_mm, OBSTACLE)
    right, bottom = params.width_mm, params.height_mm
    plan.line([(0, 0), (right, 0), (right, bottom), (0, bottom), (0, 0)], _FRAME_MM, OBSTACLE)


def draw_scene(plan: Plan, scene: EnvironmentScene, eaten: Sequence[int], params: SimParams) -> None:
    """Draws the contents of an arena: walls, bars, plants and food; `eaten` is 1 for each piece eaten, else 0."""
    draw_obstacles(plan, (((ax, ay), (bx, by)) for _, ax, ay, bx, by in scene["bars"]), params)
    _draw_plants(plan, scene.get("plants", []))
    for (x, y), is_eaten in zip(scene["food"], eaten, strict=True):
        draw_food(plan, (x, y), FOOD_MM, bool(is_eaten))


def _draw_plants(plan: Plan, plants: Iterable[Sequence[float]]) -> None:
    """Draws plants, given by id, centre and radius in mm: leaves around a pot, to scale."""
    for _, x, y, radius in plants:
        plan.disc((x, y), 2 * radius, _LEAF)
        for leaf in range(_LEAVES):
            vein = [ahead_of(Pose(x, y, leaf * math.tau / _LEAVES), radius * part) for part in (0.4, 0.85)]
            plan.line(vein, radius / 12, FLOOR)
        plan.disc((x, y), 0.7 * radius, _POT)


def draw_robot(plan: Plan, pose: Pose, diameter: float, colour: str) -> None:
    """Draws a robot: a disc with a line in the direction of its heading."""
    plan.disc(pose[:2], diameter, INK)
    plan.disc(pose[:2], diameter * 0.86, colour)
    nose = [ahead_of(pose, diameter * 0.08), ahead_of(pose, diameter * 0.34)]
    plan.line(nose, diameter * 0.12, INK if colour == PAPER else PAPER)


def draw_cone(plan: Plan, pose: Pose, bearing_deg: float, reach_mm: float, colour: str) -> None:
    """Draws a sensor's cone."""
    corners = [ahead_of(pose, math.hypot(x, y), math.atan2(y, x)) for x, y in cone_outline(bearing_deg, reach_mm)]
    plan.polygon(corners, colour)
    plan.line([*corners, corners[0]], reach_mm / 20, PAPER)


def draw_cell(pattern: int, side: int, params: SimParams, width_px: int, colour: str = PAPER) -> Image.Image:
    """One cell: the robot facing up with its front cones lit or dark, and an arrow around it for the turn."""
    reach = params.body_radius_mm + params.sensor_reach_mm
    plan = Plan(3.6 * reach, 2.5 * reach, width_px, colour)
    pose = Pose(1.8 * reach, 1.75 * reach, _UP)
    for bit in FRONT_BITS:
        draw_cone(plan, pose, CONE_BEARINGS_DEG[bit], reach, CONE_LIT if bit >> 1 & pattern else CONE_DARK)
    draw_robot(plan, pose, 2 * params.body_radius_mm, PAPER)
    if side:
        _draw_arrow(plan, pose, 1.35 * reach, -1 if side == Side.LEFT else 1)
    return plan.done()


def _draw_arrow(plan: Plan, pose: Pose, radius_mm: float, side: int) -> None:
    """Draws an arrow around the robot: side -1 to its left, 1 to its right."""
    arc = [ahead_of(pose, radius_mm, side * math.radians(bearing)) for bearing in range(0, 76, 5)]
    plan.line(arc, radius_mm / 14, INK)
    base, tip = side * math.radians(75), side * math.radians(100)
    head = [ahead_of(pose, radius_mm * part, base) for part in (0.84, 1.16)]
    plan.polygon([*head, ahead_of(pose, radius_mm, tip)], INK)


def write(image: Image.Image, place: Point, text: str, size_px: int, anchor: str) -> None:
    """Writes a line of text; `anchor` is a text anchor of Pillow."""
    ImageDraw.Draw(image).text(place, text, INK, ImageFont.load_default(size_px), anchor=anchor)


def write_image(path: Path, image: Image.Image, kind: str, **options: Any) -> None:
    """Writes an image in one of Pillow's formats, with Pillow's options for it.

    Raises:
        OctetError: The file cannot be written.
    """
    content = BytesIO()
    image.save(content, kind, **options)
    write_bytes(path, content.getvalue())


def write_world_picture(path: Path, layout: Layout, params: SimParams, width_px: int) -> None:
    """Writes an environment as PNG; equal environments give equal bytes.

    Raises:
        OctetError: The file cannot be written.
    """
    plan = Plan(params.width_mm, params.height_mm, width_px, FLOOR)
    draw_obstacles(plan, layout.bars, params)
    for at in layout.food:
        draw_food(plan, at, FOOD_MM, eaten=False)
    for start in layout.starts:
        draw_robot(plan, start, 2 * params.body_radius_mm, PAPER)
    write_image(path, plan.done().quantize(), "PNG", optimize=True)


def titled(title: str, image: Image.Image) -> Image.Image:
    """An image under a line of text."""
    sheet = Image.new("RGB", (image.width, image.height + LINE_PX), PAPER)
    sheet.paste(image, (0, LINE_PX))
    write(sheet, (0, LINE_PX * 0.4), title, HEADING_PX, "lm")
    return sheet


def abreast(images: Sequence[Image.Image], gap_px: int) -> Image.Image:
    """Images of one size side by side."""
    step = images[0].width + gap_px
    row = Image.new("RGB", (len(images) * step - gap_px, images[0].height), PAPER)
    for i, image in enumerate(images):
        row.paste(image, (i * step, 0))
    return row


def stacked(rows: Sequence[Image.Image]) -> Image.Image:
    """Rows one below the other on the finished sheet."""
    height = 2 * MARGIN_PX + sum(row.height for row in rows) + (len(rows) - 1) * GAP_PX
    sheet = Image.new("RGB", (WIDTH_PX + 2 * MARGIN_PX, height), PAPER)
    y = MARGIN_PX
    for row in rows:
        sheet.paste(row, (MARGIN_PX, y))
        y += row.height + GAP_PX
    return sheet


def in_palette(image: Image.Image) -> Image.Image:
    """An image with each of its colours replaced by the nearest one of the palette."""
    return image.quantize(palette=_palette(), dither=Image.Dither.NONE)


@cache
def _palette() -> Image.Image:
    """The drawing colours, with their blends into paper and floor, and halfway into each other.

    One palette serves all pictures: computing the best one for each takes longer than drawing.
    """
    drawn = (PAPER, FLOOR, INK, OBSTACLE, CONE_LIT, CONE_DARK, BEAM, IN_USE, LEARNED)
    bases = dict.fromkeys(map(ImageColor.getrgb, (*drawn, *(mark.colour for mark in MARKS.values()))))
    blends = [(a, b, 0.5) for a, b in combinations(bases, 2)]
    blends += [(a, ImageColor.getrgb(b), part) for a in bases for b in (PAPER, FLOOR) for part in (0.25, 0.75)]
    mixed = [tuple(round(x + (y - x) * part) for x, y in zip(a, b, strict=True)) for a, b, part in blends]
    palette = Image.new("P", (1, 1))
    palette.putpalette([value for colour in [*bases, *mixed] for value in colour])
    return palette
