"""What overlaps in an arena, by plain geometry in C (`native/plain_space.h`)."""

from typing import Any

from host_sim.world.params import SimParams


def cones_in_c(ffi: Any, library: Any, params: SimParams) -> Any:
    """The bodies' cones, a `struct cones *`."""
    cones = ffi.new("struct cones *")
    library.cones_set(cones, params.body_radius_mm + params.sensor_reach_mm, params.front_extra_mm)
    return cones


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
