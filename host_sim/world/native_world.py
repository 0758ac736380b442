"""An arena in C (`native/world.h`): bodies, food and obstacles, and the space that finds what overlaps."""

import math
from collections.abc import Sequence
from itertools import accumulate
from math import ceil
from typing import Any, Protocol

from host_sim.world.body_kinds import BodyKind
from host_sim.world.geometry import Point, SimParams
from host_sim.world.layouts import Layout
from host_sim.world.names import FAST
from host_sim.world.world_library import world_library


class Space(Protocol):
    """What finds overlaps for a world in C: it provides the functions of `native/space.h`.

    Attributes:
        failures: Exceptions raised in Python during calls from C, and not raised again yet.
    """

    failures: list[BaseException]

    def lay_out(self, obstacles: Any) -> None:
        """Takes these obstacles, a `struct capsule[]`, instead of others. Present overlaps are no new collisions."""


class NativeWorld:
    """The memory of an arena in C, with the lifetime of this object.

    Attributes:
        ffi: Has the declarations.
        library: Has the functions.
        world: The `struct world *`.
        bodies: Its bodies, a `struct body[]`.
        food: Its food, a `struct food[]`.
        furniture: Its obstacles, a `struct furniture *`.
        space: What finds overlaps.
    """

    def __init__(self, layout: Layout, params: SimParams, physics: str = FAST, kind: BodyKind | None = None) -> None:
        """Puts everything in its initial place.

        Args:
            layout: Obstacles, food, and a start for each body.
            params: The dimensions of the world.
            physics: One of `PHYSICS`.
            kind: Properties of the bodies; None: ideal.

        Raises:
            NoNativeError: The library cannot be used.
        """
        self.ffi, self.library = world_library()
        ffi = self.ffi
        starts, food = layout.starts, layout.food
        self.bodies: Any = ffi.new("struct body[]", len(starts))
        for body, pose in zip(self.bodies, starts, strict=True):
            body.x_mm, body.y_mm, body.heading_rad = pose
            body.seen = -1
        self.food: Any = ffi.new("struct food[]", [(x, y, False) for x, y in food])
        self.world: Any = ffi.new("struct world *")
        self.world.params = {name: getattr(params, name) for name, _ in ffi.typeof("struct world_params").fields}
        self.world.body_count, self.world.food_count = len(starts), len(food)
        self.world.bodies, self.world.food = self.bodies, self.food
        reach = params if kind is None else kind.reach(params)
        self.space = self._space(reach, physics)
        size = params.width_mm, params.height_mm, params.bar_thickness_mm / 2, params.body_radius_mm
        self.furniture: Any = ffi.new("struct furniture *", size)
        self.library.furniture_set(self.furniture, ffi.new("struct bar[]", layout.bars), len(layout.bars))
        self._ranges: Any = ffi.new("struct ranges *")
        self._ranges.body_radius_mm, self._ranges.front_extra_mm = params.body_radius_mm, params.front_extra_mm
        self._ranges.reach_mm = params.body_radius_mm + params.sensor_reach_mm
        self.kit_ranges: Any = ffi.new("struct ranges *", self._ranges[0])
        self.kit_ranges.reach_mm = params.body_radius_mm + reach.sensor_reach_mm
        self.lay_out()

    def _space(self, params: SimParams, physics: str) -> Space:
        if physics == FAST:
            return PlainSpace(self.ffi, self.library, self.world, params)
        from host_sim.world.munk_space import MunkSpace  # noqa: PLC0415 - other runs begin sooner without pymunk

        return MunkSpace(self.ffi, self.world, self.bodies, params)

    @property
    def address(self) -> int:
        """Address of the `struct world`, for another library."""
        return int(self.ffi.cast("uintptr_t", self.world))

    def lay_out(self) -> None:
        """Takes the furniture as it is now."""
        capsules = self.furniture.capsules[0 : self.furniture.capsule_count]
        for ranges in (self._ranges, self.kit_ranges):
            ranges.capsules, ranges.capsule_count = capsules, len(capsules)
        self.space.lay_out(capsules)
        self.library.world_settle(self.world)
        self.check()

    def measure(self, index: int, tick: int) -> Sequence[int]:
        """What a body's sensors measure in that tick, in the order of feel's bits: whole mm, or `RANGE_NONE`."""
        measured = self.ffi.new("uint8_t[]", self.library.FEEL_COUNT)
        self.library.world_measure(self.world, self.bodies + index, tick, self._ranges, measured)
        return list(measured)

    def check(self) -> None:
        """Raises again what the space raised during a call from C, such as KeyboardInterrupt."""
        if self.space.failures:
            raise self.space.failures.pop()


CONE_BEARINGS_DEG = {1: 90.0, 2: 45.0, 4: 0.0, 8: -45.0, 16: -90.0}
"""Bearing of each cone's axis, clockwise from the heading, by its bit of feel: -112.5..112.5 without a gap."""

