"""Assembles a run: robots, the world around them, and their pacing."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from pathlib import Path
from random import Random

from host_sim.backends.bus_lines import BusLines
from host_sim.backends.connect import connect
from host_sim.base.errors import RefusedError, UsageError
from host_sim.client.commands import start
from host_sim.client.connection import Connection
from host_sim.client.frame_log import FrameLog, NoLog
from host_sim.client.handshake import handshake
from host_sim.client.pacing import Lockstep, Pace, RealTime
from host_sim.client.punctuality import Limits
from host_sim.client.robot_client import RobotClient
from host_sim.client.session import Session
from host_sim.protocol.codec import NODE_MAX, Protocol
from host_sim.sim.run_config import RunConfig
from host_sim.sim.simulation import Simulation
from host_sim.transport.clock import VirtualClock, WallClock
from host_sim.world.body_kinds import PINS, body_kind
from host_sim.world.changes import Change
from host_sim.world.layouts import NoRoomError, World
from host_sim.world.worlds import world_of

Memory = Sequence[int]

_EXTERNAL_S = 15.0
_SEED_SPAN = 2**32
_OWNER_MAX = 255


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
    _check(config, world_of(config.world))
    with ExitStack() as stack:
        if log is None:
            log = NoLog()
            stack.callback(log.close)
        clients = []
        lines = BusLines(
            config.bus, config.nodes, config.bitrate, config.reconnect_s, config.robot_command, config.program
        )
        for node in config.nodes:
            client = connected(stack, config, node, lines, log)
            ready(client)
            clients.append(client)
        yield assemble(clients, config, memories)


def assemble(clients: Sequence[RobotClient], config: RunConfig, memories: Sequence[Memory | None] = ()) -> Simulation:
    """Starts robots that are connected already and puts a world around them; `make` connects them too.

    Raises:
        UsageError: There is no such world, or a robot refuses its configuration.
        RobotError: A robot does not answer.
    """
    world = world_of(config.world)
    start_robots(clients, config, memories)
    pace: Pace = RealTime(clients, world.params.tick_s) if config.real_time else Lockstep(clients)
    changes = [Change.parse(change) for change in config.changes]
    simulation = Simulation(
        *(world, clients, pace, config.seed, config.environments, config.limit_s),
        changes=changes,
        physics=config.chosen_physics,
        kind=body_kind(config.body),
    )
    if config.program:
        from host_sim.backends.programmed_robot import read_program  # noqa: PLC0415 - a run without one begins sooner

        simulation.record.program = read_program(Path(config.program))
    return simulation


def start_robots(clients: Sequence[RobotClient], config: RunConfig, memories: Sequence[Memory | None] = ()) -> None:
    """Starts each robot with its own seed: the first with the run's seed, each other one with the next number.

    Raises:
        UsageError: A robot refuses its configuration.
        RobotError: A robot does not answer.
    """
    for index, client in enumerate(clients):
        profile = client.protocol.choices("COMMAND", "profile")[config.profile]
        memory = memories[index] if index < len(memories) else None
        try:
            start(client, Session((config.seed + index) % _SEED_SPAN, profile, config.told), memory)
        except RefusedError as refused:
            raise UsageError(f"{refused}; give values within the robot's range") from refused


def _check(config: RunConfig, world: World) -> None:
    if config.nodes.stop - 1 > NODE_MAX:
        last = config.nodes.stop - 1
        raise UsageError(f"{config.robots} robots from node {config.node} need node {last}; the last is {NODE_MAX}")
    for change in (Change.parse(text) for text in config.changes):
        _check_change(change, config)
    if config.robots == 1:
        return
    try:
        for number in range(1, config.environments + 1):
            world.generate(config.seed, number, config.robots)
    except NoRoomError as error:
        raise UsageError(f"{config.robots} robots are too many for seed {config.seed}: {error}") from None


def _check_change(change: Change, config: RunConfig) -> None:
    for what, number, last in (
        ("environment", change.number, config.environments),
        ("robot", change.robot, config.robots),
    ):
        if (number or 1) > last:
            raise UsageError(f"{change.what} is scheduled for {what} {number}, but the run has {last}")


def connected(stack: ExitStack, config: RunConfig, node: int, lines: BusLines, log: FrameLog) -> RobotClient:
    """Connects to a robot of a run. It is stopped and identified, but not started; the stack ends it.

    Raises:
        UsageError: The configuration is invalid.
        RobotError: The robot does not answer.
    """
    connection = connect(stack, config.bus, config.robot, node, config.board, lines, pins=config.body == PINS)
    if config.faults:
        connection = _with_faults(connection, config, node)
    external = config.robot == "external"
    # Drawn from the seed: simulators on one bus rarely share an ID, and a repeated run has the same log.
    owner = config.owner or (Random(config.seed).randint(1, _OWNER_MAX) if external else 1)
    client = RobotClient(connection, Protocol(node), log, lockstep=not config.real_time, owner=owner)
    client.punctuality.limits = Limits(config.unanswered_max, config.gap_max_s, config.late_max)
    handshake(client, _EXTERNAL_S if external else connection.deadline_s, shared=external)
    return client


def _with_faults(connection: Connection, config: RunConfig, node: int) -> Connection:
    """Adds the requested faults to a connection.

    For a robot in this process, delays are simulated on a virtual clock and cost no wall time.
    """
    # Most runs have no faults and start without loading these modules.
    from host_sim.faults.faulty_link import FaultyLink  # noqa: PLC0415 - see above
    from host_sim.faults.rule import Rule  # noqa: PLC0415 - see above
    from host_sim.faults.schedule import Schedule  # noqa: PLC0415 - see above
    from host_sim.protocol.forgery import forgers  # noqa: PLC0415 - see above

    clock = VirtualClock() if connection.answers_at_once else WallClock()
    schedule = Schedule([Rule.parse(rule) for rule in config.faults], config.fault_seed, forgers(Protocol(node)))
    return replace(connection, link=FaultyLink(connection.link, schedule, clock), now=clock.now)
