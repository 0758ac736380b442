"""What overlaps in an arena, by plain geometry in C (`native/plain_space.h`)."""

from itertools import accumulate
from math import ceil
from typing import Any

from host_sim.world.params import SimParams

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
        # cffi frees what no name holds any more.
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
