"""A study without logs: the robots of each condition are a fleet, which is several times as fast."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from host_sim.base.errors import UsageError
from host_sim.lab.study.contacts import BodyState, knows_wrong
from host_sim.lab.study.plan import Plan
from host_sim.lab.study.sample import CURVE, TRAPPED_S, Floats, Sample
from host_sim.lab.study.trial import tour_s
from host_sim.protocol.generated import AVOIDING
from host_sim.sim.fleet import FleetResult, Frozen, run_fleet
from host_sim.sim.run_config import RunConfig
from host_sim.world.geometry import SimParams
from host_sim.world.memory_kinds import Memory, sides_of


def samples_of_fleets(plan: Plan) -> list[Sample]:
    """Runs each condition as a fleet; the robots behave as in runs of their own.

    Raises:
        UsageError: A condition has several robots in a world, or changes during its runs.
    """
    if any(it.config.robots > 1 and not it.config.is_fleet for it in plan.conditions):
        raise UsageError("a fleet has no several robots in a world: make the study with tools/octet study")
    return [
        _with_tours(sample_of(it.condition, it.config, plan.first_seed, plan.seeds), it.config)
        for it in plan.conditions
    ]


def _with_tours(sample: Sample, config: RunConfig) -> Sample:
    numbers = range(1, config.environments + 1)
    seeds = range(int(sample.seeds[0]), int(sample.seeds[0]) + len(sample.seeds) * config.robots)
    alone = [replace(config, seed=seed, robots=1) for seed in seeds]
    tours = np.array([[tour_s(it, number) for number in numbers] for it in alone])
    return replace(sample, tour_s=tours.reshape(sample.robot_s.shape))


def sample_of(name: str, config: RunConfig, first_seed: int, seeds: int, memories: Sequence[Memory] = ()) -> Sample:
    """Runs robots in worlds of their own, with consecutive seeds, in this process; without tours.

    Several robots form a company: consecutive robots hear each other. The unit of the sample is then the company, not
    the seed.

    Args:
        name: The condition.
        config: The run; its seed does not matter.
        first_seed: The first seed.
        seeds: Number of seeds.
        memories: For each seed the memory of a robot that learns no more; by default robots learn.
    """
    each_company = config.robots
    config = replace(config, seed=first_seed, robots=seeds * each_company, worlds="own")
    frozen = [Frozen(seed, memory) for seed, memory in enumerate(memories, first_seed)]
    results = sorted(
        run_fleet(config, company=each_company, frozen=frozen), key=lambda result: (result.robot, result.environment)
    )
    never = np.full((seeds, CURVE), np.nan)

    def each(of: Callable[[FleetResult], Any]) -> Floats:
        return np.array([of(result) for result in results], np.float64).reshape(seeds, -1)

    def at_last(of: Callable[[FleetResult], Any]) -> Floats:
        """A value of each robot at the end of its last environment."""
        return each(of).reshape(seeds, each_company, -1)[:, :, -1]

    tick_s = SimParams().tick_s
    contacts = each(lambda it: it.contacts.number)
    return Sample(
        name=name,
        robots=each_company,
        seeds=np.arange(first_seed, first_seed + seeds),
        finished=each(lambda it: it.finished),
        robot_s=each(lambda it: it.ticks * tick_s),
        tour_s=each(lambda _: np.nan),
        trapped=each(lambda it: it.contacts.longest_ticks * tick_s > TRAPPED_S),
        bumped=each(lambda it: it.collisions > 0),
        denied=each(lambda it: it.denied > 0),
        wrong=at_last(lambda it: knows_wrong(sides_of(it.memory), BodyState())).mean(-1),
        contacts=contacts.sum(-1),
        blocked_s=each(lambda it: it.contacts.ticks * tick_s).sum(-1),
        turns=each(lambda it: sum(it.begun.get(reason, 0) for reason in AVOIDING)).sum(-1),
        cleared=(contacts - each(lambda it: it.contacts.goes_on)).sum(-1),
        known_s=np.median(at_last(lambda it: (it.known_ticks or np.inf) * tick_s), -1),
        blocked_at=never,
        wrong_at=never,
        recovery=never[:, 0],
        settled=never[:, 0],
    )
