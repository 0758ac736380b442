"""One run of a study: robots in some environments, and data about their behaviour."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache

from host_sim.client.commands import stop
from host_sim.client.frame_log import FrameLog
from host_sim.lab.study.contacts import BodyState, Contact, ContactWatch, Course
from host_sim.protocol.generated import PARAMETERS, Side
from host_sim.sim.make import make
from host_sim.sim.native_loop import BLOCK_TICKS
from host_sim.sim.run_config import RunConfig
from host_sim.sim.simulation import Simulation
from host_sim.world.memory_kinds import Memory, sides_of
from host_sim.world.reach import tour_mm
from host_sim.world.worlds import world_of

PROPER = {1: Side.LEFT, 3: Side.LEFT, 4: Side.RIGHT, 6: Side.RIGHT}
"""The turn away from the obstacle, for each pattern with an obstacle on one side only."""

_OTHER = {Side.LEFT: Side.RIGHT, Side.RIGHT: Side.LEFT}


@dataclass(frozen=True)
class Trial:
    """A run to make.

    Attributes:
        config: Configuration of the run; its robots are in this process, or on emulated boards.
        condition: Common name of all runs that differ only in the seed; empty for the name of the behaviour.
    """

    config: RunConfig
    condition: str = ""

    @property
    def key(self) -> tuple[str, int]:
        """The key that identifies a run of a study."""
        return self.condition or self.config.profile, self.config.seed

    def __str__(self) -> str:
        return self.config.command()


@dataclass
class Row:
    """One environment of a run.

    Attributes:
        number: Number of the environment, from 1.
        finished: Whether all food was eaten.
        robot_s: Robot time, s.
        tour_s: Robot time of the shortest tour through all food, s; NaN for several robots.
        contacts: Each robot's contacts.
        collisions: Number of collisions: times that a body began to touch something.
        denied: Number of times that a robot's wheels did not follow the command.
        sides: The turns for each pattern that each robot knows at the end.
        bodies: State of each robot's body.
        tick_s: Length of a tick, s.
    """

    number: int
    finished: bool
    robot_s: float
    tour_s: float
    contacts: list[list[Contact]]
    collisions: int
    denied: int
    sides: list[Memory]
    bodies: list[BodyState]
    tick_s: float


@dataclass
class Run:
    """The result of a trial.

    Attributes:
        trial: The trial.
        rows: Its environments.
        known_s: For each robot, robot time until it knew a turn for each of the patterns 1, 3, 4 and 6; None if it
            never did.
        log_sha256: SHA-256 of the log that the run would have written, in hexadecimal.
    """

    trial: Trial
    rows: list[Row]
    known_s: list[float | None]
    log_sha256: str


def run_trial(trial: Trial) -> Run:
    """Runs a trial in this process; equal trials give equal results."""
    log = FrameLog()
    known_s: list[float | None] = [None] * trial.config.robots
    try:
        with make(trial.config, log) as simulation:
            rows = list(_rows(trial, simulation, known_s))
            for client in simulation.clients:
                stop(client)
    finally:
        sha256 = log.close()
    return Run(trial, rows, known_s, sha256)


def _rows(trial: Trial, simulation: Simulation, known_s: list[float | None]) -> Iterator[Row]:
    for number in range(1, trial.config.environments + 1):
        simulation.enter(number)
        yield _run_environment(simulation, trial, number, known_s)


def _run_environment(simulation: Simulation, trial: Trial, number: int, known_s: list[float | None]) -> Row:
    watches = [ContactWatch(index) for index in range(trial.config.robots)]

    def watch(simulation: Simulation) -> None:
        for each in watches:
            each(simulation)

    simulation.watch, first_tick, denied = watch, simulation.tick, _denied(simulation)
    while not simulation.over:
        simulation.step(BLOCK_TICKS)
    episode = simulation.leave()
    for index, each in enumerate(watches):
        if known_s[index] is None:
            known_s[index] = _known_s(each.memories, first_tick, episode.tick_s)
    return Row(
        number=number,
        finished=episode.finished,
        robot_s=episode.robot_s,
        tour_s=tour_s(trial.config, number),
        contacts=[each.contacts() for each in watches],
        collisions=sum(robot.collisions for robot in episode.robots),
        denied=_denied(simulation) - denied,
        sides=[sides_of(robot.memory) for robot in episode.robots],
        bodies=[each.body for each in watches],
        tick_s=episode.tick_s,
    )


def tour_s(config: RunConfig, number: int) -> float:
    """Robot time of the shortest tour through all food of an environment, at the robot's speed, without turning, s.

    NaN where several robots share the environment, or where it cannot be computed.
    """
    length_mm = math.inf if config.robots > 1 else _tour_mm(config.world, config.seed, number)
    speed_mm_s = config.robot_settings.get("speed_mm_s", PARAMETERS["speed_mm_s"].default)
    return length_mm / speed_mm_s if math.isfinite(length_mm) else math.nan


@cache
def _tour_mm(world: str, seed: int, number: int) -> float:
    """Length of the shortest tour of an environment, mm; most conditions share environments."""
    drawn_from = world_of(world)
    return tour_mm(drawn_from.generate(seed, number), drawn_from.params)


def _denied(simulation: Simulation) -> int:
    return sum(client.faults.get("denied", 0) for client in simulation.clients)


def knows_wrong(sides: Sequence[int], body: BodyState) -> bool:
    """Whether the turn known for one of the patterns of `PROPER` leads toward the obstacle."""
    wrong = {pattern: side if body.is_reversed else _OTHER[side] for pattern, side in PROPER.items()}
    return any(sides[pattern] == side for pattern, side in wrong.items())


def _known_s(memories: Course[Memory], first_tick: int, tick_s: float) -> float | None:
    for ticks, memory in memories:
        if all(sides_of(memory)[pattern] for pattern in PROPER):
            return round((first_tick + ticks) * tick_s, 3)
    return None
