"""The runs of a study: robots in some environments, and data about their behaviour."""

import json
import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache, partial
from typing import TypeVar

import numpy as np

from host_sim.base.errors import OctetError
from host_sim.client.commands import stop
from host_sim.client.frame_log import FrameLog
from host_sim.lab.study.contacts import PROPER, ContactWatch, Course, digits_of, knows_wrong
from host_sim.lab.study.tables import COLUMNS, Row, Rows
from host_sim.lab.study.version import code_version
from host_sim.lab.workers import Workers
from host_sim.lab.workers import run_all as workers_run_all
from host_sim.protocol.generated import PARAMETERS
from host_sim.sim.make import make
from host_sim.sim.native_loop import BLOCK_TICKS
from host_sim.sim.run_config import RunConfig
from host_sim.sim.simulation import Simulation
from host_sim.world.memory_kinds import Memory, sides_of
from host_sim.world.reach import tour_mm
from host_sim.world.worlds import world_of


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


def run_trial(trial: Trial) -> Rows:
    """Runs a trial in this process; equal trials give equal rows."""
    log, config = FrameLog(), trial.config
    rows: Rows = {name: [] for name in COLUMNS}
    known_s = [math.inf] * config.robots
    try:
        with make(config, log) as simulation:
            for number in range(1, config.environments + 1):
                simulation.enter(number)
                environment, contacts = _run_environment(simulation, known_s)
                tour = tour_s(config, number)
                rows["environments"].append({"environment": number, "tour_s": tour, **environment})
                rows["contacts"] += [{"environment": number, **contact} for contact in contacts]
            for client in simulation.clients:
                stop(client)
    finally:
        sha256 = log.close()
    rows["runs"].append(_about(config, known_s) | {"log_sha256": sha256})
    for robot in range(config.robots):
        for number, contact in enumerate((it for it in rows["contacts"] if it["robot"] == robot), 1):
            contact["number"] = number
    condition, seed = trial.key
    return {name: [{"condition": condition, "seed": seed, **row} for row in found] for name, found in rows.items()}


def _about(config: RunConfig, known_s: list[float]) -> Row:
    return {
        **{name: getattr(config, name) for name in ("profile", "world", "body", "robots")},
        "settings": json.dumps(config.settings, sort_keys=True),
        "change": " ".join(config.changes),
        "known_s": float(np.median(known_s)),
        "code": code_version(),
        "command": config.command(),
    }


def _run_environment(simulation: Simulation, known_s: list[float]) -> tuple[Row, list[Row]]:
    """Runs to the end of an environment. Returns its row, and those of its contacts."""
    watches = [ContactWatch(index) for index in range(len(known_s))]

    def watch(simulation: Simulation) -> None:
        for each in watches:
            each(simulation)

    simulation.watch, first_tick, denied = watch, simulation.tick, _denied(simulation)
    while not simulation.over:
        simulation.step(BLOCK_TICKS)
    episode = simulation.leave()
    for index, each in enumerate(watches):
        known_s[index] = min(known_s[index], _known_s(each.memories, first_tick, episode.tick_s))
    sides, bodies = [sides_of(robot.memory) for robot in episode.robots], [each.body for each in watches]
    row = {
        "finished": episode.finished,
        "robot_s": episode.robot_s,
        "collisions": sum(robot.collisions for robot in episode.robots),
        "denied": _denied(simulation) - denied,
        "wrong": sum(map(knows_wrong, sides, bodies)),
        "changed": any(body.is_changed for body in bodies),
        "sides": " ".join(map(digits_of, sides)),
    }
    return row, [contact for each in watches for contact in each.contacts(episode.tick_s)]


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


def _known_s(memories: Course[Memory], first_tick: int, tick_s: float) -> float:
    """Robot time until a turn was known for each of the patterns of `PROPER`, s; infinite if it never was."""
    known = (ticks for ticks, memory in memories if all(sides_of(memory)[pattern] for pattern in PROPER))
    return round((first_tick + next(known, math.inf)) * tick_s, 3)


Made = TypeVar("Made")


def run_all(
    make: Callable[[Trial], Made], trials: Sequence[Trial], workers: Workers, chunk: int = 0
) -> Iterator[Sequence[Made]]:
    """Makes something of each trial in other processes, all with the same version of robot and world.

    Args:
        make: What to make of a trial, such as `run_trial`.
        trials: The trials.
        workers: The workers.
        chunk: Number of trials to hand over at once; 0 leaves it to the workers.

    Yields:
        Some results, as soon as they are made.

    Raises:
        OctetError: Workers die repeatedly, or one is of another version.
    """
    for made, code in workers_run_all(partial(_make_chunk, make), trials, workers, chunk):
        if code != code_version():
            raise OctetError("a worker has another version of robot or world; finished runs are kept")
        yield made


def _make_chunk(make: Callable[[Trial], Made], trials: Sequence[Trial]) -> tuple[list[Made], str]:
    return [make(trial) for trial in trials], code_version()
