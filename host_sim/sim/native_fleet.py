"""Thousands of robots in C (`native/fleet.h`): each has its own core, without a bus."""

import os
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from host_sim.base.errors import BrainError, UsageError
from host_sim.base.paths import BUILD, PACKAGE
from host_sim.protocol.generated import ANSWER_WANTS_RANGES, CELL_COUNT, OWN_PROFILE, PARAMETERS, PROFILES, Opcode
from host_sim.world.body_kinds import BodyKind, add_fault, draw_body
from host_sim.world.geometry import Pose, SimParams
from host_sim.world.layouts import Layout
from host_sim.world.native_world import cones_in_c, grid_in_c
from host_sim.world.world_library import WORLD_HEADERS, load_native, world_library

if TYPE_CHECKING:
    from host_sim.sim.own_brain import OwnBrain

LIBRARY = BUILD / "host" / "host_sim" / "sim" / "native" / "liboctet_fleet.so"
HEADERS = (*WORLD_HEADERS, PACKAGE / "sim" / "native" / "fleet.h")

_Done = TypeVar("_Done")
_GRID_FROM = 8
_WHOLE_HALF = 0xF  # of WRITE: all four cells of a half
_SLICE, _SLICES = 20, 16  # work items that a thread takes at a time: few enough for all threads to be busy to the end


class Contacts(NamedTuple):
    """The contacts of a robot in an environment: times that it was blocked.

    Attributes:
        number: Number of contacts.
        ticks: Total duration, ticks.
        longest_ticks: Longest duration, ticks.
        goes_on: Whether the last contact had not ended when the environment did.
    """

    number: int
    ticks: int
    longest_ticks: int
    goes_on: bool


