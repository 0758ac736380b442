"""A fleet: up to thousands of robots without a bus, each in a world of its own or all in one."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import chain

from host_sim.base.errors import UsageError
from host_sim.protocol.words import NODE_MAX
from host_sim.sim.fleet_film import SAMPLE_TICKS, FleetFilm
from host_sim.sim.native_fleet import Contacts, NativeFleet, on_all_processors
from host_sim.sim.run_config import RunConfig
from host_sim.world.body_kinds import body_kind
from host_sim.world.geometry import Pose
from host_sim.world.hall import hall_of
from host_sim.world.layouts import Layout, NoRoomError
from host_sim.world.params import SimParams
from host_sim.world.worlds import world_of

_SEED_SPAN = 2**32
_BLOCK_TICKS = 1000
_SHARING_MAX = 10_000  # memory for contacts between robots grows with the square


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

    @property
    def finished(self) -> bool:
        """Whether all the food of its world was eaten."""
        return all(self.eaten)


def run_fleet(
    config: RunConfig,
    progress: Callable[[int], object] = lambda _: None,
    film: FleetFilm | None = None,
    company: int = NODE_MAX,
) -> Iterator[FleetResult]:
    """Runs a fleet.

    >>> [result.seed for result in run_fleet(RunConfig(seed=7, robots=2, worlds="own", environments=1, limit_s=1.0))]
    [7, 8]

    Args:
        config: The run, without any options for buses and boards.
        progress: Called now and then with the number of ticks that all robots have run so far.
        film: Receives a sample at the start, and one every `SAMPLE_TICKS` until it is full.
        company: Number of robots that hear each other if their parameter `share` is on, up to `NODE_MAX`.

    Yields:
        The result of each robot in each environment, once it has ended.

    Raises:
        UsageError: The robots do not fit into their world, or refuse their configuration.
        OctetError: Something that must be built is missing.
    """
    return _Run(config, film, company).results(progress)


class _Run:
    """The run of a fleet."""

    def __init__(self, config: RunConfig, film: FleetFilm | None, company: int) -> None:
        self._config, self._world = config, world_of(config.world)
        self._film = film
        params = self._world.params
        self._own = config.worlds == "own"
        self._shared = [] if self._own else _shared_worlds(config)
        if self._shared:
            params = self._shared[0][1]
        told, worlds = config.told, config.robots if self._own else 1
        company = company if told.get("share") else 1
        self._fleet = NativeFleet(config.robots, worlds, params, body_kind(config.body), company)
        for index in range(config.robots):
            self._fleet.start(index, self._seed(index), config.profile, told)
        self._entered = [0] * self._fleet.worlds

    def results(self, progress: Callable[[int], object]) -> Iterator[FleetResult]:
        """Takes all robots through their environments."""
        fleet = self._fleet
        active = list(range(fleet.worlds))
        self._enter(active)
        while active:
            self._run_block(active)
            progress(fleet.ticks_in_all())
            over = [world for world in active if fleet.is_over(world)]
            for world in over:
                yield from self._leave(world)
            last = {world for world in over if self._entered[world] == self._config.environments}
            self._enter([world for world in over if world not in last])
            active = [world for world in active if world not in last]

    def _run_block(self, worlds: list[int]) -> None:
        film, fleet = self._film, self._fleet
        if film is None or film.is_full(fleet.robots):
            fleet.run(fleet.ticks_max or _BLOCK_TICKS, worlds)
            return
        if not film.poses:
            film.add(fleet)
        fleet.run(SAMPLE_TICKS, worlds)
        film.add(fleet)

    def _seed(self, index: int) -> int:
        return (self._config.seed + index) % _SEED_SPAN

    def _robots_of(self, world: int) -> Iterable[int]:
        return (world,) if self._own else range(self._fleet.robots)

    def _enter(self, worlds: list[int]) -> None:
        """Begins the next environments of some worlds; world 0 is the shared one, or the first robot's."""
        layouts = chain.from_iterable(on_all_processors(self._layouts, worlds))
        for world, layout in zip(worlds, layouts, strict=True):
            self._fleet.enter(world, layout, round(self._config.limit_s / self._world.params.tick_s))
            self._entered[world] += 1
            if self._film:
                self._film.enter(world, layout, self._fleet.robots)

    def _layouts(self, worlds: Sequence[int]) -> list[Layout]:
        if self._shared:
            return [self._shared[self._entered[world]][0] for world in worlds]
        return [self._world.generate(self._seed(world), self._entered[world] + 1) for world in worlds]

    def _leave(self, world: int) -> Iterator[FleetResult]:
        """Ends an environment."""
        fleet = self._fleet
        eaten = tuple(fleet.eaten(world))
        for index in self._robots_of(world):
            yield FleetResult(
                robot=index + 1,
                seed=self._seed(index),
                environment=self._entered[world],
                eaten=eaten,
                **fleet.told(index),
            )


def shared_world(config: RunConfig, number: int) -> tuple[Layout, SimParams]:
    """An environment of robots that share one, and its dimensions.

    Raises:
        NoRoomError: There is no room for all the robots.
    """
    world = world_of(config.world)
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
