"""`python -m tests.sim.native_equality [TICKS]`: compares the tick loop in C with the one in Python, with pymunk.

It compares the logs, trajectories and results of runs in which people intervene, by default for ten million ticks.
"""

import random
import sys
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import replace
from itertools import count
from typing import NamedTuple

from host_sim.client.commands import erase_memory, stop, write_cells
from host_sim.client.frame_log import FrameLog
from host_sim.protocol.generated import PROFILES
from host_sim.recording.run_recorder import RunRecorder
from host_sim.recording.trajectory import Trajectory
from host_sim.sim.make import make
from host_sim.sim.native_loop import BLOCK_TICKS
from host_sim.sim.run_config import RunConfig
from host_sim.sim.simulation import Simulation
from host_sim.sim.world_record import EpisodeResult
from host_sim.world.edits import Edit, EditError
from host_sim.world.geometry import Bar, Point
from host_sim.world.names import PYMUNK

_ENVIRONMENTS, _LIMIT_S = 2, 300.0
_ROBOTS_MAX = 3
_CHANGE_EVERY_TICKS = 400
_BODY_FAULTS = (
    *("mirror", "swap-motors", "stuck-on:front", "stuck-off:left", "noise:50/1000", "weak-motor:right:70%"),
    *("swap-odometers", "odometer:left:0%", "odometer:right:-100%", "odometer:left:133%", "false-beacon:100"),
    *("repair", "repair", "repair"),
)


class LoopVerdict(NamedTuple):
    """The comparison of one run.

    Attributes:
        seed: The run's seed.
        ticks: Number of ticks, all robots together.
        difference: The difference in words; None if there is none.
    """

    seed: int
    ticks: int
    difference: str | None


class _Outcome(NamedTuple):
    log: str
    results: list[EpisodeResult]
    trajectory: Trajectory


def compare_loops(ticks: int) -> Iterator[LoopVerdict]:
    """Compares runs of every behaviour with one robot or several, until they have this many ticks in all.

    Yields:
        A verdict for each run.

    Raises:
        RobotError: A robot does not answer.
    """
    done, profiles = 0, sorted(PROFILES)
    for seed in count(1):
        if done >= ticks:
            return
        config = RunConfig(
            seed=seed,
            environments=_ENVIRONMENTS,
            limit_s=_LIMIT_S,
            robots=1 + seed % _ROBOTS_MAX,
            profile=profiles[seed % len(profiles)],
        )
        readable = _run(replace(config, physics=PYMUNK), native=False)
        pairs = zip(_Outcome._fields, readable, _run(config, native=True), strict=True)
        differences = [name for name, a, b in pairs if a != b]
        run_ticks = config.robots * readable.trajectory.ticks
        done += run_ticks
        yield LoopVerdict(seed, run_ticks, ", ".join(differences) or None)


def _run(config: RunConfig, native: bool) -> _Outcome:
    log, draws, results = FrameLog(), random.Random(config.seed), []
    with make(config, log) as simulation:
        simulation.native = native
        recorder = RunRecorder.of(simulation, config.boredom_limit)
        for number in range(1, config.environments + 1):
            simulation.enter(number)
            while not simulation.over:
                _meddle(simulation, draws)
                _run_on(simulation, simulation.tick + draws.randint(1, _CHANGE_EVERY_TICKS))
            results.append(simulation.leave())
        for client in simulation.clients:
            stop(client)
    return _Outcome(log.close(), results, recorder.trajectory)


def _run_on(simulation: Simulation, tick: int) -> None:
    while not simulation.over and simulation.tick < tick:
        simulation.step(min(BLOCK_TICKS, tick - simulation.tick))


def _meddle(simulation: Simulation, draws: random.Random) -> None:
    """Intervenes at random, as a person may between two ticks; impossible edits are skipped."""
    client = simulation.clients[draws.randrange(len(simulation.clients))]
    simulation.set_clock()
    if draws.random() < 0.1:
        erase_memory(client)
    elif draws.random() < 0.1:
        write_cells(client, {draws.randint(1, 7): draws.randint(0, 2)})
    with suppress(EditError):
        simulation.edit(_EDITS[draws.randrange(len(_EDITS))](simulation, draws))


def _point(simulation: Simulation, draws: random.Random) -> Point:
    return draws.uniform(0.0, simulation.params.width_mm), draws.uniform(0.0, simulation.params.height_mm)


def _bar(simulation: Simulation, draws: random.Random) -> Bar:
    a = _point(simulation, draws)
    return Bar(a, (min(simulation.params.width_mm, a[0] + draws.uniform(50.0, 400.0)), a[1]))


def _bar_id(simulation: Simulation, draws: random.Random) -> int:
    return draws.choice(list(simulation.arena.obstacles.bars) or [0])


_EDITS: list[Callable[[Simulation, random.Random], Edit]] = [
    lambda simulation, draws: Edit("add_bar", **_bar(simulation, draws)._asdict()),
    lambda simulation, draws: Edit("move_bar", _bar_id(simulation, draws), **_bar(simulation, draws)._asdict()),
    lambda simulation, draws: Edit("remove_bar", _bar_id(simulation, draws)),
    lambda simulation, draws: Edit(
        "move_food", draws.randrange(len(simulation.arena.food.at)), at=_point(simulation, draws)
    ),
    lambda simulation, draws: Edit("plant", at=_point(simulation, draws), radius=draws.randint(20, 200)),
    lambda _, draws: Edit("grow_plant", 0, radius=draws.randint(20, 200)),
    lambda simulation, draws: Edit(
        "body", what=draws.choice(_BODY_FAULTS), robot=draws.randrange(len(simulation.clients)), seed=simulation.seed
    ),
    lambda simulation, draws: Edit("lift", robot=draws.randrange(len(simulation.clients))),
    *[
        lambda simulation, draws: Edit(
            "put",
            at=_point(simulation, draws),
            heading=1000 * draws.uniform(-3.0, 3.0),
            robot=draws.randrange(len(simulation.clients)),
        )
    ]
    * 3,
]


def main() -> int:
    """Prints each verdict; returns 0 if all runs are equal, else 1."""
    code = 0
    for seed, ticks, difference in compare_loops(int(sys.argv[1]) if sys.argv[1:] else 10_000_000):
        sys.stdout.write(f"seed {seed}, {ticks} ticks: {difference or 'equal'}\n")
        code = code or int(difference is not None)
    return code


if __name__ == "__main__":
    sys.exit(main())
