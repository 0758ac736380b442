"""What overlaps in an arena, by plain geometry in C (`native/plain_space.h`)."""

from collections.abc import Sequence
from typing import Any

from host_sim.world.geometry import Capsule
from host_sim.world.params import SimParams


def cones_in_c(ffi: Any, library: Any, params: SimParams) -> Any:
    """The bodies' cones, a `struct cones *`."""
    cones = ffi.new("struct cones *")
    library.cones_set(cones, params.body_radius_mm + params.sensor_reach_mm, params.front_extra_mm)
    return cones


def capsules_in_c(ffi: Any, library: Any, things: Sequence[Capsule]) -> Any:
    """Obstacles, a `struct capsule[]`."""
    capsules = ffi.new("struct capsule[]", len(things))
    for i, (a, b, radius_mm) in enumerate(things):
        library.capsule_set(capsules + i, [*a], [*b], radius_mm)
    return capsules


class PlainSpace:
    """The obstacles of an arena as plain geometry, and its bodies among them.

    Attributes:
        failures: None: C code asks nothing of Python.
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
        self._ffi, self._library, self._world = ffi, library, world
        # cffi frees what no name holds any more.
        self._places = ffi.new("struct plain_place[]", world.body_count)
        self._cones = cones_in_c(ffi, library, params)
        self._capsules: Any = None
        self._touching: Any = None
        self._space: Any = ffi.new("struct plain_world *")
        self._space.body_radius_mm, self._space.cones = params.body_radius_mm, self._cones
        self._space.places = self._places

    def lay_out(self, obstacles: Sequence[Capsule]) -> None:
        """Takes these obstacles instead of those before."""
        ffi, space, bodies = self._ffi, self._space, self._world.body_count
        self._capsules = capsules_in_c(ffi, self._library, obstacles)
        words = -(-(len(obstacles) + bodies) // self._library.PLAIN_WORD_BITS)
        self._touching = ffi.new("uint64_t[]", words * (bodies + 1))
        space.capsules, space.capsule_count = self._capsules, len(obstacles)
        space.touching, space.words = self._touching, words
        self._library.plain_space_take(space, self._world)
