"""One run of a study: robots in some environments, and what it shows of their behaviour."""

import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from host_sim.client.commands import stop
from host_sim.client.frame_log import FrameLog
from host_sim.protocol.generated import Side
from host_sim.protocol.memory_kinds import Memory, sides_of
from host_sim.sim.make import make
from host_sim.sim.native_loop import BLOCK_TICKS
from host_sim.sim.run_config import RunConfig
from host_sim.sim.simulation import Simulation
from host_sim.study.contacts import Contact, ContactWatch
from host_sim.study.faults import FAULTS, OTHER_WAY_ROUND, change_of
from host_sim.world.world_names import RANDOM

PROPER = {1: Side.LEFT, 3: Side.LEFT, 4: Side.RIGHT, 6: Side.RIGHT}
"""The turn away from what is beside the robot, for each pattern in which something is on one side only."""


@dataclass(frozen=True)
class Trial:
    """A run to be made.

    Attributes:
        profile: The behaviour.
        seed: Seed for environments and random turns.
        environments: Number of environments.
        settings: Parameters to change from their defaults, by name.
        world: Name of the world that the environments are drawn from.
        change: What happens to the body, as `host_sim.study.faults` has it; empty for nothing.
        limit_s: Time limit for each environment, s of robot time.
        robots: Number of robots in each environment.
        condition: What the run's condition is called: all runs that differ only in the seed have the same.
    """

    profile: str
    seed: int
    environments: int = 5
    settings: dict[str, int] = field(default_factory=dict)
    world: str = RANDOM
    change: str = ""
    limit_s: float = 600.0
    robots: int = 1
    condition: str = ""

    @property
    def key(self) -> tuple[str, int]:
        """What tells the runs of a study apart."""
        return self.condition or self.profile, self.seed

    def is_changed(self, environment: int) -> bool:
        """Whether the change is in force in an environment."""
        return bool(self.change) and environment >= change_of(self.change).environment

    def proper(self, environment: int) -> dict[int, Side]:
        """The turn for each of the patterns of `PROPER` that leads away, as the robot has to ask for it."""
        if self.is_changed(environment) and change_of(self.change).fault in OTHER_WAY_ROUND:
            return {pattern: Side(Side.LEFT + Side.RIGHT - side) for pattern, side in PROPER.items()}
        return PROPER

    def command(self) -> str:
        """A command that repeats the run."""
        sets = "".join(f" --set {name}={value}" for name, value in sorted(self.settings.items()))
        return (
            f"tools/run --bus none --seed {self.seed} --profile {self.profile} --environments {self.environments}"
            f" --limit-s {self.limit_s:g} --robots {self.robots} --world {self.world}{sets}"
        )


@dataclass
class Row:
    """One environment of a run.

    Attributes:
        number: Number of the environment, from 1.
        finished: Whether all food was eaten.
        robot_s: Robot time, s.
        contacts: Each robot's contacts.
        collisions: Number of times that a body began to touch something.
        sides: The turns for each pattern that each robot knows in the end.
        wrong: Number of robots that know a wrong turn for pattern 1, 3, 4 or 6 in the end.
        is_changed: Whether the change was in force.
        tick_s: Length of a tick, s.
    """

    number: int
    finished: bool
    robot_s: float
    contacts: list[list[Contact]]
    collisions: int
    sides: list[Memory]
    wrong: int
    is_changed: bool
    tick_s: float


@dataclass
class Run:
    """What came of a trial.

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
    known_s: list[float | None] = [None] * trial.robots
    try:
        with make(_config(trial), log) as simulation:
            rows = list(_rows(trial, simulation, known_s))
            for client in simulation.clients:
                stop(client)
    finally:
        sha256 = log.close()
    return Run(trial, rows, known_s, sha256)


def _config(trial: Trial) -> RunConfig:
    names = ("seed", "environments", "profile", "settings", "world", "limit_s", "robots")
    return RunConfig(**{name: getattr(trial, name) for name in names})


def _rows(trial: Trial, simulation: Simulation, known_s: list[float | None]) -> Iterator[Row]:
    dice = random.Random(trial.seed)
    for number in range(1, trial.environments + 1):
        simulation.enter(number)
        if trial.is_changed(number):
            simulation.native, simulation.loop = False, None  # the loop in C has sound bodies only
            bodies = simulation.arena.bodies
            bodies[:] = [FAULTS[change_of(trial.change).fault](body, dice) for body in bodies]
        yield _run_environment(simulation, trial, number, known_s)


def _run_environment(simulation: Simulation, trial: Trial, number: int, known_s: list[float | None]) -> Row:
    watches = [ContactWatch(index) for index in range(trial.robots)]

    def watch(simulation: Simulation) -> None:
        for each in watches:
            each(simulation)

    simulation.watch, first_tick = watch, simulation.tick
    while not simulation.over:
        simulation.step(BLOCK_TICKS)
    episode = simulation.leave()
    for index, each in enumerate(watches):
        if known_s[index] is None:
            known_s[index] = _known_s(each.memories(), first_tick, episode.tick_s)
    sides = [sides_of(robot.memory) for robot in episode.robots]
    proper = trial.proper(number)
    return Row(
        number=number,
        finished=episode.finished,
        robot_s=episode.robot_s,
        contacts=[each.contacts() for each in watches],
        collisions=sum(robot.collisions for robot in episode.robots),
        sides=sides,
        wrong=sum(knows_wrong(known, proper) for known in sides),
        is_changed=trial.is_changed(number),
        tick_s=episode.tick_s,
    )


def knows_wrong(sides: Sequence[int], proper: dict[int, Side]) -> bool:
    """Whether a turn is known that leads toward what is beside the robot."""
    return any(sides[pattern] not in (Side.NOTHING, side) for pattern, side in proper.items())


def _known_s(memories: Sequence[tuple[int, Memory]], first_tick: int, tick_s: float) -> float | None:
    for ticks, memory in memories:
        if all(sides_of(memory)[pattern] for pattern in PROPER):
            return round((first_tick + ticks) * tick_s, 3)
    return None
