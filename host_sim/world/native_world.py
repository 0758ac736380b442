"""An arena in C (`native/world.h`): bodies, food and obstacles, and the space that finds what overlaps."""

from collections.abc import Sequence
from typing import Any, Protocol

from host_sim.world.body_kinds import BodyKind
from host_sim.world.geometry import SimParams
from host_sim.world.layouts import Layout
from host_sim.world.names import FAST
from host_sim.world.plain_space import PlainSpace
from host_sim.world.world_library import world_library


class Space(Protocol):
    """What finds overlaps for a world in C: it provides the functions of `native/space.h`.

    Attributes:
        failures: Exceptions raised in Python during calls from C, and not raised again yet.
    """

    failures: list[BaseException]

    def lay_out(self, obstacles: Any) -> None:
        """Takes these obstacles, a `struct capsule[]`, instead of others. What a body touches is not new to it."""


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
        """Puts everything where it begins.

        Args:
            layout: Obstacles, food, and a start for each body.
            params: The dimensions of the world.
            physics: One of `PHYSICS`.
            kind: What the bodies are like; None: ideal.

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
        """Where the `struct world` is, for another library."""
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
