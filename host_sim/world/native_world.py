"""An arena in C (`native/world.h`): bodies, food and obstacles, and the space that finds what overlaps."""

from collections.abc import Sequence
from typing import Any

from host_sim.world.geometry import Capsule, Point
from host_sim.world.params import SimParams
from host_sim.world.plain_space import PlainSpace
from host_sim.world.world_library import world_library


class NativeWorld:
    """The memory of an arena in C, which is there as long as this is.

    Attributes:
        ffi: Has the declarations.
        library: Has the functions.
        world: The `struct world *`.
        bodies: Its bodies, a `struct body[]`.
        food: Its food, a `struct food[]`.
        space: What finds overlaps.
    """

    def __init__(self, robots: int, food: Sequence[Point], params: SimParams) -> None:
        """Makes room.

        Args:
            robots: Number of bodies.
            food: Where the pieces of food are.
            params: The dimensions of the world.

        Raises:
            NoNativeError: The library cannot be used.
        """
        self.ffi, self.library = ffi, library = world_library()
        self.bodies: Any = ffi.new("struct body[]", robots)
        self.food: Any = ffi.new("struct food[]", [(x, y, False) for x, y in food])
        self.world: Any = ffi.new("struct world *")
        self.world.params = {name: getattr(params, name) for name, _ in ffi.typeof("struct world_params").fields}
        self.world.body_count, self.world.food_count = robots, len(food)
        self.world.bodies, self.world.food = self.bodies, self.food
        self.space = PlainSpace(ffi, library, self.world, params)

    @property
    def address(self) -> int:
        """Where the `struct world` is, for another library."""
        return int(self.ffi.cast("uintptr_t", self.world))

    def lay_out(self, obstacles: Sequence[Capsule]) -> None:
        """Takes these obstacles instead of those before. What a body touches already is not new to it."""
        self.space.lay_out(obstacles)
        self.settle()

    def settle(self) -> None:
        """Finds what all bodies overlap, now that one of them or an obstacle was moved."""
        self.library.world_settle(self.world)
