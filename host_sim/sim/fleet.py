"""A fleet: up to thousands of robots without a bus, each in a world of its own or all in one."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from itertools import chain
from typing import NamedTuple

from host_sim.base.errors import UsageError
from host_sim.protocol.words import BODY_FAULTS, NODE_MAX
from host_sim.sim.make import rehearse
from host_sim.sim.native_fleet import Contacts, NativeFleet, on_all_processors
from host_sim.sim.run_config import RunConfig
from host_sim.world.geometry import Pose, SimParams
from host_sim.world.layouts import Layout, NoRoomError, hall_of

_SEED_SPAN = 2**32
_BLOCK_TICKS = 1000
_SHARING_MAX = 10_000  # memory for contacts between robots grows with the square


class Frozen(NamedTuple):
    """A robot that no longer learns.

    Attributes:
        seed: Its seed.
        memory: Its eight cells, of the kind of its profile.
    """

    seed: int
    memory: Sequence[int]


@dataclass(frozen=True)
class FleetResult:
    """The result of one robot of a fleet in one environment.

    Attributes:
        robot: Number of the robot, from 1.
        seed: Its seed. In a world of its own, it behaves tick by tick as alone in a run with this seed.
        environment: Number of the environment, from 1.
        eaten: For each piece of food in its world, whether it was eaten.
        food_eaten: Number of pieces of food that it ate.
        ticks: Number of ticks.
        begun: Number of actions begun, by reason.
        collisions: Number of collisions: times that its body began to touch something.
        denied: Number of times that its wheels did not follow the command.
        known_ticks: Number of ticks of all environments until it knew a turn for patterns 1, 3, 4 and 6; None if it
            does not yet.
        contacts: Its contacts: times that it was blocked.
        memory: Its eight cells at the end.
        pose: Its pose at the end.
        met: The patterns at which it was blocked, in the order in which it first was: no other cell of its memory has
            made a difference.
    """

    robot: int
    seed: int
    environment: int
    eaten: tuple[bool, ...]
    food_eaten: int
    ticks: int
    begun: dict[int, int]
    collisions: int
    denied: int
    known_ticks: int | None
    contacts: Contacts
    memory: tuple[int, ...]
    pose: Pose
    met: tuple[int, ...] = field(default=(), repr=False)

    @property
    def finished(self) -> bool:
        """Whether all the food of its world was eaten."""
        return all(self.eaten)


def run_fleet(
    config: RunConfig,
    progress: Callable[[int], object] = lambda _: None,
    company: int = NODE_MAX,
    frozen: Sequence[Frozen] = (),
) -> Iterator[FleetResult]:
    """Runs a fleet.

    >>> [result.seed for result in run_fleet(RunConfig(seed=7, robots=2, worlds="own", environments=1, limit_s=1.0))]
    [7, 8]

    Args:
        config: The run, without any options for buses and boards.
        progress: Called now and then with the number of ticks that all robots have run so far.
        company: Number of robots that hear each other if their parameter `share` is on, up to `NODE_MAX`.
        frozen: The robots, each in a world of its own, instead of those of the run; by default robots that learn.

    Yields:
        The result of each robot in each environment, once it has ended.

    Raises:
        UsageError: The robots do not fit into their world or refuse their configuration, or one is changed later.
        BrainError: The user's behaviour has made a mistake.
        OctetError: Something that must be built is missing.
    """
    if frozen:
        config = replace(config, robots=len(frozen), worlds="own")
    rehearse(config)
    return _Run(config, company, frozen).results(progress)


class _Run:
    """The run of a fleet."""

    def __init__(self, config: RunConfig, company: int, frozen: Sequence[Frozen]) -> None:
        self._config, self._world, self._frozen = config, config.chosen_world, frozen
        self._drawn = lru_cache(1)(self._world.generate)  # consecutive robots may have the same seed
        params = self._world.params
        self._own = config.worlds == "own"
        self._shared = [] if self._own else _shared_worlds(config)
        if self._shared:
            params = self._shared[0][1]
        faults = _faults_of(config)
        settings, worlds = config.robot_settings, config.robots if self._own else 1
        company = company if settings.get("share") else 1
        self._fleet = NativeFleet(config.robots, worlds, params, config.chosen_body, company, own=config.own)
        for index in range(config.robots):
            self._fleet.start(index, self._seed(index), config.profile_name, settings)
            for fault in faults:
                self._fleet.damage(index, fault, self._seed(index))
        for index, robot in enumerate(frozen):
            self._fleet.teach(index, robot.memory)
        self._entered = [0] * self._fleet.worlds

    def results(self, progress: Callable[[int], object]) -> Iterator[FleetResult]:
        """Takes all robots through their environments."""
        fleet = self._fleet
        active = list(range(fleet.worlds))
        self._enter(active)
        while active:
            fleet.run(fleet.ticks_max or _BLOCK_TICKS, active)
            progress(fleet.ticks_in_all())
            over = [world for world in active if fleet.is_over(world)]
            for world in over:
                yield from self._leave(world)
            last = {world for world in over if self._entered[world] == self._config.environments}
            self._enter([world for world in over if world not in last])
            active = [world for world in active if world not in last]

    def _seed(self, index: int) -> int:
        return self._frozen[index].seed if self._frozen else (self._config.seed + index) % _SEED_SPAN

    def _enter(self, worlds: list[int]) -> None:
        """Begins the next environments of some worlds; world 0 is the shared one, or the first robot's."""
        layouts = chain.from_iterable(on_all_processors(self._layouts, worlds))
        for world, layout in zip(worlds, layouts, strict=True):
            self._fleet.enter(world, layout, round(self._config.limit_s / self._world.params.tick_s))
            self._entered[world] += 1

    def _layouts(self, worlds: Sequence[int]) -> list[Layout]:
        if self._shared:
            return [self._shared[self._entered[world]][0] for world in worlds]
        return [self._drawn(self._seed(world), self._entered[world] + 1) for world in worlds]

    def _leave(self, world: int) -> Iterator[FleetResult]:
        """Ends an environment."""
        fleet = self._fleet
        eaten = tuple(fleet.eaten(world))
        for index in (world,) if self._own else range(fleet.robots):
            yield FleetResult(
                robot=index + 1,
                seed=self._seed(index),
                environment=self._entered[world],
                eaten=eaten,
                **fleet.results_of(index),
            )


def _faults_of(config: RunConfig) -> list[str]:
    if any(it.name not in BODY_FAULTS or it.after_s or (it.number or 1) > 1 or it.robot for it in config.scheduled):
        raise UsageError("nothing changes in a fleet: its bodies have their faults from the start, such as mirror@0s")
    return [it.what for it in config.scheduled]


def shared_world(config: RunConfig, number: int) -> tuple[Layout, SimParams]:
    """An environment of robots that share one, and its dimensions.

    Raises:
        NoRoomError: There is no room for all the robots.
    """
    world = config.chosen_world
    if config.worlds == "hall":
        return hall_of(world, config.seed, number, config.robots)
    return world.generate(config.seed, number, config.robots), world.params


def _shared_worlds(config: RunConfig) -> list[tuple[Layout, SimParams]]:
    if config.robots > _SHARING_MAX:
        raise UsageError(f"at most {_SHARING_MAX} robots share a world, not {config.robots}; take --worlds own")
    try:
        return [shared_world(config, number) for number in range(1, config.environments + 1)]
    except NoRoomError as error:
        where = "a hall of such worlds" if config.worlds == "hall" else "one world"
        raise UsageError(
            f"{config.robots} robots are too many for {where} with seed {config.seed}: {error}; "
            f"take fewer, or --worlds own"
        ) from None
