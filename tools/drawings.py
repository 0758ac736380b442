"""Drawings for building the robot of docs/build.md: its wiring, and its two plates at 1:1, as SVG and as DXF."""

import math
import re
from collections.abc import Iterator, Mapping
from html import escape
from pathlib import Path

from host_sim.base.errors import UsageError
from host_sim.emulator.board_pins import Pins
from host_sim.world.geometry import SimParams
from tools.schematic import draw_schematic, has_robot, read_robot

_STYLE = """<style>
text { font: 12px sans-serif; fill: #222 }
.end { text-anchor: end } .middle { text-anchor: middle } .small { font-size: 4px }
.board { fill: #dce6f2; stroke: #345 } .wire { stroke: #888; stroke-width: 2 } .part { stroke: none; fill: #e8e8e8 }
.line { fill: none; stroke: #222; stroke-width: .3 } .mark { stroke-dasharray: 2 }
.sensors { fill: #fde3c8 } .motors { fill: #d5ecd4 } .bridge { fill: #f6d3dc } .battery { fill: #f3efbd }
.beacon { fill: #e5d9f2 } .contacts { fill: #d3ecef }
@media screen and (prefers-color-scheme: dark) {
  svg { background: #1b1e22 } .free { fill: #ddd } .wire, .line { stroke: #ccc }
}
</style>"""

_ROW, _EDGE, _LABEL, _BOARD = 24, 20, 320, 180
"""Dimensions of the wiring diagram, px: height of a row, margin, width of a label, width of the board."""


def _svg(width: float, height: float, unit: str, parts: Iterator[str]) -> str:
    head = f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}{unit}" height="{height}{unit}"'
    return "\n".join([f'{head} viewBox="0 0 {width} {height}">', _STYLE, *parts, "</svg>", ""])


def draw_wiring(pins: Pins) -> str:
    """The wiring of a board whose headers are known: SVG, a row for each pin of a header.

    Raises:
        UsageError: They are unknown.
    """
    if not pins.headers:
        raise UsageError(f"{pins.board}: its file in hal/stm32/boards does not say where the pins are on its headers")
    rows = max(map(len, pins.headers))
    return _svg(2 * (_EDGE + _LABEL) + _BOARD + 80, (rows + 1) * _ROW + 2 * _EDGE, "", _wiring(pins, rows))


def _wiring(pins: Pins, rows: int) -> Iterator[str]:
    left = _EDGE + _LABEL + 40
    yield f'<rect class="board" x="{left}" y="{_EDGE}" width="{_BOARD}" height="{(rows + 1) * _ROW}" rx="8"/>'
    yield f'<text class="middle" x="{left + _BOARD / 2}" y="{_EDGE + _ROW}">{pins.board}</text>'
    if pins.top:
        yield f'<text class="middle" x="{left + _BOARD / 2}" y="{_EDGE - 5}">{pins.top}</text>'
    signals = {pin: signal for signal, pin in pins.signals.items()}
    for side, header in enumerate(pins.headers):
        for row, name in enumerate(header):
            y = _EDGE + (row + 1) * _ROW
            anchor = "end" if side else "start"
            yield f'<text class="{anchor}" x="{left + (_BOARD - 8 if side else 8)}" y="{y + 4}">{name}</text>'
            signal = signals.get(name if name.startswith("GP") else f"P{name}", "")
            if signal in pins.ends:
                part, terminal = pins.ends[signal]
                x = left + _BOARD + 40 if side else _EDGE
                wire = left + _BOARD if side else left - 40
                yield f'<path class="wire" d="M{wire} {y}h40"/>'
                yield f'<rect class="part {part}" x="{x}" y="{y - 10}" width="{_LABEL}" height="20" rx="4"/>'
                yield f'<text x="{x + 8}" y="{y + 4}">{escape(f"{part}: {terminal}")}</text>'


_WHEEL_MM, _GAP_MM = (42.0, 19.0), 2.0
"""Diameter and width of a wheel, and the space around it."""

