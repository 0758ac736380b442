"""Assembles a run: robots, the world around them, and their pacing."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import replace

from host_sim.base.errors import RefusedError, UsageError
from host_sim.client.commands import start
from host_sim.client.frame_log import FrameLog, NoLog
from host_sim.client.pacing import Lockstep, Pace, RealTime
from host_sim.client.robot_client import RobotClient
from host_sim.client.session import Session
from host_sim.protocol.codec import NODE_MAX
from host_sim.sim.connect import Connector
from host_sim.sim.run_config import RunConfig
from host_sim.sim.simulation import Simulation
from host_sim.world.changes import Change
from host_sim.world.layouts import NoRoomError

Memory = Sequence[int]

_SEED_SPAN = 2**32
_REHEARSAL_S = 60.0


@contextmanager
def make(
    config: RunConfig | None = None,
    log: FrameLog | None = None,
    memories: Sequence[Memory | None] = (),
    ready: Callable[[RobotClient], object] = lambda _: None,
) -> Iterator[Simulation]:
    """Assembles a run and starts the robots, which then wait for their first senses.

    >>> with make(RunConfig(seed=1, environments=1, limit_s=2.0)) as simulation:
    ...     for episode in simulation.run():
    ...         print(episode.ticks, episode.eaten)
    100 [False, False, False]

    Tick by tick, with the robot's senses and drives:

    >>> with make(RunConfig(seed=1, environments=1)) as simulation:
    ...     simulation.enter(1)
    ...     simulation.step()
    ...     simulation.senses[0].feel, simulation.drives[0].left_mm_s
    (0, 200)

    Args:
        config: The run; by default, that of a command line without options, with the robot in this process.
        log: Records every frame; the caller closes it. By default frames are discarded.
        memories: For each robot, the eight cells to write at its start; None, or no entry, leaves its memory alone.
        ready: Called with each robot's client once the robot has answered.

    Yields:
        The simulation, before its first environment. Leaving the context ends the robots.

    Raises:
        UsageError: The configuration is invalid.
        OctetError: Something that must be built or installed is missing.
        RobotError: A robot does not answer.
    """
    config = config or RunConfig()
    _check(config)
    with ExitStack() as stack:
        if log is None:
            log = NoLog()
            stack.callback(log.close)
        clients = []
        connector = Connector(stack, config.access)
        for node in config.nodes:
            client = connector.client(node, log)
            ready(client)
            clients.append(client)
        yield assemble(clients, config, memories)


def assemble(clients: Sequence[RobotClient], config: RunConfig, memories: Sequence[Memory | None] = ()) -> Simulation:
    """Starts robots that are connected already and puts a world around them; `make` connects them too.

    Raises:
        UsageError: There is no such world, or a robot refuses its configuration.
        RobotError: A robot does not answer.
    """
    world = config.chosen_world
    start_robots(clients, config, memories)
    pace: Pace = RealTime(clients, world.params.tick_s) if config.real_time else Lockstep(clients)
    simulation = Simulation(
        *(world, clients, pace, config.seed, config.environments, config.limit_s),
        changes=config.scheduled,
        physics=config.chosen_physics,
        kind=config.chosen_body,
    )
    simulation.record.own = config.source
    return simulation


def start_robots(clients: Sequence[RobotClient], config: RunConfig, memories: Sequence[Memory | None] = ()) -> None:
    """Starts each robot with its own seed: the first with the run's seed, each other one with the next number.

    Raises:
        UsageError: A robot refuses its configuration.
        RobotError: A robot does not answer.
    """
    for index, client in enumerate(clients):
        profile = client.protocol.choices("COMMAND", "profile")[config.profile_name]
        memory = memories[index] if index < len(memories) else None
        try:
            start(client, Session((config.seed + index) % _SEED_SPAN, profile, config.robot_settings), memory)
        except RefusedError as refused:
            raise UsageError(f"{refused}; give values within the robot's range") from refused


def rehearse(config: RunConfig) -> None:
    """Runs a user's behaviour for a minute in a process that checks it: where it runs fast, some mistakes do harm.

    Raises:
        BrainError: It has made a mistake.
    """
    if config.own is None:
        return
    alone = replace(config, robots=1, worlds="one", environments=1, changes=(), bus="none", robot="spawn", fast=False)
    with make(replace(alone, limit_s=min(config.limit_s, _REHEARSAL_S))) as simulation:
        for _ in simulation.run():
            simulation.clients[0].connection.status()


def _check(config: RunConfig) -> None:
    if config.nodes.stop - 1 > NODE_MAX:
        last = config.nodes.stop - 1
        raise UsageError(f"{config.robots} robots from node {config.node} need node {last}; the last is {NODE_MAX}")
    for change in config.scheduled:
        _check_change(change, config)
    if config.robots == 1:
        return
    try:
        for number in range(1, config.environments + 1):
            config.chosen_world.generate(config.seed, number, config.robots)
    except NoRoomError as error:
        raise UsageError(f"{config.robots} robots are too many for seed {config.seed}: {error}") from None


def _check_change(change: Change, config: RunConfig) -> None:
    for what, number, last in (
        ("environment", change.number, config.environments),
        ("robot", change.robot, config.robots),
    ):
        if (number or 1) > last:
            raise UsageError(f"{change.what} is scheduled for {what} {number}, but the run has {last}")
