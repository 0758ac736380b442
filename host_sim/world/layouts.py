"""Layouts of environments: drawn from a seed, written by a person, or side by side in a hall for many robots."""

import math
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import ceil, sqrt
from typing import Any, Literal

from host_sim.world.geometry import Bar, Plant, Point, Pose, SimParams
from host_sim.world.world_library import world_library


class Obstacles:
    """The obstacles and walls of an arena for C code.

    Attributes:
        in_c: A `struct obstacles *`, as long as this object lives.
    """

    def __init__(self, bars: Sequence[Bar], plants: Sequence[Plant], params: SimParams) -> None:
        """Copies them."""
        ffi, _ = world_library()
        self._bars, self._plants = ffi.new("struct bar[]", bars), ffi.new("struct plant[]", plants)
        size = params.width_mm, params.height_mm, params.bar_thickness_mm / 2
        self.in_c: Any = ffi.new("struct obstacles *", (*size, len(bars), len(plants), self._bars, self._plants))


class ReachRoom:
    """Working memory in which C code finds paths.

    Attributes:
        in_c: A `struct reach *`, as long as this object lives.
    """

    def __init__(self, cells: int) -> None:
        """Makes room for a number of cells."""
        ffi, _ = world_library()
        self._cells, self._stack = ffi.new("uint8_t[]", cells), ffi.new("uint32_t[]", cells)
        self.in_c: Any = ffi.new("struct reach *", (self._cells, self._stack))


def layout_params(params: SimParams) -> tuple[object, ...]:
    """The members of a `struct layout_params`."""
    bands = params.food_bands_mm
    return (
        params.width_mm,
        params.height_mm,
        params.body_radius_mm,
        params.sensor_reach_mm,
        params.bar_thickness_mm,
        *params.bar_length_mm,
        [low for low, _ in bands],
        [high for _, high in bands],
        params.bar_count,
        len(bands),
    )


KEYS = ("size", "start", "food", "bars")
"""The keys of a written world, in the order of `enum written_key`."""

_LISTS = KEYS[2:]


@dataclass(frozen=True)
class WrittenLayout:
    """Always the same layout; only a start that is not given is drawn.

    Attributes:
        bars: The obstacles.
        food: Centres of the pieces of food, at least one.
        start: The first robot's start, x and y in mm and the heading in degrees; None to draw one each time.
    """

    bars: tuple[Bar, ...]
    food: tuple[Point, ...]
    start: tuple[float, float, float] | None = None

    def content(self) -> dict[str, list[Any]]:
        """The keys and values of its file."""
        start = {} if self.start is None else {"start": list(self.start)}
        return {**start, "food": [list(at) for at in self.food], "bars": [[*a, *b] for a, b in self.bars]}

    def in_c(self) -> Any:
        """The same as a `struct written *`."""
        return written_in_c(self.content())


def written_in_c(content: Mapping[str, Any]) -> Any:
    """A `struct written *` with these keys and values, right or wrong.

    Raises:
        OctetError: The C code is not built.
    """
    ffi, library = world_library()
    written = ffi.new("struct written *")
    library.written_clear(written)
    for key in content.keys() & KEYS:
        number, value = KEYS.index(key), content[key]
        if key not in _LISTS:
            _put(library.written_entry(written, number, 0), value)
        elif not isinstance(value, list):
            library.written_list(written, number, library.WRITTEN_NO_LIST)
        else:
            library.written_list(written, number, len(value))
            for index, entry in enumerate(value[: library.LAYOUT_BARS_MAX]):
                if there := library.written_entry(written, number, index):
                    _put(there, entry)
    return written


def _put(there: Any, entry: object) -> None:
    """Fills in a `struct written_entry *`."""
    if not isinstance(entry, list):
        there.count = -1
        return
    there.count, there.numbers = len(entry), [_number(part) for part in entry[: len(there.numbers)]]


def _number(part: object) -> float:
    if isinstance(part, bool) or not isinstance(part, (int, float)):
        return math.nan
    return float(part) if abs(part) < sys.float_info.max else math.inf


Style = Literal["bars", "corridors", "dead_ends"]
"""What stands in an environment, as `enum layout_style` in `native/layout.h` explains it."""


@dataclass(frozen=True)
class Layout:
    """The initial layout of an environment.

    Attributes:
        bars: The obstacles.
        food: Centres of the pieces of food.
        start: The first robot's start pose.
        other_starts: The other robots' start poses.
    """

    bars: tuple[Bar, ...]
    food: tuple[Point, ...]
    start: Pose
    other_starts: tuple[Pose, ...] = ()

    @property
    def starts(self) -> tuple[Pose, ...]:
        """Every robot's start pose."""
        return self.start, *self.other_starts


class NoRoomError(ValueError):
    """More robots than fit into an environment.

    Attributes:
        fitting: Number of robots that fit.
    """

    def __init__(self, number: int, fitting: int) -> None:
        """Takes the number of the environment, and that of the robots that fit."""
        super().__init__(f"there is room for {fitting} robots in environment {number}")
        self.fitting = fitting


def generate(seed: int, number: int, params: SimParams, robots: int = 1) -> Layout:
    """Draws the layout of the random world for a seed and a number: always the same.

    >>> layout = generate(seed=1, number=1, params=SimParams())
    >>> len(layout.bars), len(layout.food), len(layout.starts)
    (6, 3, 1)

    The arguments and the errors are those of `World.generate`.
    """
    return World("random", params).generate(seed, number, robots)


@dataclass(frozen=True)
class CrateKind:
    """Properties of bars that robots can push.

    Attributes:
        kg_per_m2: Mass by the area on the floor.
        friction: Coefficient of friction, with the floor and with what touches them.
    """

    kg_per_m2: float
    friction: float