_CASTER_MM, _SPACER_MM = 70.0, 65.0
"""From the centre to the caster, and to the spacers between the plates."""


def draw_plate(upper: bool, params: SimParams | None = None) -> str:
    """One of the plates between which the robot is built, seen from above, front up: SVG, in mm, at 1:1.

    Args:
        upper: The one with the sensors; else the one with wheels and caster.
        params: The body's dimensions.
    """
    params = params or SimParams()
    size = 2 * params.body_radius_mm + 5
    return _svg(size, size, "mm", _plate(upper, params, size / 2))


def _plate(upper: bool, params: SimParams, middle: float) -> Iterator[str]:
    radius, wheel_x = params.body_radius_mm - 5, params.wheel_track_mm / 2  # the bumpers are outside
    yield f'<g transform="translate({middle} {middle})">'
    yield f'<circle class="line" r="{radius}"/>' if upper else _with_room_for_wheels(radius, wheel_x)
    yield '<path class="line mark" d="M-5 0h10M0 -5v10M0 -30l-4 6h8z"/>'
    for angle in (45, 135, 225, 315):
        yield _hole(*_polar(_SPACER_MM, angle), 3.2)
    yield from _upper_holes(radius) if upper else _lower_holes(wheel_x)
    label = (
        "upper plate: sensors on its rim, the board on top" if upper else "lower plate: motors below, battery on top"
    )
    yield f'<text class="middle small free" y="20">Octet, {label}</text>'
    yield '<path class="line scale" d="M-25 28v-2m0 1h50m0 -1v2"/><text class="middle small free" y="33">50 mm</text>'
    yield "</g>"


def _with_room_for_wheels(radius: float, wheel_x: float) -> str:
    """The outline of the lower plate: a disc, open on both sides."""
    y = _WHEEL_MM[0] / 2 + _GAP_MM
    inner, rim = wheel_x - _WHEEL_MM[1] / 2 - _GAP_MM, math.sqrt(radius**2 - y**2)
    right = f"M{rim:.2f} {y}H{inner}V{-y}H{rim:.2f}A{radius} {radius} 0 0 0 {-rim:.2f} {-y}"
    left = f"H{-inner}V{y}H{-rim:.2f}A{radius} {radius} 0 0 0 {rim:.2f} {y}z"
    return f'<path class="line" d="{right}{left}"/>'


def _lower_holes(wheel_x: float) -> Iterator[str]:
    """Two brackets of N20 motors, their screws 18 mm apart, and a caster, whose screws are 34 to 42 mm apart."""
    for side in (-1, 1):
        for y in (-9, 9):
            yield _slot(side * (wheel_x - 20), y, 6, 2.2)
        yield _slot(side * 19, _CASTER_MM, 4, 3.2)


def _upper_holes(radius: float) -> Iterator[str]:
    """A bracket for each proximity sensor, with screws 10 mm apart, and a line where the sensor looks outwards."""
    for angle in (-90, -45, 0, 45, 90):
        x, y = _polar(radius - 8, angle)
        across = math.radians(angle)
        for side in (-5, 5):
            yield _hole(x + side * math.cos(across), y + side * math.sin(across), 3.2)
        yield '<path class="line mark" d="M{:.2f} {:.2f}L{:.2f} {:.2f}"/>'.format(
            *_polar(radius - 6, angle), *_polar(radius, angle)
        )
    yield _hole(0, -40, 8)  # the cable of the beacon's receiver
    yield _hole(0, 45, 8)  # all other cables


def _polar(radius: float, angle_deg: float) -> tuple[float, float]:
    """A place seen from the centre: clockwise from the front."""
    angle = math.radians(angle_deg)
    return radius * math.sin(angle), -radius * math.cos(angle)


def _hole(x: float, y: float, diameter: float) -> str:
    return f'<circle class="line" cx="{x:.2f}" cy="{y:.2f}" r="{diameter / 2}"/>'