CONE_WIDTH_DEG = 45.0
"""Angle of a cone, from edge to edge."""

_FRONT = 4
_ARC_STEPS = 4


def cone_reach_mm(bit: int, params: SimParams) -> float:
    """The length of a cone from the centre of the body.

    >>> [cone_reach_mm(bit, SimParams()) for bit in CONE_BEARINGS_DEG]
    [160.0, 160.0, 160.5, 160.0, 160.0]
    """
    return params.body_radius_mm + params.sensor_reach_mm + (params.front_extra_mm if bit == _FRONT else 0.0)


def cone_outline(bearing_deg: float, reach_mm: float) -> list[Point]:
    """The corners of a cone of 45 degrees whose tip is the body's centre, in the frame of a body that faces +x.

    Args:
        bearing_deg: Bearing of the cone's axis, clockwise from the heading.
        reach_mm: Its length from the centre of the body.

    Returns:
        Six corners of a convex polygon, x and y in mm; its outer edge is within 0.4 mm of the arc.
    """
    step = math.radians(CONE_WIDTH_DEG) / _ARC_STEPS
    first = math.radians(bearing_deg - CONE_WIDTH_DEG / 2)
    # The corners are as far outside the arc as the middles of the edges are inside it.
    corner_mm = 2 * reach_mm / (1 + math.cos(step / 2))
    angles = [first + step * i for i in range(_ARC_STEPS + 1)]
    return [(0.0, 0.0), *((corner_mm * math.cos(a), corner_mm * math.sin(a)) for a in angles)]


_CELL_MM = 500.0


def cones_in_c(ffi: Any, library: Any, params: SimParams) -> Any:
    """The bodies' cones, a `struct cones *`."""
    cones = ffi.new("struct cones *")
    library.cones_set(cones, params.body_radius_mm + params.sensor_reach_mm, params.front_extra_mm)
    return cones


def grid_in_c(ffi: Any, params: SimParams, reach_mm: float, capsules: Any, bodies: int) -> tuple[Any, ...]:
    """A grid whose cells list the capsules that can be felt from there.

    Args:
        ffi: Has the declarations.
        params: The dimensions of the arena.
        reach_mm: How far a body's cones reach from its centre.
        capsules: The obstacles, a `struct capsule[]`.
        bodies: Number of bodies.

    Returns:
        A `struct plain_grid *` and the arrays to which it points.
    """
    columns, rows = ceil(params.width_mm / _CELL_MM), ceil(params.height_mm / _CELL_MM)
    cells: list[list[int]] = [[] for _ in range(columns * rows)]
    for number, capsule in enumerate(capsules):
        low, high = capsule.low, capsule.high
        for row in _cells(low.y - reach_mm, high.y + reach_mm, rows):
            for column in _cells(low.x - reach_mm, high.x + reach_mm, columns):
                cells[row * columns + column].append(number)
    parts = (
        ffi.new("uint32_t[]", [0, *accumulate(map(len, cells))]),
        ffi.new("uint32_t[]", [number for cell in cells for number in cell] or [0]),
        ffi.new("uint32_t[]", columns * rows),
        *(ffi.new("uint32_t[]", bodies) for _ in range(2)),
    )
    return ffi.new("struct plain_grid *", (_CELL_MM, columns, rows, *parts)), *parts


def _cells(low_mm: float, high_mm: float, count: int) -> range:
    """The grid columns or rows that an interval touches; positions outside belong to the nearest."""
    return range(max(0, min(count - 1, int(low_mm / _CELL_MM))), max(0, min(count - 1, int(high_mm / _CELL_MM))) + 1)


class PlainSpace:
    """The obstacles of an arena as plain geometry, and its bodies among them.

    Attributes:
        failures: Always empty: this C code does not call Python.
    """

    def __init__(self, ffi: Any, library: Any, world: Any, params: SimParams) -> None:
        """Becomes the space of a `struct world *`, whose bodies are not placed yet.

        Args:
            ffi: Has the declarations.
            library: Has the functions.
            world: The world.
            params: Its dimensions.
        """
        self.failures: list[BaseException] = []
        self._library, self._world = library, world
        # cffi frees memory to which no Python object refers.
        self._places = ffi.new("struct plain_place[]", world.body_count)
        self._cones = cones_in_c(ffi, library, params)
        bodies, most = world.body_count, library.FURNITURE_CAPSULES_MAX
        self._touching = ffi.new("uint64_t[]", (bodies + 1) * -(-(most + bodies) // library.PLAIN_WORD_BITS))
        self._space: Any = ffi.new("struct plain_world *")
        self._space.body_radius_mm, self._space.cones = params.body_radius_mm, self._cones
        self._space.places, self._space.touching = self._places, self._touching

    def lay_out(self, obstacles: Any) -> None:
        """Takes these obstacles, a `struct capsule[]`, instead of those before."""
        self._space.capsules, self._space.capsule_count = obstacles, len(obstacles)
        self._library.plain_space_take(self._space, self._world)
