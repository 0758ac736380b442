"""Worlds whose robots carry out given actions (`native/told.h`), several worlds per call."""

from functools import cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from host_sim.base.paths import BUILD, PACKAGE
from host_sim.world.arena import Arena
from host_sim.world.body_kinds import BodyKind
from host_sim.world.layouts import Layout
from host_sim.world.native_library import load_native
from host_sim.world.params import SimParams
from host_sim.world.world_library import WORLD_HEADERS

LIBRARY = BUILD / "host" / "host_sim" / "lab" / "gymnasium_envs" / "native" / "liboctet_told.so"
HEADERS = (*WORLD_HEADERS, PACKAGE / "lab" / "gymnasium_envs" / "native" / "told.h")


class TickLimits(NamedTuple):
    """Maximum control ticks of a world and of a step."""

    world: int
    step: int


class ToldWorlds:
    """Worlds in C, each with the same number of robots. Arrays are views of C memory: copy data to be kept.

    Attributes:
        senses: Shape (worlds, robots, 7): the fields of `Senses` after the last step.
        food_eaten: Shape (worlds, robots): pieces of food eaten in the last step.
        collisions: Shape (worlds, robots): collisions in the last step: times that a robot began to touch something.
        ticks: Shape (worlds,): control ticks since the world was entered.
        food_left: Shape (worlds,): pieces of food left.
    """

    def __init__(
        self, worlds: int, robots: int, limits: TickLimits, params: SimParams, kind: BodyKind | None = None
    ) -> None:
        """Allocates the worlds; each must be entered before the first step.

        Args:
            worlds: Number of worlds.
            robots: Number of robots in each.
            limits: Ticks after which a world stops, and after which a step ends.
            params: The dimensions of the worlds.
            kind: Properties of the bodies; None: ideal.

        Raises:
            NoNativeError: The library cannot be used.
        """
        self._ffi, self._library = loaded()
        self._params, self._kind = params, kind
        self._arenas: list[Arena | None] = [None] * worlds
        ffi, motion_size = self._ffi, self._library.told_motion_size()
        self._motions: Any = ffi.new("char[]", worlds * robots * motion_size)
        self._robots: Any = ffi.new("struct told_robot[]", worlds * robots)
        self._all: Any = ffi.new("struct told[]", worlds)
        for i in range(worlds):
            told = self._all[i]
            told.motions = ffi.cast("struct motion *", self._motions + i * robots * motion_size)
            told.robots, told.limit_ticks, told.step_ticks = self._robots + i * robots, limits.world, limits.step
        self._share(worlds, robots)

    def _share(self, worlds: int, robots: int) -> None:
        """Creates numpy views of the memory that C code writes."""
        ffi, columns = self._ffi, self._library.TOLD_SENSES
        numbers = np.frombuffer(ffi.buffer(self._robots), np.int32).reshape(worlds, robots, columns + 2)
        self.senses: NDArray[np.int32] = numbers[..., :columns]
        self.food_eaten: NDArray[np.int32] = numbers[..., columns]
        self.collisions: NDArray[np.int32] = numbers[..., columns + 1]
        words = np.frombuffer(ffi.buffer(self._all), np.uint32).reshape(worlds, -1)
        self.ticks: NDArray[np.uint32] = words[:, ffi.offsetof("struct told", "tick") // words.itemsize]
        self.food_left: NDArray[np.uint32] = words[:, ffi.offsetof("struct told", "food_left") // words.itemsize]

    def enter(self, world: int, layout: Layout, seed: int) -> None:
        """Puts the robots of a world at their starts in a layout.

        Args:
            world: Index of the world.
            layout: The layout, with a start for each robot.
            seed: Seed from which their bodies are drawn.
        """
        arena = Arena(layout, self._params, kind=self._kind)
        if self._kind is not None:
            arena.begin(seed)
        else:
            for body in arena.inside.bodies:
                body.kit = arena.inside.ffi.NULL  # this body stays ideal
        self._arenas[world] = arena
        self._all[world].world = self._ffi.cast("struct world *", arena.inside.address)
        self._library.told_begin(self._ffi.addressof(self._all, world))

    def step(self, deeds: NDArray[np.uint8]) -> None:
        """Carries out each robot's deed.

        Args:
            deeds: Shape (worlds, robots), contiguous: an `enum told_deed` for each robot.
        """
        told = self._ffi.from_buffer("uint8_t[]", deeds)
        self._library.told_step(self._all, len(self._arenas), told)


def deed_count() -> int:
    """Number of a robot's actions, each an `enum told_deed`; raises NoNativeError if the library cannot be used."""
    return int(loaded()[1].TOLD_DEEDS)


@cache
def loaded() -> tuple[Any, Any]:
    """The interface to the library, and the library; raises NoNativeError if it cannot be used."""
    return load_native(LIBRARY, "told_", HEADERS)