def _slot(x: float, y: float, length: float, width: float) -> str:
    left, top = x - (length + width) / 2, y - width / 2
    size = f'width="{length + width}" height="{width}" rx="{width / 2}"'
    return f'<rect class="line" x="{left:.2f}" y="{top:.2f}" {size}/>'


_CUT = re.compile(r'<(circle|rect|path) class="line" ([^>]*)/>')
_STEP = re.compile(r"([MHVA])([^MHVAz]*)")


def dxf_of(plate: str) -> str:
    """The cutting lines of a plate drawn by `draw_plate`: DXF, mm from its centre to the right and to the front."""
    shapes = ((kind, dict(re.findall(r'(\w+)="([^"]*)"', words))) for kind, words in _CUT.findall(plate))
    entities = (entity for kind, words in shapes for entity in _DXF_OF[kind](words))
    return "\n".join(["0\nSECTION\n2\nENTITIES", *entities, "0\nENDSEC\n0\nEOF\n"])


def _entity(kind: str, **values: float) -> str:
    """An entity of DXF; values by their group codes, those of y counted downwards."""
    codes = (int(name[1:]) for name in values)
    texts = (
        f"{code}\n{-value if code in (20, 21) else value:.3f}"
        for code, value in zip(codes, values.values(), strict=True)
    )
    return "\n".join([f"0\n{kind}\n8\n0", *texts])


def _dxf_of_circle(words: Mapping[str, str]) -> Iterator[str]:
    yield _entity("CIRCLE", _10=float(words.get("cx", 0)), _20=float(words.get("cy", 0)), _40=float(words["r"]))


def _dxf_of_slot(words: Mapping[str, str]) -> Iterator[str]:
    x, y, width, height = (float(words[name]) for name in ("x", "y", "width", "height"))
    radius = height / 2
    left, right = x + radius, x + width - radius
    for edge in (y, y + height):
        yield _entity("LINE", _10=left, _20=edge, _11=right, _21=edge)
    for centre, start in ((left, 90), (right, 270)):
        yield _entity("ARC", _10=centre, _20=y + radius, _40=radius, _50=start, _51=(start + 180) % 360)


def _dxf_of_outline(words: Mapping[str, str]) -> Iterator[str]:
    """The path consists of lines along the axes, and of counterclockwise arcs around the centre."""
    x = y = 0.0
    for step, text in _STEP.findall(words["d"]):
        numbers = [float(number) for number in text.split()]
        to_x = x if step == "V" else numbers[0] if step in "MH" else numbers[-2]
        to_y = y if step == "H" else numbers[-1]
        if step == "A":
            start, end = (math.degrees(math.atan2(-b, a)) % 360 for a, b in ((x, y), (to_x, to_y)))
            yield _entity("ARC", _10=0, _20=0, _40=numbers[0], _50=start, _51=end)
        elif step != "M":
            yield _entity("LINE", _10=x, _20=y, _11=to_x, _21=to_y)
        x, y = to_x, to_y


_DXF_OF = {"circle": _dxf_of_circle, "rect": _dxf_of_slot, "path": _dxf_of_outline}


def write_drawings(pins: Pins, folder: Path) -> list[Path]:
    """Writes all drawings into a folder; returns their paths."""
    folder.mkdir(parents=True, exist_ok=True)
    lower, upper = draw_plate(upper=False), draw_plate(upper=True)
    drawings = {
        f"{pins.board}-wiring.svg": draw_wiring(pins),
        "lower-plate.svg": lower,
        "lower-plate.dxf": dxf_of(lower),
        "upper-plate.svg": upper,
        "upper-plate.dxf": dxf_of(upper),
    }
    if has_robot(pins):
        drawings[f"{pins.board}-schematic.svg"] = draw_schematic(read_robot(pins))
    for name, text in drawings.items():
        (folder / name).write_text(text)
    return [folder / name for name in drawings]
