"""The open board: how much food behaviours and learners find in a minute, in arenas that stay the same.

.venv/bin/python -m host_sim.lab.gymnasium_envs.board                    every row of docs/python.md
.venv/bin/python -m host_sim.lab.gymnasium_envs.board searcher mine.py   these: a profile, and a policy of your own

A policy is a Python file with `begin(arenas)`, which returns a function from observations, shape (arenas, 7), to
actions, shape (arenas,). Its `KEEPS` is the size of its data, such as "8 bytes"; its `ACTIONS` is the number of
actions that it was trained with.
"""

import argparse
import importlib.util
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import gymnasium
import numpy as np
from numpy.typing import NDArray

import host_sim.lab.gymnasium_envs  # noqa: F401 - names the environments
from host_sim.base.errors import OctetError, UsageError, meant
from host_sim.base.paths import ROOT
from host_sim.base.toml_file import read_toml
from host_sim.lab.gymnasium_envs import ppo, q_learning
from host_sim.lab.table import markdown
from host_sim.protocol.generated import PROFILES
from host_sim.sim.run_config import C_FILE

BOARD = ROOT / "studies" / "board.toml"
_TRAININGS = (1, 2, 3)
_Z = 1.96
_HEADINGS = "who", "food in a minute", "keeps", "actions of training"

Policy = Callable[[NDArray[np.int32]], NDArray[np.integer[Any]]]
"""From observations to actions, for all arenas at once."""


class Arenas(NamedTuple):
    """The board's arenas: the first environment of each seed."""

    first_seed: int
    seeds: int
    limit_s: float


class Row(NamedTuple):
    """One row of the board.

    Attributes:
        who: The profile, learner or policy.
        food: Pieces of food eaten in each arena.
        keeps: The data that it keeps besides its program.
        actions: Number of actions that it was trained with.
    """

    who: str
    food: NDArray[np.int64]
    keeps: str = "8 bytes"
    actions: int = 0

    def cells(self) -> tuple[str, ...]:
        """The row as text, with the 95 % interval of the mean over arenas."""
        mean, half = self.food.mean(), _Z * self.food.std() / np.sqrt(len(self.food))
        return self.who, f"{mean:.2f} ({mean - half:.2f}..{mean + half:.2f})", self.keeps, f"{self.actions:,}"


def read_board(path: Path = BOARD) -> tuple[Arenas, list[str]]:
    """The board's arenas, and the profiles on it; the file is a study's, too."""
    content = read_toml(path, "a board").content
    return Arenas(content["first_seed"], content["seeds"], float(content["limit_s"])), list(content["profiles"])


def food_of_policy(begin: Callable[[int], Policy], arenas: Arenas) -> NDArray[np.int64]:
    """Food that a policy eats in each arena."""
    env: Any = gymnasium.make_vec("octet/Arena-v0", num_envs=arenas.seeds, limit_s=arenas.limit_s)
    seeds = range(arenas.first_seed, arenas.first_seed + arenas.seeds)
    senses, info = env.reset(options={"environments": [(seed, 1) for seed in seeds]})
    full, over = info["food_left"], np.zeros(arenas.seeds, bool)
    left, act = full, begin(arenas.seeds)
    while not over.all():
        senses, _, ended, truncated, info = env.step(act(senses))
        left = np.where(over, left, info["food_left"])
        over |= ended | truncated
    return np.asarray(full - left)


def _of_file(path: Path) -> Callable[[Arenas], Row]:
    if not path.is_file():
        raise UsageError(f"there is no file {path}")
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec is not None
    assert spec.loader is not None
    module: Any = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    if not callable(getattr(module, "begin", None)):
        raise UsageError(f"{path} has no function begin(arenas)")
    about = getattr(module, "KEEPS", "not told"), getattr(module, "ACTIONS", 0)
    return lambda arenas: Row(path.stem, food_of_policy(module.begin, arenas), *about)


def _of_profile(profile: str, arenas: Arenas) -> Row:
    return Row(f"`{profile}`", q_learning.food_of(profile, *arenas))


def _of_q_table(seed: int, arenas: Arenas) -> Row:
    table = q_learning.learn(seed).table
    keeps = f"{table.size} numbers"
    policy = partial(q_learning.policy, table, seed)
    return Row(f"Q-table, seed {seed}", food_of_policy(policy, arenas), keeps, q_learning.STEPS * q_learning.ARENAS)


def _of_ppo(seed: int, arenas: Arenas) -> Row:
    trained = ppo.Training(seed).run()
    policy = partial(ppo.policy, trained.network, seed)
    return Row(f"PPO, seed {seed}", food_of_policy(policy, arenas), f"{ppo.WEIGHTS:,} weights", trained.samples)


_LEARNERS = {"q-table": _of_q_table, "ppo": _of_ppo}


def players_of(words: list[str]) -> Iterator[Callable[[Arenas], Row]]:
    """Yields the players that words name: profiles, the learners of this folder, and files with a policy.

    Raises:
        UsageError: A word names nothing.
    """
    for word in words:
        if word in PROFILES or word.endswith(C_FILE):
            yield partial(_of_profile, word)
        elif word in _LEARNERS:
            yield from (partial(_LEARNERS[word], seed) for seed in _TRAININGS)
        elif word.endswith(".py"):
            yield _of_file(Path(word))
        else:
            raise UsageError(
                f"there is no {word!r}: {meant(word, [*PROFILES, *_LEARNERS])}; or name a .py or .c file"
            )


def main(words: list[str] | None = None) -> None:
    """Prints the board."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("who", nargs="*", help=f"profiles, {', '.join(_LEARNERS)}, or files; default: the board's")
    try:
        arenas, profiles = read_board()
        players = list(players_of(parser.parse_args(words).who or [*profiles, *_LEARNERS]))
        rows = [play(arenas) for play in players]
    except OctetError as error:
        parser.error(str(error))
    rows.sort(key=lambda row: -row.food.mean())
    last = arenas.first_seed + arenas.seeds - 1
    print(f"seeds {arenas.first_seed}..{last}, the first environment of each, {arenas.limit_s:g} s\n")
    print(markdown([_HEADINGS, *(row.cells() for row in rows)]))


if __name__ == "__main__":
    main()
