"""The parts of a robot and its wires, from hal/rp2040/boards/pico.toml: tables for docs/build.md, and a schematic."""

from collections import Counter, defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from html import escape
from pathlib import Path

from host_sim.base.errors import UsageError
from host_sim.base.paths import ROOT
from host_sim.base.toml_file import parse_toml
from host_sim.emulator.board_pins import HAL, Pins

MECHANICAL = ("wheel", "caster")
"""Kinds of parts without wires."""

ON_BOARD = ("LED", "UART_TX", "UART_RX", "BATTERY")
"""Signals that stay on the board, or on the bench."""

_STYLE = """<style>
text { font: 11px sans-serif; fill: #222 } .name { font-weight: bold } .net { fill: #246 }
.part { fill: #f4f1e8; stroke: #543 } .wire { stroke: #888 } .end { text-anchor: end }
@media screen and (prefers-color-scheme: dark) { svg { background: #d8dade } }
</style>"""
_COLUMNS, _WIDTH, _ROW, _EDGE = 4, 330, 16, 14


@dataclass(frozen=True)
class Robot:
    """A robot that can be built.

    Attributes:
        pins: Its board.
        kinds: By kind of part: what to buy, an alternative, and the price of one in euros.
        parts: The kind of each part, with its value.
        wires: The terminals that each wire joins, `PART.TERMINAL`; those of the board are its pins.
    """

    pins: Pins
    kinds: dict[str, list[str]]
    parts: dict[str, str]
    wires: dict[str, list[str]]

    def terminals(self) -> dict[str, dict[str, str]]:
        """By part, the wire at each of its terminals.

        Raises:
            UsageError: A wire ends nowhere, or at a part that is not there or at a terminal that has one.
        """
        found: dict[str, dict[str, str]] = defaultdict(dict)
        for wire, ends in self.wires.items():
            if len(ends) < 2:  # noqa: PLR2004 - a wire has two ends
                raise UsageError(f"the wire {wire} ends nowhere")
            for part, _, terminal in (end.partition(".") for end in ends):
                if part not in self.parts:
                    raise UsageError(f"the wire {wire} goes to {part}, which is not among the parts")
                if terminal in found[part]:
                    raise UsageError(f"{part}.{terminal} has two wires, {found[part][terminal]} and {wire}")
                found[part][terminal] = wire
        for part, kind in self.parts.items():
            if part not in found and kind.split()[0] not in MECHANICAL:
                raise UsageError(f"{part} has no wire")
        return found

    def shopping(self) -> str:
        """The table of parts in Markdown, summed over the wiring."""
        lines = ["| number | part | or | euros |", "|---|---|---|---|"]
        total = 0.0
        for kind, count in Counter(self.parts.values()).items():
            name, _, value = kind.partition(" ")
            what, other, price = self.kinds[name]
            total += count * float(price)
            lines.append(f"| {count} | {what}{', ' * bool(value)}{value} | {other} | {count * float(price):.2f} |")
        return "\n".join([*lines, f"| | together, at rough prices | | {total:.0f} |"]) + "\n"

    def wiring(self) -> str:
        """The table of wires in Markdown."""
        lines = ["| wire | joins |", "|---|---|"]
        lines += [
            f"| {wire.replace('_', ' ')} | {', '.join(map(_spoken, ends))} |" for wire, ends in self.wires.items()
        ]
        return "\n".join(lines) + "\n"


def _spoken(end: str) -> str:
    part, _, terminal = end.partition(".")
    return f"{part.replace('_', ' ')} {terminal}"


def read_robot(pins: Pins, path: Path | None = None) -> Robot:
    """Reads what a robot on a board is built of.

    Args:
        pins: The board's.
        path: The file; None for the board's own.

    Raises:
        UsageError: A signal of the board has no wire, or a wire is wrong.
    """
    table = parse_toml((path or _file(pins)).read_text())
    wires = {wire: [_pin(end, pins) for end in ends.split()] for wire, ends in table["wires"].items()}
    kinds = {kind: [cell.strip() for cell in text.split("|")] for kind, text in table["kinds"].items()}
    robot = Robot(pins, kinds, table["parts"], wires)
    met = robot.terminals()
    for signal, pin in pins.signals.items():
        if signal not in ON_BOARD and pin not in met[pins.board]:
            raise UsageError(f"{signal}, {pin} of the {pins.board}, has no wire")
    return robot


def has_robot(pins: Pins) -> bool:
    """Whether it is known what a robot on a board is built of."""
    return _file(pins).exists()


def _file(pins: Pins) -> Path:
    return ROOT / HAL / pins.chip.name / "boards" / f"{pins.board}.toml"


def _pin(end: str, pins: Pins) -> str:
    part, _, terminal = end.partition(".")
    return f"{pins.board}.{pins.signals[terminal]}" if part == "board" else end


def draw_schematic(robot: Robot) -> str:
    """Each part with its value, and at each terminal the name of its wire: SVG."""
    heights = [float(_EDGE)] * _COLUMNS
    drawn: list[str] = []
    for part, ends in sorted(robot.terminals().items(), key=lambda row: -len(row[1])):
        column = heights.index(min(heights))
        drawn += _part(robot, part, ends, _EDGE + column * _WIDTH, heights[column])
        heights[column] += (len(ends) + 3) * _ROW
    size = f'width="{_COLUMNS * _WIDTH + _EDGE}" height="{max(heights):.0f}"'
    return "\n".join([f'<svg xmlns="http://www.w3.org/2000/svg" {size}>', _STYLE, *drawn, "</svg>", ""])


def _part(robot: Robot, part: str, ends: dict[str, str], x: float, y: float) -> Iterator[str]:
    kind, _, value = robot.parts[part].partition(" ")
    title = f"{part.replace('_', ' ')}: {value or kind}"
    yield f'<rect class="part" x="{x}" y="{y}" width="160" height="{(len(ends) + 1.5) * _ROW}"/>'
    yield f'<text class="name" x="{x + 6}" y="{y + 13}">{escape(title)}</text>'
    for row, (terminal, wire) in enumerate(ends.items()):
        at = y + (row + 2) * _ROW
        yield f'<path class="wire" d="M{x + 160} {at - 4}h24"/>'
        yield f'<text class="end" x="{x + 154}" y="{at}">{escape(terminal)}</text>'
        yield f'<text class="net" x="{x + 188}" y="{at}">{escape(wire.replace("_", " "))}</text>'
