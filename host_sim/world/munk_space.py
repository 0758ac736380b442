"""The space that pymunk built, for ticks in C: stepped through pymunk's own functions (`native/munk_space.h`)."""

import math
from typing import Any

from host_sim.world.arena import Arena
from host_sim.world.cones import CONE_BEARINGS_DEG, cone_outline, cone_reach_mm
from host_sim.world.munk_pointers import munk_pointers, own_pointer
from host_sim.world.params import SimParams
from host_sim.world.shapes import DISC, OBSTACLE


class MunkSpace:
    """pymunk's space, with its collisions handled in C from `take` to `give_back`."""

    def __init__(self, ffi: Any, library: Any, arena: Arena, params: SimParams) -> None:
        """Finds the arena's bodies in the space.

        Args:
            ffi: Has the declarations of `native_world.HEADERS`.
            library: Has their functions.
            arena: The arena.
            params: The dimensions of the world.

        Raises:
            NoNativeError: This pymunk's functions cannot be called from C.
        """
        self._library = library
        bodies = len(arena.bodies)
        # cffi frees what no name holds any more.
        self._munk = munk_pointers(ffi)
        self._places: Any = ffi.new("struct munk_place[]", bodies)
        self._cones = ffi.new("struct munk_cone[]", bodies * library.WORLD_CONES)
        self._loans = ffi.new("struct munk_loan[]", library.MUNK_LOANS + bodies * library.MUNK_LOANS_EACH)
        self._space: Any = ffi.new("struct munk_world *")
        self._space.munk = self._munk
        self._space.stepped = own_pointer(ffi, "struct munk_space *", arena.space, "_space")
        self._space.obstacle_type, self._space.disc_type = OBSTACLE, DISC
        self._space.reach_mm = max(
            math.hypot(*corner)
            for bit, bearing_deg in CONE_BEARINGS_DEG.items()
            for corner in cone_outline(bearing_deg, cone_reach_mm(bit, params))
        )
        self._space.places, self._space.cones, self._space.loans = self._places, self._cones, self._loans
        for place, body in zip(self._places, arena.bodies, strict=True):
            place.in_space = own_pointer(ffi, "struct munk_body *", body.in_space, "_body")
            place.disc = own_pointer(ffi, "struct munk_shape *", body.disc, "_shape")
            place.in_the_air, place.sight, place.first_cone = body.in_the_air, tuple(body.sight), body.first_cone

    def take(self, world: Any) -> None:
        """Becomes the space of a `struct world *`, whose bodies are where they are in pymunk's."""
        self._library.munk_space_borrow(self._space, world)

    def give_back(self) -> None:
        """Leaves the space to pymunk."""
        self._library.munk_space_return(self._space)
