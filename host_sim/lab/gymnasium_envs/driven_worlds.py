"""Worlds whose robots carry out given actions (`native/driven.h`), several worlds per call."""

from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from host_sim.base.paths import BUILD, PACKAGE
from host_sim.world.arena import Arena
from host_sim.world.body_kinds import BodyKind
from host_sim.world.geometry import SimParams
from host_sim.world.layouts import Layout
from host_sim.world.world_library import WORLD_HEADERS, load_native

LIBRARY = BUILD / "host" / "host_sim" / "lab" / "gymnasium_envs" / "native" / "liboctet_driven.so"
HEADERS = (*WORLD_HEADERS, PACKAGE / "lab" / "gymnasium_envs" / "native" / "driven.h")


class DrivenWorlds:
    """Worlds in C, each with the same number of robots. Arrays are views of C memory: copy data to be kept.

    Attributes:
        senses: Shape (worlds, robots, 7): the fields of `Senses` after the last step.
        food_eaten: Shape (worlds, robots): pieces of food eaten in the last step.
        collisions: Shape (worlds, robots): collisions in the last step: times that a robot began to touch something.
        ticks: Shape (worlds,): control ticks since the world was entered.
        food_left: Shape (worlds,): pieces of food left.
        limit_ticks: Control ticks after which a world stops.
        arenas: The worlds in Python; None: not entered yet.
    """

    def __init__(
        self, worlds: int, robots: int, limit_ticks: int, step_ticks: int, kind: BodyKind | None = None
    ) -> None:
        """Allocates the worlds; each must be entered before the first step.

        Args:
            worlds: Number of worlds.
            robots: Number of robots in each.
            limit_ticks: Ticks after which a world stops.
            step_ticks: Ticks after which a step ends.
            kind: Properties of the bodies; None: ideal.

        Raises:
            NoNativeError: The library cannot be used.
        """
        self._ffi, self._library = loaded()
        self._given = worlds, robots, limit_ticks, step_ticks, kind
        self._kind, self.limit_ticks = kind, limit_ticks
        self.arenas: list[Arena | None] = [None] * worlds
        self._entered: list[tuple[int, Layout, int] | None] = [None] * worlds
        self._actions: list[bytes] = []
        self._forgotten = 0
        ffi, motion_size = self._ffi, self._library.driven_motion_size()
        self._motions: Any = ffi.new("char[]", worlds * robots * motion_size)
        self._robots: Any = ffi.new("struct driven_robot[]", worlds * robots)
        self._all: Any = ffi.new("struct driven[]", worlds)
        for i in range(worlds):
            driven = self._all[i]
            driven.motions = ffi.cast("struct motion *", self._motions + i * robots * motion_size)
            driven.robots, driven.limit_ticks, driven.step_ticks = self._robots + i * robots, limit_ticks, step_ticks
        self._share(worlds, robots)

    def _share(self, worlds: int, robots: int) -> None:
        """Creates numpy views of the memory that C code writes."""
        ffi, columns = self._ffi, self._library.DRIVEN_SENSES
        numbers = np.frombuffer(ffi.buffer(self._robots), np.int32).reshape(worlds, robots, columns + 2)
        self.senses: NDArray[np.int32] = numbers[..., :columns]
        self.food_eaten: NDArray[np.int32] = numbers[..., columns]
        self.collisions: NDArray[np.int32] = numbers[..., columns + 1]
        words = np.frombuffer(ffi.buffer(self._all), np.uint32).reshape(worlds, -1)
        self.ticks: NDArray[np.uint32] = words[:, ffi.offsetof("struct driven", "tick") // words.itemsize]
        self.food_left: NDArray[np.uint32] = words[:, ffi.offsetof("struct driven", "food_left") // words.itemsize]

    def enter(self, world: int, layout: Layout, seed: int) -> None:
        """Puts the robots of a world at their starts in a layout; their bodies are drawn from the seed."""
        arena = Arena(layout, SimParams(), kind=self._kind)
        if self._kind is not None:
            arena.begin(seed)
        else:
            for body in arena.inside.bodies:
                body.kit = arena.inside.ffi.NULL  # this body stays ideal
        self.arenas[world] = arena
        self._entered[world] = self._forgotten + len(self._actions), layout, seed
        self._all[world].world = self._ffi.cast("struct world *", arena.inside.address)
        self._library.driven_begin(self._ffi.addressof(self._all, world))

    def step(self, actions: NDArray[np.uint8]) -> None:
        """Carries out each robot's action, an `enum driven_action`: shape (worlds, robots), contiguous."""
        self._actions.append(actions.tobytes())
        self._library.driven_step(self._all, len(self.arenas), self._ffi.from_buffer("uint8_t[]", actions))

    def __getstate__(self) -> dict[str, Any]:
        """The actions since each world was entered: a copy repeats them, and is then equal, bit for bit."""
        first = min((it[0] for it in self._entered if it is not None), default=0)
        self._actions, self._forgotten = self._actions[first - self._forgotten :], first
        return {"given": self._given, "entered": self._entered, "actions": list(self._actions), "first": first}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__init__(*state["given"])  # type: ignore[misc]
        self._forgotten = state["first"]
        shape = state["given"][:2]
        for world, it in enumerate(state["entered"]):
            if it is not None:
                self.enter(world, *it[1:])  # each needs a world from the first step on
        for step in range(state["first"], state["first"] + len(state["actions"]) + 1):
            for world, it in enumerate(state["entered"]):
                if it is not None and it[0] == step:
                    self.enter(world, *it[1:])
            if step < state["first"] + len(state["actions"]):
                self.step(np.frombuffer(state["actions"][step - state["first"]], np.uint8).reshape(shape))

    def ended(self) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """For each world, whether all food is eaten; and if it is not, whether its time is up."""
        eaten = self.food_left == 0
        return eaten, ~eaten & (self.ticks >= self.limit_ticks)

    def info(self, world: int) -> dict[str, Any]:
        """The `info` of an environment with this world."""
        robot_s = round(int(self.ticks[world]) * SimParams.tick_s, 3)
        return {"robot_s": robot_s, "food_left": int(self.food_left[world])}


def action_count() -> int:
    """Number of a robot's actions (`enum driven_action`); raises NoNativeError if the library cannot be used."""
    return int(loaded()[1].DRIVEN_ACTIONS)


@cache
def loaded() -> tuple[Any, Any]:
    """The interface to the library, and the library; raises NoNativeError if it cannot be used."""
    return load_native(LIBRARY, "driven_", HEADERS)
