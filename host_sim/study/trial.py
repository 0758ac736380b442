"""One robot's run through some environments, and what it shows of the robot's behaviour."""

import random
from collections.abc import Sequence
from dataclasses import dataclass, field

from host_sim.protocol.generated import Reason
from host_sim.protocol.memory_kinds import sides_of
from host_sim.sim.make import make
from host_sim.sim.native_loop import BLOCK_TICKS
from host_sim.sim.run_config import RunConfig
from host_sim.sim.simulation import Simulation
from host_sim.study.faults import FAULTS

_AVOIDING = frozenset((Reason.REMEMBERED, Reason.TRIAL, Reason.BOREDOM))


@dataclass(frozen=True)
class Trial:
    """A run to be made.

    Attributes:
        profile: The behaviour.
        seed: Seed for environments and random turns.
        environments: Number of environments.
        settings: Parameters to change from their defaults, by name.
        fault: One of `FAULTS`.
        fault_from: The environment in which it begins, from 1.
    """

    profile: str
    seed: int
    environments: int = 5
    settings: dict[str, int] = field(default_factory=dict)
    fault: str = "none"
    fault_from: int = 1


@dataclass
class Row:
    """One environment of a trial.

    Attributes:
        profile: The behaviour.
        seed: The trial's seed.
        number: Number of the environment, from 1.
        finished: Whether all food was eaten.
        robot_s: Robot time, s.
        blocked_s: For each time that the robot was blocked, how long it took until the way was clear, s.
        collisions: Number of times that the body began to touch something.
        sides: The turn for each pattern that the robot knows in the end.
    """

    profile: str
    seed: int
    number: int
    finished: bool = False
    robot_s: float = 0.0
    blocked_s: list[float] = field(default_factory=list)
    collisions: int = 0
    sides: Sequence[int] = ()


class _BlockedTimes:
    """Measures how long the robot was blocked, tick by tick."""

    def __init__(self) -> None:
        self.ticks: list[int] = []
        self._avoiding = False

    def __call__(self, simulation: Simulation) -> None:
        loop = simulation.loop
        for reason in [simulation.drives[0].reason] if loop is None else loop.reasons(0):
            self._add(reason)

    def _add(self, reason: int) -> None:
        avoids = reason in _AVOIDING
        if avoids and not self._avoiding:
            self.ticks.append(0)
        if avoids:
            self.ticks[-1] += 1
        self._avoiding = avoids


def run_trial(trial: Trial) -> list[Row]:
    """Runs a trial in this process; equal trials give equal rows."""
    config = RunConfig(
        seed=trial.seed, environments=trial.environments, profile=trial.profile, settings=trial.settings
    )
    dice = random.Random(trial.seed)
    rows = []
    with make(config) as simulation:
        for number in range(1, trial.environments + 1):
            simulation.enter(number)
            if trial.fault != "none" and number >= trial.fault_from:
                simulation.native, simulation.loop = False, None  # the loop in C has sound bodies only
                simulation.arena.bodies[:] = [FAULTS[trial.fault](simulation.arena.body, dice)]
            rows.append(_run_environment(simulation, Row(trial.profile, trial.seed, number)))
    return rows


def _run_environment(simulation: Simulation, row: Row) -> Row:
    simulation.watch = blocked = _BlockedTimes()
    while not simulation.over:
        simulation.step(BLOCK_TICKS)
    episode = simulation.leave()
    row.finished, row.robot_s, row.collisions = episode.finished, episode.robot_s, episode.robots[0].collisions
    row.blocked_s = [round(ticks * episode.tick_s, 3) for ticks in blocked.ticks]
    row.sides = sides_of(episode.robots[0].memory)
    return row
