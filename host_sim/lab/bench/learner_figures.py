"""The speed of the arenas that learners step. Processor time, for one processor."""

import time

import gymnasium
import numpy as np

import host_sim.lab.gymnasium_envs  # noqa: F401 - registers the environments
from host_sim.lab.bench.figure import Figure, Rate, best, rate_figure

_ARENAS, _STEPS, _DEEDS = 1000, 200, 3


def vector_figure() -> Figure:
    """Steps per second of a thousand arenas in all, each a control tick with the senses of the wire."""
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