@dataclass(frozen=True)
class World:
    """A kind of environment.

    Attributes:
        name: Its name.
        params: Its dimensions.
        draw: How its layouts are drawn, or its only layout.
        crates: Properties of bars that robots can push; None: bars are fixed.
    """

    name: str
    params: SimParams
    draw: Style | WrittenLayout = "bars"
    crates: CrateKind | None = None

    def generate(self, seed: int, number: int, robots: int = 1) -> Layout:
        """Draws the layout for a seed and a number: always the same one.

        The layout is fair: nothing is within sensor reach of a start or of a piece of food, and every piece can be
        reached from each start. More robots do not change the rest of the layout.

        Args:
            seed: The run's seed, any integer of 64 bits.
            number: Number of the environment, any integer of 64 bits.
            robots: Number of robots, at least 1.

        Returns:
            The first fair layout drawn.

        Raises:
            ValueError: The world is so crowded that 1000 draws gave no fair layout, or has more obstacles or food
                than can be drawn.
            NoRoomError: There is no room for all the robots.
            OctetError: The C code is not built.
        """
        ffi, library = world_library()
        self._check(library.LAYOUT_BARS_MAX, library.LAYOUT_FOOD_MAX)
        starts, out = ffi.new("struct pose[]", robots), ffi.new("struct layout *")
        out.starts = starts
        kind = self._in_c(ffi)
        which = ffi.new("struct layout_which *", (seed, number, robots))
        room = ReachRoom(library.reach_size(self.params.width_mm, self.params.height_mm))
        if not library.layouts_draw(kind[0], which, room.in_c, out):
            raise ValueError(f"no fair environment in 1000 draws for seed {seed}, number {number}: {self.params}")
        if out.start_count < robots:
            raise NoRoomError(number, out.start_count)
        return _layout_of(ffi, out)

    def _check(self, bars_max: int, food_max: int) -> None:
        bars, pieces = self.params.bar_count, len(self.params.food_bands_mm)
        if not (0 <= bars <= bars_max and pieces <= food_max):
            most = f"at most {bars_max} obstacles and {food_max} pieces of food can be drawn"
            raise ValueError(f"{most}, not {bars} and {pieces}")

    @property
    def style(self) -> int:
        """What `draw` is in C, an `enum layout_style`."""
        _, library = world_library()
        style = "WRITTEN" if isinstance(self.draw, WrittenLayout) else self.draw.upper()
        return int(getattr(library, f"LAYOUT_{style}"))

    def _in_c(self, ffi: Any) -> tuple[Any, Any]:
        """A `struct layout_kind *`, and what it points to."""
        written = self.draw.in_c() if isinstance(self.draw, WrittenLayout) else ffi.NULL
        return ffi.new("struct layout_kind *", (self.style, layout_params(self.params), written)), written


def _layout_of(ffi: Any, drawn: Any) -> Layout:
    """The layout that C code has drawn, a `struct layout *`."""
    bars, food, starts = (
        zip(*[iter(ffi.unpack(ffi.cast("double *", numbers), count * size))] * size, strict=True)
        for numbers, count, size in (
            (drawn.bars, drawn.bar_count, 4),
            (drawn.food, drawn.food_count, 2),
            (drawn.starts, drawn.start_count, 3),
        )
    )
    start, *others = (Pose(*numbers) for numbers in starts)
    return Layout(tuple(Bar((ax, ay), (bx, by)) for ax, ay, bx, by in bars), tuple(food), start, tuple(others))


_ROBOTS_EACH = 16
_SEED_SPAN = 2**32


def hall_of(world: World, seed: int, number: int, robots: int) -> tuple[Layout, SimParams]:
    """The layout of a hall with at most sixteen robots in each arena, and its dimensions.

    Each arena is fair by itself: its robots can get to its food.

    >>> from host_sim.world.worlds import world_of
    >>> layout, params = hall_of(world_of("random"), seed=1, number=1, robots=60)
    >>> len(layout.starts), len(layout.food), params.width_mm, params.height_mm
    (60, 12, 8000.0, 6000.0)

    Args:
        world: What the arenas are drawn from.
        seed: Seed of the first arena; each other one has the next number.
        number: Number of the environment.
        robots: Number of robots.

    Raises:
        NoRoomError: An arena has no room for its robots.
    """
    columns = ceil(sqrt(ceil(robots / _ROBOTS_EACH)))
    rows = ceil(robots / _ROBOTS_EACH / columns)
    params = replace(world.params, width_mm=world.params.width_mm * columns, height_mm=world.params.height_mm * rows)
    arenas = []
    for i in range(columns * rows):
        here = robots // (columns * rows) + (i < robots % (columns * rows))
        layout = world.generate((seed + i) % _SEED_SPAN, number, max(1, here))
        arenas.append(
            _moved(layout, i % columns * world.params.width_mm, i // columns * world.params.height_mm, here)
        )
    start, *others = [start for arena in arenas for start in arena[2]]
    bars, food = [bar for arena in arenas for bar in arena[0]], [at for arena in arenas for at in arena[1]]
    return Layout(tuple(bars), tuple(food), start, tuple(others)), params


def _moved(layout: Layout, x_mm: float, y_mm: float, robots: int) -> tuple[list[Bar], list[Point], list[Pose]]:
    """The bars, the food and a number of starts of an arena, in its place in the hall."""

    def there(point: Point) -> Point:
        return point[0] + x_mm, point[1] + y_mm

    starts = [Pose(*there(start[:2]), start.heading_rad) for start in layout.starts[:robots]]
    return [Bar(there(bar.a), there(bar.b)) for bar in layout.bars], [there(at) for at in layout.food], starts
