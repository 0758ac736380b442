"""A world that a person wrote, as plain lists of numbers: checked, and made into one that a run can take place in."""

import math
from collections.abc import Mapping
from typing import Any

from host_sim.near_word import near_word
from host_sim.world.geometry import Bar, Point
from host_sim.world.layouts import World
from host_sim.world.params import SimParams
from host_sim.world.written_layout import WrittenLayout

BARS_MAX = 40
"""Maximum number of obstacles in an arena."""

_FOOD_MAX = 20
_SIZE_MIN_MM = 600
_WIDTH_MAX_MM, _HEIGHT_MAX_MM = 6000, 5000  # from corner to corner less than 8191 mm, the limit of SENSES
_SIZES = f"from [{_SIZE_MIN_MM}, {_SIZE_MIN_MM}] to [{_WIDTH_MAX_MM}, {_HEIGHT_MAX_MM}]"
_KEYS = ("size", "start", "food", "bars")


class WrittenError(ValueError):
    """A mistake in what was written; the message says what was meant.

    Attributes:
        key: Where it is: one of the keys, or one that should not be there.
        number: Which entry of its list, from 0; -1 for all of it.
    """

    def __init__(self, key: str, number: int, what: str) -> None:
        """Takes the place and the message."""
        super().__init__(what)
        self.key, self.number = key, number


def world_from(content: Mapping[str, Any], name: str) -> World:
    """The world that is written as these keys and values; docs/worlds.md explains them.

    >>> world_from({"size": [2000, 1500], "food": [[1000, 750]]}, "my.toml").generate(seed=1, number=1).food
    ((1000.0, 750.0),)

    Args:
        content: What was written.
        name: Name of the world.

    Raises:
        WrittenError: It is not a fair world.
    """
    for key in content:
        if key not in _KEYS:
            near = near_word(key, _KEYS)
            meant = f"did you mean {near!r}?" if near else f"a world has {', '.join(_KEYS)}"
            raise WrittenError(key, -1, f"there is no {key!r}: {meant}")
    params = _params(content)
    layout = WrittenLayout(_bars(content, params), _food(content, params), _start(content, params))
    if fault := layout.find_fault(params):
        number, what = fault
        raise WrittenError("start" if number < 0 else "food", number, what)
    return World(name, params, layout)


def content_of(layout: WrittenLayout, params: SimParams) -> dict[str, Any]:
    """The keys and values from which `world_from` makes an equal world."""
    content: dict[str, Any] = {"size": [params.width_mm, params.height_mm]}
    if layout.start is not None:
        content["start"] = list(layout.start)
    return {**content, "food": [list(at) for at in layout.food], "bars": [[*a, *b] for a, b in layout.bars]}


def _params(content: Mapping[str, Any]) -> SimParams:
    if "size" not in content:
        return SimParams()
    width, height = _numbers(content["size"], "size", -1, "[width, height]")
    if not (_SIZE_MIN_MM <= width <= _WIDTH_MAX_MM and _SIZE_MIN_MM <= height <= _HEIGHT_MAX_MM):
        raise WrittenError("size", -1, f"size must be [width, height] in mm, {_SIZES}")
    return SimParams(width_mm=width, height_mm=height)


def _food(content: Mapping[str, Any], params: SimParams) -> tuple[Point, ...]:
    pieces = _list(content, "food", _FOOD_MAX)
    if not pieces:
        raise WrittenError("food", -1, "a world needs food, such as food = [[3500, 400]]")
    return tuple(
        _inside(_numbers(piece, "food", number, "[x, y]"), "food", number, params)
        for number, piece in enumerate(pieces)
    )


def _bars(content: Mapping[str, Any], params: SimParams) -> tuple[Bar, ...]:
    bars = []
    for number, entry in enumerate(_list(content, "bars", BARS_MAX)):
        numbers = _numbers(entry, "bars", number, "[x, y, x, y]")
        bar = Bar(_inside(numbers[:2], "bars", number, params), _inside(numbers[2:], "bars", number, params))
        if math.dist(bar.a, bar.b) < params.bar_thickness_mm:
            what = f"{_nth('bars', number)} must be at least {params.bar_thickness_mm:.0f} mm long"
            raise WrittenError("bars", number, what)
        bars.append(bar)
    return tuple(bars)


def _start(content: Mapping[str, Any], params: SimParams) -> tuple[float, float, float] | None:
    if "start" not in content:
        return None
    x, y, heading_deg = _numbers(content["start"], "start", -1, "[x, y, heading]")
    return *_inside([x, y], "start", -1, params), heading_deg


def _list(content: Mapping[str, Any], key: str, most: int) -> list[Any]:
    value = content.get(key, [])
    if not isinstance(value, list) or len(value) > most:
        raise WrittenError(key, -1, f"{key} must be a list of at most {most} lists, such as [[...], [...]]")
    return value


def _numbers(value: object, key: str, number: int, form: str) -> list[float]:
    """The numbers of one entry, as many as its form has."""
    count = form.count(",") + 1
    if not isinstance(value, list) or len(value) != count or not all(_is_number(part) for part in value):
        raise WrittenError(key, number, f"{_nth(key, number)} must be {form}: {count} numbers")
    return [float(part) for part in value]


def _is_number(part: object) -> bool:
    return isinstance(part, (int, float)) and not isinstance(part, bool) and abs(part) < 1e9  # noqa: PLR2004 - not even close


def _inside(point: list[float], key: str, number: int, params: SimParams) -> Point:
    x, y = point
    if not (0 <= x <= params.width_mm and 0 <= y <= params.height_mm):
        size = f"[{params.width_mm:g}, {params.height_mm:g}]"
        what = f"{_nth(key, number)}: [{x:g}, {y:g}] is outside of the arena, whose size is {size}"
        raise WrittenError(key, number, what)
    return x, y


def _nth(key: str, number: int) -> str:
    """What people call an entry: bar 3."""
    return key if number < 0 else f"{key.removesuffix('s')} {number + 1}"
