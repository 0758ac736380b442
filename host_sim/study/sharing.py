"""How soon robots know four lessons, alone and where they teach each other: `python -m host_sim.study.sharing`."""

import argparse
import math
import os
import statistics
import sys
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass

from host_sim.protocol.generated import PROFILES, Side
from host_sim.protocol.memory_kinds import sides_of
from host_sim.sim.make import make
from host_sim.sim.native_loop import BLOCK_TICKS
from host_sim.sim.run_config import RunConfig

_LESSONS = {1: Side.LEFT, 3: Side.LEFT, 4: Side.RIGHT, 6: Side.RIGHT}
_ENVIRONMENTS = 20
_LIMIT_S = 400.0
_CROWDS = ((1, 0), (4, 0), (4, 1), (8, 1), (16, 1))


@dataclass(frozen=True)
class Crowd:
    """Robots in one world.

    Attributes:
        robots: Number of robots.
        share: 1 if they teach each other, else 0.
        profile: Their profile.
        seed: Seed for the environments, and of the first robot.
    """

    robots: int
    share: int
    profile: str
    seed: int


@dataclass(frozen=True)
class Learner:
    """One robot of a crowd.

    Attributes:
        known_s: Robot time until it knew a turn for each of patterns 1, 3, 4 and 6, s; infinite if it never did.
        is_right: Whether all four were the proper ones then.
    """

    known_s: float = math.inf
    is_right: bool = False


def run_crowd(crowd: Crowd) -> list[Learner]:
    """Runs a crowd in this process until each robot knows its lessons, through 20 environments at the most."""
    settings = {"share": crowd.share}
    config = RunConfig(
        seed=crowd.seed, environments=_ENVIRONMENTS, robots=crowd.robots, profile=crowd.profile, settings=settings,
        limit_s=_LIMIT_S,
    )  # fmt: skip
    learners = [Learner()] * crowd.robots
    with make(config) as simulation:
        for number in range(1, _ENVIRONMENTS + 1):
            simulation.enter(number)
            while not simulation.over and any(math.isinf(learner.known_s) for learner in learners):
                simulation.step(BLOCK_TICKS)
                now_s = simulation.tick * simulation.params.tick_s
                learners = [
                    _examined(learner, client.memory, now_s)
                    for learner, client in zip(learners, simulation.clients, strict=True)
                ]
            if not simulation.over:
                break
            simulation.leave()
    return learners


def _examined(learner: Learner, memory: Sequence[int], now_s: float) -> Learner:
    sides = sides_of(tuple(memory))
    if not math.isinf(learner.known_s) or not all(sides[cell] for cell in _LESSONS):
        return learner
    return Learner(now_s, all(sides[cell] == side for cell, side in _LESSONS.items()))


def line(robots: int, share: int, learners: Sequence[Learner]) -> str:
    """The figures of some robots, as a line of the table."""
    times = sorted(learner.known_s for learner in learners)
    ninetieth = times[math.ceil(0.9 * len(times)) - 1]
    right = 100 * sum(learner.is_right for learner in learners) / len(learners)
    shares = "yes" if share else "no"
    return f"{robots:6}  {shares:6}  {statistics.median(times):6.0f} s  {ninetieth:7.0f} s  {right:9.1f} %"


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(prog="python -m host_sim.study.sharing", description=__doc__)
    parser.add_argument("--profile", choices=PROFILES, default="adaptive", help="(default: %(default)s)")
    parser.add_argument("--seeds", type=int, default=20, metavar="N", help="from 1 on (default: %(default)s)")
    arguments = parser.parse_args()
    sys.stdout.write(f"{arguments.profile}, {arguments.seeds} seeds: time until cells 1, 3, 4 and 6 are known\n")
    sys.stdout.write("robots  share     median  90 of 100  all proper\n")
    with ProcessPoolExecutor(os.cpu_count()) as processes:
        for robots, share in _CROWDS:
            crowds = [Crowd(robots, share, arguments.profile, seed) for seed in range(1, arguments.seeds + 1)]
            learners = [learner for crowd in processes.map(run_crowd, crowds) for learner in crowd]
            sys.stdout.write(line(robots, share, learners) + "\n")
            sys.stdout.flush()


if __name__ == "__main__":
    main()
