"""Speed of fleets, arenas of learners, worlds without a log, and layouts, in processor time unless noted."""

import os
import time
from collections.abc import Callable
from itertools import count

import gymnasium
import numpy as np

import host_sim.lab.gymnasium_envs  # noqa: F401 - registers the environments
from host_sim.lab.bench.figure import ROUNDS, Figure, Rate, best, rate_figure
from host_sim.lab.bench.lockstep_figures import on_one_processor
from host_sim.sim.fleet import run_fleet
from host_sim.sim.make import make
from host_sim.sim.native_fleet import NativeFleet
from host_sim.sim.run_config import RunConfig
from host_sim.world.body_kinds import KIT, BodyKind, body_kind
from host_sim.world.hall import hall_of
from host_sim.world.layouts import Layout, generate
from host_sim.world.params import SimParams
from host_sim.world.worlds import world_of

_FLEET, _TICKS, _BLOCK_TICKS, _ENDLESS = 1000, 2000, 256, 10**9
_LAYOUTS, _DRAWN_MIN = 40, 4000


def fleet_figures() -> list[Figure]:
    """All figures. Quantities that are compared are measured in turn."""
    params = SimParams()
    alone = [generate(seed, 1, params) for seed in range(1, _FLEET + 1)]
    together, hall = hall_of(world_of("random"), 1, 1, _FLEET)
    rounds = [
        (
            robot_ticks_per_second(alone, params),
            robot_ticks_per_second([together], hall),
            robot_ticks_per_second(alone, params, body_kind(KIT)),
            _ticks_without_log(),
            _layouts(params),
        )
        for _ in range(ROUNDS)
    ]
    own, one, kits, single, drawn = (max(column) for column in zip(*rounds, strict=True))
    reference = "one robot with its frames"
    return [
        rate_figure(
            Rate("fleet of 1,000, each in its own world", own, 4_000_000), Rate(reference, single), "trigonometry"
        ),
        rate_figure(
            Rate("fleet of 1,000, all in one hall", one, 1_000_000), Rate(reference, single), "who is near whom"
        ),
        rate_figure(
            Rate("fleet of 1,000 with bodies of the kit", kits, 1_000_000),
            Rate("the same with ideal bodies", own),
            "the wheels' controllers, as on a board",
        ),
        rate_figure(
            Rate("in process, without a log", single, 1_000_000),
            Rate("a fleet's robots", own),
            "the wire's checksums; drawing the next layout is not counted",
        ),
        _processors_figure(),
        Figure(
            "layouts drawn and checked",
            round(drawn),
            "layouts/s",
            f">= {_DRAWN_MIN}",
            drawn >= _DRAWN_MIN,
            "the walk over the grid",
        ),
    ]


def _processors_figure() -> Figure:
    """The same fleet on all processors and on one in turn, from drawing its worlds to its last result."""
    processors = len(os.sched_getaffinity(0))
    all_of_them, one = [], []
    for _ in range(ROUNDS):
        all_of_them.append(_whole_fleet())
        with on_one_processor():
            one.append(_whole_fleet())
    return rate_figure(
        Rate(f"fleet of 1,000 with its worlds, processors: {processors}", max(all_of_them)),
        Rate("the same on one of them", max(one), 0.95 * processors),
        "handing results to Python, on one",
    )


def _whole_fleet() -> float:
    """Ticks per second of wall-clock time, all robots together."""
    began = time.perf_counter()
    done = sum(result.ticks for result in run_fleet(RunConfig(robots=_FLEET, worlds="own", environments=1)))
    return done / (time.perf_counter() - began)


def robot_ticks_per_second(layouts: list[Layout], params: SimParams, kind: BodyKind | None = None) -> float:
    """Ticks per second of all robots of a fleet together, with one world for each layout."""
    robots = sum(len(layout.starts) for layout in layouts)
    fleet = NativeFleet(robots, len(layouts), params, kind)
    for index in range(robots):
        fleet.start(index, index + 1, "article", {})
    for world, layout in enumerate(layouts):
        fleet.enter(world, layout, _ENDLESS)

    def run() -> int:
        for _ in range(_TICKS // _BLOCK_TICKS):
            fleet.run(_BLOCK_TICKS)
        return sum(map(fleet.ticks, range(robots)))

    return _per_second(run)


def _ticks_without_log() -> float:
    """Ticks per second of one robot within its environment."""
    with make(RunConfig(environments=1)) as simulation:
        simulation.enter(1)

        def run() -> int:
            while not simulation.over:
                simulation.step(simulation.block_ticks)
            return simulation.episode.ticks

        return _per_second(run)


def _layouts(params: SimParams) -> float:
    seeds = count(1)
    return _per_second(lambda: len([generate(next(seeds), 1, params) for _ in range(_LAYOUTS)]))


def _per_second(run: Callable[[], int]) -> float:
    began = time.process_time()
    done = run()
    return done / (time.process_time() - began)


_ARENAS, _STEPS, _DEEDS = 1000, 200, 3


def vector_figure() -> Figure:
    """Total steps per second of a thousand arenas; each step is a control tick with the senses as on the wire."""
    return rate_figure(
        Rate("vector environment of 1,000, a tick a step", best(lambda: _steps_per_second(1)), 1_000_000),
        Rate("the same, an action a step", best(lambda: _steps_per_second(None))),
        "the worlds in C",
    )


def _steps_per_second(step_ticks: int | None) -> float:
    envs = gymnasium.make_vec(
        "octet/Arena-v0", num_envs=_ARENAS, vectorization_mode="vector_entry_point", step_ticks=step_ticks
    )
    envs.reset(seed=1)
    actions = np.random.default_rng(1).integers(_DEEDS, size=(_STEPS, _ARENAS))
    began = time.process_time()
    for action in actions:
        envs.step(action)
    return _STEPS * _ARENAS / (time.process_time() - began)
