"""Q-learning with a table, many arenas at a time: how soon it finds as much food as the eight bytes.

.venv/bin/python -m host_sim.lab.gymnasium_envs.q_learning --plot docs/images/q-learning.png
"""

import argparse
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
from numpy.typing import NDArray

import host_sim.lab.gymnasium_envs  # noqa: F401 - names the environments
from host_sim.base.errors import OctetError
from host_sim.base.extra_library import library
from host_sim.sim.fleet import run_fleet
from host_sim.sim.run_config import RunConfig

STEPS, ARENAS, SECONDS = 8000, 200, 60.0
_COLOURS = ("#0072B2", "#D55E00", "#009E73")
_STATES, _ACTIONS = 16, 6
_DISCOUNT, _EXPLORES, _CURVE = 0.95, 0.02, 500


@dataclass(frozen=True)
class Learned:
    """The result of a learner.

    Attributes:
        table: Shape (states, actions): value of an action. A state is the front sensors' pattern, whether food is
            seen, and the last action.
        food: Pieces of food eaten in each episode of a minute, in the order in which the episodes ended.
        steps: For each episode, the step in which it ended.
    """

    table: NDArray[np.float64]
    food: NDArray[np.int64]
    steps: NDArray[np.int64]

    def curve(self) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
        """Mean food per episode, over the episodes of every 500 steps."""
        ends = np.arange(_CURVE, self.steps[-1] + _CURVE + 1, _CURVE)
        which = self.steps // _CURVE
        return ends, np.bincount(which, self.food, len(ends)) / np.maximum(np.bincount(which, minlength=len(ends)), 1)


def learn(seed: int, steps: int = STEPS) -> Learned:
    """Learns for a number of steps in 200 arenas; equal seeds give equal results."""
    env: Any = gymnasium.make_vec("octet/Arena-v0", num_envs=ARENAS, limit_s=SECONDS)
    draws, values = np.random.default_rng(seed), np.zeros(_STATES * _ACTIONS * _ACTIONS)
    state, over, eaten = _states(env.reset(seed=seed)[0], np.zeros(ARENAS, np.int64)), np.zeros(ARENAS, bool), []
    food = np.zeros(ARENAS, np.int64)
    for step in range(steps):
        part = step / steps
        best = (values.reshape(-1, _ACTIONS)[state] + 1e-9 * draws.random((ARENAS, _ACTIONS))).argmax(-1)
        explores = draws.random(ARENAS) < max(_EXPLORES, 0.5 - 1.33 * part)
        actions = np.where(explores, draws.integers(_ACTIONS, size=ARENAS), best)
        senses, reward, ended, truncated, _ = env.step(actions)
        after, goes_on = _states(senses, actions), ~(ended | truncated)
        target = reward + _DISCOUNT * goes_on * values.reshape(-1, _ACTIONS)[after].max(-1)
        # A step after an end only begins the next episode, and teaches nothing.
        cell = (state * _ACTIONS + actions)[~over]
        times = np.bincount(cell, minlength=len(values))
        error = np.bincount(cell, (target - values[state * _ACTIONS + actions])[~over], len(values))
        values += (1 - (1 - max(0.01, 0.2 - 0.4 * part)) ** times) * error / np.maximum(times, 1)
        food += ~over & (reward > 0.5)  # noqa: PLR2004 - a piece is worth 1
        over = ~goes_on
        eaten += [(step, int(many)) for many in food[over]]
        food[over], state = 0, after
    ends, many = np.array(eaten).reshape(-1, 2).T
    return Learned(values.reshape(-1, _ACTIONS), many, ends)


def policy(table: NDArray[np.float64], seed: int, arenas: int) -> Callable[[NDArray[np.int32]], NDArray[np.int64]]:
    """The policy of a learned table for a number of arenas: the best action, or in 2 % of steps a random one."""
    draws, last = np.random.default_rng(seed), np.zeros(arenas, np.int64)

    def act(senses: NDArray[np.int32]) -> NDArray[np.int64]:
        nonlocal last
        explores = draws.random(arenas) < _EXPLORES
        last = np.where(explores, draws.integers(_ACTIONS, size=arenas), table[_states(senses, last)].argmax(-1))
        return last

    return act


def food_of(profile: str, first_seed: int = 1, robots: int = 1000, limit_s: float = SECONDS) -> NDArray[np.int64]:
    """Food that each of some firmware robots eats in its first environment, starting with an empty memory."""
    config = RunConfig(seed=first_seed, environments=1, profile=profile, robots=robots, worlds="own", limit_s=limit_s)
    return np.array([it.food_eaten for it in sorted(run_fleet(config), key=lambda it: it.robot)])


def _states(senses: NDArray[np.int32], actions: NDArray[np.int64]) -> NDArray[np.int64]:
    return (senses[:, 1] >> 1 & 7 | senses[:, 3] << 3) * _ACTIONS + actions


def _plot(path: Path, learned: list[Learned], firmware: dict[str, float]) -> None:
    figure = library("matplotlib.figure", "study").Figure((8, 4.5), layout="constrained")
    axes = figure.add_subplot(xlabel=f"steps of each of {ARENAS} arenas", ylabel="food in a minute")
    axes.set_prop_cycle(color=_COLOURS)
    axes.spines[["top", "right"]].set_visible(False)
    axes.grid(alpha=0.25)
    for seed, each in enumerate(learned, 1):
        axes.plot(*each.curve(), label=f"Q-learning, seed {seed}")
    for (profile, food), style in zip(firmware.items(), ("--", ":"), strict=True):
        axes.axhline(food, color="0.3", linestyle=style, label=f"{profile}, its first minute")
    axes.legend(frameon=False)
    figure.savefig(path, dpi=100, metadata={"Software": None})


def main() -> None:
    """Learns with three seeds, and prints the results."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--plot", type=Path, metavar="FILE", help="draw the curves into this PNG")
    arguments = parser.parse_args()
    learned = [learn(seed) for seed in (1, 2, 3)]
    firmware = {profile: float(food_of(profile).mean()) for profile in ("article", "searcher")}
    for seed, each in enumerate(learned, 1):
        _, curve = each.curve()
        first, last = curve[0], curve[-4:].mean()
        print(f"Q-learning, seed {seed}: {first:.2f} pieces of food a minute at first, {last:.2f} at last")
    for profile, food in firmware.items():
        print(f"{profile}: {food:.2f} in its first minute")
    try:
        if arguments.plot:
            _plot(arguments.plot, learned, firmware)
    except (OctetError, OSError) as error:
        parser.error(f"cannot draw {arguments.plot}: {error}")


if __name__ == "__main__":
    main()
