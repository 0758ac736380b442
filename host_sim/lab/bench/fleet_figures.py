"""Speed of fleets and of arenas of learners, in processor time unless noted."""

import os
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

import gymnasium
import numpy as np

import host_sim.lab.gymnasium_envs  # noqa: F401 - registers the environments
from host_sim.lab.bench.figure import Figure, Value, rate
from host_sim.lab.bench.lockstep_figures import on_one_processor
from host_sim.sim.fleet import run_fleet
from host_sim.sim.make import make
from host_sim.sim.native_fleet import NativeFleet
from host_sim.sim.own_brain import OWN_HEADERS, own_brain
from host_sim.sim.run_config import C_FILE, RunConfig
from host_sim.world.body_kinds import KIT, BodyKind, body_kind
from host_sim.world.geometry import SimParams
from host_sim.world.layouts import generate

_FLEET, _TICKS, _BLOCK_TICKS, _ENDLESS = 1000, 2000, 256, 10**9
_ARENAS, _STEPS, _ACTIONS = 1000, 200, 3

_TEMPLATE = os.fspath(OWN_HEADERS / "mine.c")


def fleet_figures() -> list[Figure]:
    """The rows of fleets and of the vector environment."""
    processors = len(os.sched_getaffinity(0))
    single = Value("one robot with its frames", _single_ticks_per_second)
    own = Value("fleet of 1,000, each in its own world", _fleet_ticks_per_second)
    in_c = Value("one robot with its frames, article in a C file", partial(_single_ticks_per_second, _TEMPLATE))
    fleet_in_c = Value("the same fleet, article in a C file", partial(_fleet_ticks_per_second, profile=_TEMPLATE))
    kits = Value("fleet of 1,000 with bodies of the kit", partial(_fleet_ticks_per_second, body_kind(KIT)))
    whole = Value(f"fleet of 1,000 with its worlds, processors: {processors}", _whole_fleet)
    ticks = Value("vector environment of 1,000, a tick a step", partial(_steps_per_second, 1))
    actions = Value("the same, an action a step", partial(_steps_per_second, None))
    return [
        rate(own, single, 2),
        rate(in_c, single, 0.9),
        rate(fleet_in_c, own, 0.9),
        rate(kits, own, 0.3),
        rate(whole, Value("the same on one of them", _whole_fleet_on_one), 0.95 * processors),
        rate(ticks, actions, 2, "steps/s"),
    ]


def _whole_fleet() -> float:
    """Ticks per second of wall-clock time, all robots together, from drawing their worlds to the last result."""
    began = time.perf_counter()
    done = sum(result.ticks for result in run_fleet(RunConfig(robots=_FLEET, worlds="own", environments=1)))
    return done / (time.perf_counter() - began)


def _whole_fleet_on_one() -> float:
    with on_one_processor():
        return _whole_fleet()


def _fleet_ticks_per_second(kind: BodyKind | None = None, profile: str = "article") -> float:
    """Ticks per second of all robots of a fleet together."""
    params = SimParams()
    own = own_brain(Path(profile)) if profile.endswith(C_FILE) else None
    fleet = NativeFleet(_FLEET, _FLEET, params, kind, own=own)
    for index in range(_FLEET):
        fleet.start(index, index + 1, profile, {})
        fleet.enter(index, generate(index + 1, 1, params), _ENDLESS)

    def run() -> int:
        for _ in range(_TICKS // _BLOCK_TICKS):
            fleet.run(_BLOCK_TICKS)
        return sum(map(fleet.ticks, range(_FLEET)))

    return _per_second(run)


def _single_ticks_per_second(profile: str = "article") -> float:
    """Ticks per second of one robot without a log, within its environment."""
    with make(RunConfig(environments=1, profile=profile, fast=profile.endswith(C_FILE))) as simulation:
        simulation.enter(1)

        def run() -> int:
            while not simulation.over:
                simulation.step(simulation.block_ticks)
            return simulation.episode.ticks

        return _per_second(run)


def _per_second(run: Callable[[], int]) -> float:
    began = time.process_time()
    done = run()
    return done / (time.process_time() - began)


def _steps_per_second(step_ticks: int | None) -> float:
    envs = gymnasium.make_vec(
        "octet/Arena-v0", num_envs=_ARENAS, vectorization_mode="vector_entry_point", step_ticks=step_ticks
    )
    envs.reset(seed=1)
    actions = np.random.default_rng(1).integers(_ACTIONS, size=(_STEPS, _ARENAS))
    began = time.process_time()
    for action in actions:
        envs.step(action)
    return _STEPS * _ARENAS / (time.process_time() - began)
