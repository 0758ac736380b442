"""One layout of obstacles, food and robots for each seed and number, drawn in C."""

from dataclasses import dataclass
from typing import Any, Literal

from host_sim.world.geometry import Bar, Point, Pose
from host_sim.world.native_drawing import ReachRoom, layout_params
from host_sim.world.params import SimParams
from host_sim.world.world_library import world_library
from host_sim.world.written_layout import WrittenLayout

Style = Literal["bars", "corridors", "dead_ends"]
"""What stands in an environment, as `enum layout_style` in `native/layout.h` explains it."""


@dataclass(frozen=True)
class Layout:
    """The initial layout of an environment.

    Attributes:
        bars: The obstacles.
        food: Centers of the pieces of food.
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
        """Describes the environment of that number."""
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