class NativeFleet:
    """Robots in one or several worlds.

    Attributes:
        robots: Number of robots.
        worlds: Number of worlds: 1, or as many as there are robots.
        ticks_max: Maximum number of ticks per call of `run`; None for any.
    """

    def __init__(  # noqa: PLR0913 - the robots, and all that is around them
        self,
        robots: int,
        worlds: int,
        params: SimParams,
        kind: BodyKind | None = None,
        company: int = 1,
        *,
        own: "OwnBrain | None" = None,
    ) -> None:
        """Allocates the robots and worlds.

        Args:
            robots: Number of robots.
            worlds: 1, or as many as there are robots.
            params: The dimensions of the worlds.
            kind: Properties of the bodies; None: ideal.
            company: Number of consecutive robots that hear each other.
            own: The user's behaviour of the robots; None for the firmware's.

        Raises:
            NoNativeError: The library cannot be used.
        """
        self.robots, self.worlds = robots, worlds
        self._params = params
        world_library()  # before the threads need it: each would load its own
        self._own = own
        self._ffi, self._library = loaded(own.fleet if own else LIBRARY)
        ffi = self._ffi
        self._each = robots // worlds  # robots per world
        # cffi frees memory once no name refers to it.
        self._things: list[tuple[Any, ...]] = [()] * worlds
        self._grids: list[tuple[Any, ...]] = [()] * worlds
        self._kind, reach = kind, params if kind is None else kind.reach(params)
        self._cones = cones_in_c(ffi, self._library, reach)
        self._kits: list[Any] = [None] * robots
        self._ranges: Any = None if kind is None else world_library()[0].new("struct ranges[]", worlds)
        for ranges in self._ranges or ():
            ranges.body_radius_mm = params.body_radius_mm
            ranges.reach_mm = params.body_radius_mm + reach.sensor_reach_mm
        self._cores = ffi.new("char[]", robots * self._library.fleet_core_size())
        self._bodies: Any = ffi.new("struct body[]", robots)
        self._places: Any = ffi.new("struct plain_place[]", robots)
        self._worlds: Any = ffi.new("struct world[]", worlds)
        self._spaces: Any = ffi.new("struct plain_world[]", worlds)
        self._robots: Any = ffi.new("struct fleet_robot[]", robots)
        self._company: Any = ffi.new("uint8_t[]", robots * CELL_COUNT)
        self.ticks_max: int | None = self._library.FLEET_SECOND_TICKS if company > 1 else None
        self._bind()
        for index in range(robots if company > 1 else 0):
            first, robot = index - index % company, self._robots[index]
            robot.company, robot.company_place = self._company + first * CELL_COUNT, index - first
            robot.company_size = min(company, robots - first)

    def start(self, index: int, seed: int, profile: str, settings: Mapping[str, int]) -> None:
        """Starts a robot with an empty memory.

        Raises:
            UsageError: The robot refuses its configuration, or needs a feature that a fleet lacks.
        """
        robot = self._robots[index]
        if self._kind is not None:
            kit = self._kits[index] = draw_body(self._kind, seed, 0)
            kit.ranges = self._ranges + index // self._each
            self._bodies[index].kit = self._ffi.cast("struct kit *", _address(kit))
        self._library.fleet_wake(self._robots + index)
        if self._command(robot, Opcode.START, PROFILES.get(profile, OWN_PROFILE), seed) & ANSWER_WANTS_RANGES:
            raise UsageError(f"profile {profile} needs distances, which a fleet lacks: choose another one")
        for name, value in settings.items():
            self._command(robot, Opcode.SET, PARAMETERS[name].number, value)

    def teach(self, index: int, memory: Sequence[int]) -> None:
        """Writes the eight cells of a started robot, and freezes its learning."""
        robot, half = self._robots[index], CELL_COUNT // 2
        for upper, cells in enumerate((memory[:half], memory[half:])):
            self._command(robot, Opcode.WRITE, upper << half | _WHOLE_HALF, int.from_bytes(bytes(cells), "little"))
        self._command(robot, Opcode.FREEZE, 1, 0)

    def damage(self, index: int, what: str, seed: int) -> None:
        """Adds a fault to the body of a robot, such as "mirror"."""
        faults = _address(self._ffi.addressof(self._bodies[index], "faults"))
        add_fault(world_library()[0].cast("struct body_faults *", faults), what, seed)

    def enter(self, world: int, layout: Layout, ticks_max: int) -> None:
        """Puts the robots of a world into another environment; their odometers keep their values.

        Args:
            world: Index of the world.
            layout: The environment.
            ticks_max: Number of ticks after which it ends, finished or not.
        """
        self._lay_out(world, layout)
        for i, pose in enumerate(layout.starts):
            index = world * self._each + i
            body, robot = self._bodies[index], self._robots[index]
            body.x_mm, body.y_mm, body.heading_rad = pose
            body.seen, body.collisions, body.depth_mm = -1, 0, 0.0
            robot.ticks, robot.ticks_max, robot.food_eaten, robot.met = 0, ticks_max, 0, 0
            robot.begun = [0] * self._library.FLEET_REASONS
            robot.denied = robot.contacts = robot.blocked_ticks = robot.blocked_longest = robot.blocked_now = 0
        self._library.world_begin(self._worlds + world)
        self._library.plain_space_take(self._spaces + world, self._worlds + world)

    def run(self, ticks: int, worlds: Sequence[int] | None = None) -> int:
        """Runs all robots for a number of ticks, or to the ends of their environments.

        Robots in worlds of their own run on all processors; those that hear each other hear the state before the run.

        Args:
            ticks: At most `ticks_max`.
            worlds: The worlds that have not ended, in ascending order, to save time; None: not known.

        Returns:
            The number of robots whose environment has not ended.

        Raises:
            BrainError: The user's behaviour has made a mistake.
        """
        left = self._run(ticks, worlds)
        if self._own and (failure := self._ffi.string(self._library.own_failure(self._ffi.NULL))):
            raise BrainError.from_failure(self._own.named(bytes(failure).decode(errors="replace")))
        return left

    def _run(self, ticks: int, worlds: Sequence[int] | None) -> int:
        if second := self.ticks_max:
            self._library.fleet_memories(self._robots, self.robots, self._company)
            if self.worlds < self.robots:  # to the end of their current second
                ticks = min(ticks, second - self._robots[0].tick % second)
        if self.worlds < self.robots:
            return int(self._library.fleet_run_together(self._robots, self.robots, ticks))

        def run(some: Sequence[int]) -> int:
            return int(self._library.fleet_run_alone(self._robots + some[0], some[-1] - some[0] + 1, ticks))

        return sum(on_all_processors(run, range(self.robots) if worlds is None else worlds))

    def is_over(self, world: int) -> bool:
        """Whether a world's environment has ended."""
        robot = self._robots[world * self._each]
        return bool(robot.ticks >= robot.ticks_max) or not self._library.world_food_left(self._worlds + world)

    def eaten(self, world: int) -> list[bool]:
        """For each piece of food in a world, whether it has been eaten."""
        there = self._worlds[world]
        return [bool(food.eaten) for food in there.food[0 : there.food_count]]

    def ticks(self, index: int) -> int:
        """Number of ticks of a robot in its environment so far."""
        return int(self._robots[index].ticks)

    def results_of(self, index: int) -> dict[str, Any]:
        """A robot's results in its environment so far, by the fields of a `FleetResult`."""
        robot, body = self._robots[index], self._bodies[index]
        return {
            "food_eaten": int(robot.food_eaten),
            "ticks": self.ticks(index),
            "begun": {reason: count for reason, count in enumerate(robot.begun) if count},
            "collisions": int(body.collisions),
            "denied": int(robot.denied),
            "known_ticks": int(robot.known_ticks) or None,
            "contacts": Contacts(robot.contacts, robot.blocked_ticks, robot.blocked_longest, bool(robot.blocked_now)),
            "memory": tuple(self._memories(index, 1)),
            "met": tuple(pattern for at in range(0, 32, 4) if (pattern := robot.met >> at & 15)),
            "pose": Pose(body.x_mm, body.y_mm, body.heading_rad),
        }

    def memories(self) -> list[bytes]:
        """All robots' memories."""
        cells = self._memories(0, self.robots)
        return [cells[at : at + CELL_COUNT] for at in range(0, len(cells), CELL_COUNT)]

    def _memories(self, first: int, count: int) -> bytes:
        cells = self._ffi.new("uint8_t[]", count * CELL_COUNT)
        self._library.fleet_memories(self._robots + first, count, cells)
        return bytes(self._ffi.buffer(cells))

    def meals(self) -> NDArray[np.uint32]:
        """The number of pieces of food that each robot has eaten in its environment."""
        return self._column("food_eaten")

    def ticks_in_all(self) -> int:
        """Number of ticks of all robots in all their environments so far."""
        return int(self._column("tick").sum(dtype=np.uint64))

    def _column(self, name: str) -> NDArray[np.uint32]:
        at = self._ffi.offsetof("struct fleet_robot", name)
        robots = np.frombuffer(self._ffi.buffer(self._robots), np.uint8).reshape(self.robots, -1)
        return np.asarray(robots[:, at : at + 4].copy().view(np.uint32)[:, 0])

    def _bind(self) -> None:
        ffi, size = self._ffi, self._library.fleet_core_size()
        for index, robot in enumerate(self._robots):
            world = index // self._each
            robot.core = ffi.cast("struct fleet_core *", self._cores + index * size)
            robot.world, robot.body = ffi.addressof(self._worlds[world]), ffi.addressof(self._bodies[index])
        params = {name: getattr(self._params, name) for name, _ in ffi.typeof("struct world_params").fields}
        for world, (there, space) in enumerate(zip(self._worlds, self._spaces, strict=True)):
            there.params = params
            there.bodies, there.body_count = self._bodies + world * self._each, self._each
            space.body_radius_mm, space.cones = self._params.body_radius_mm, self._cones
            space.places = self._places + world * self._each

    def _lay_out(self, world: int, layout: Layout) -> None:
        ffi, library, params = self._ffi, self._library, self._params
        count = library.WALLS + len(layout.bars)
        capsules, food = ffi.new("struct capsule[]", count), ffi.new("struct food[]", layout.food)
        library.capsule_set_walls(capsules, params.width_mm, params.height_mm)
        for i, (a, b) in enumerate(layout.bars, library.WALLS):
            library.capsule_set(capsules + i, a, b, params.bar_thickness_mm / 2)
        if self._each >= _GRID_FROM:
            grid = self._grids[world] = grid_in_c(ffi, params, self._cones.reach_mm, capsules, self._each)
            self._spaces[world].grid = grid[0]
        words = -(-(count + self._each) // library.PLAIN_WORD_BITS)
        touching = ffi.new("uint64_t[]", words * (self._each + 1))
        self._things[world] = capsules, food, touching
        there, space = self._worlds[world], self._spaces[world]
        there.food, there.food_count = food, len(layout.food)
        if self._ranges is not None:
            ranges = self._ranges[world]
            ranges.capsules = world_library()[0].cast("struct capsule *", int(ffi.cast("uintptr_t", capsules)))
            ranges.capsule_count = count
        space.capsules, space.capsule_count, space.touching, space.words = capsules, count, touching, words

    def _command(self, robot: Any, opcode: int, which: int, value: int) -> int:
        answer = self._ffi.new("uint32_t *")
        if self._library.fleet_command(self._ffi.addressof(robot), opcode, which, value, answer):
            raise UsageError(
                f"the robot refuses {Opcode(opcode).name.lower()} {which} {value}: check profile and --set"
            )
        return int(answer[0])


def on_all_processors(work: Callable[[Sequence[int]], _Done], numbers: Sequence[int]) -> list[_Done]:
    """Maps batches of numbers through C code, results in order; calls must not share data that they change."""
    size = min(_SLICE, len(numbers) // _SLICES + 1)
    slices = [numbers[at : at + size] for at in range(0, len(numbers), size)]
    with ThreadPoolExecutor(os.cpu_count()) as threads:
        return list(threads.map(work, slices))  # after an interruption, the rest is not waited for


def _address(pointer: Any) -> int:
    return int(world_library()[0].cast("uintptr_t", pointer))


@cache
def loaded(library: Path = LIBRARY) -> tuple[Any, Any]:
    """The library, or one that is linked with a user's behaviour.

    Raises:
        NoNativeError: The library cannot be used.
    """
    return load_native(library, "fleet_", HEADERS)
