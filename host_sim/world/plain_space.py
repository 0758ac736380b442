"""An arena's ticks in C by plain geometry (`native/plain_space.h`), without pymunk's physics but with its results."""

from typing import Any

from host_sim.world.arena import Arena
from host_sim.world.params import SimParams


def cones_in_c(ffi: Any, library: Any, params: SimParams) -> Any:
    """The bodies' cones, a `struct cones *`."""
    cones = ffi.new("struct cones *")
    library.cones_set(cones, params.body_radius_mm + params.sensor_reach_mm, params.front_extra_mm)
    return cones


class PlainSpace:
    """The walls and bars of an arena as plain geometry, and its robots among them."""

    def __init__(self, ffi: Any, library: Any, arena: Arena, params: SimParams) -> None:
        """Makes room for what is found out about the bodies.

        Args:
            ffi: Has the declarations of `native_world.HEADERS`.
            library: Has their functions.
            arena: The arena.
            params: The dimensions of the world.
        """
        self._ffi, self._library, self._arena, self._params = ffi, library, arena, params
        self._places = ffi.new("struct plain_place[]", len(arena.bodies))
        self._things: tuple[Any, ...] = ()
        self._capsules: Any = None
        self._touching: Any = None
        self._space: Any = ffi.new("struct plain_world *")
        self._cones = cones_in_c(ffi, library, params)
        self._space.body_radius_mm, self._space.cones = params.body_radius_mm, self._cones
        self._space.places = self._places
        self._world: Any = None

    def take(self, world: Any) -> None:
        """Becomes the space of a `struct world *`, whose bodies are where they are in pymunk's."""
        self._world = world
        things = tuple(self._arena.obstacles.capsules)
        if things != self._things:
            self._things = things
            self._lay_out(things)
        self._library.plain_space_take(self._space, world)

    def give_back(self) -> None:
        """Has pymunk find the bodies where they are now. What it counts meanwhile is not to be used."""
        for there, body in zip(self._world.bodies[0 : self._world.body_count], self._arena.bodies, strict=True):
            body.in_space.position = body.in_the_air if there.lifted else (there.x_mm, there.y_mm)
            body.in_space.angle = there.heading_rad
        self._arena.space.step(self._params.tick_s)

    def _lay_out(self, things: tuple[Any, ...]) -> None:
        ffi, bodies = self._ffi, len(self._arena.bodies)
        self._capsules = ffi.new("struct capsule[]", len(things))
        for i, (a, b, radius_mm) in enumerate(things):
            self._library.capsule_set(ffi.addressof(self._capsules[i]), [*a], [*b], radius_mm)
        words = -(-(len(things) + bodies) // self._library.PLAIN_WORD_BITS)
        self._touching = ffi.new("uint64_t[]", words * (bodies + 1))
        self._space.capsules, self._space.capsule_count = self._capsules, len(things)
        self._space.touching, self._space.words = self._touching, words
