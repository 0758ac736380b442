"""Common rules of all arenas: senses, actions, rewards, and the checks of actions."""

import operator
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

import numpy as np
from gymnasium import error, spaces
from numpy.typing import NDArray

from host_sim.base.errors import OctetError, UsageError
from host_sim.lab.gymnasium_envs.driven_worlds import DrivenWorlds, action_count
from host_sim.protocol.generated import FEEL, NODE_MAX
from host_sim.world.body_kinds import body_kind
from host_sim.world.geometry import SimParams
from host_sim.world.layouts import Layout, NoRoomError, generate

PARAMS = SimParams()
"""The dimensions of the arenas."""

SECONDS_MAX = 36_000.0
SEED_SPAN = 2**32
NUMBER_MAX = 1_000_000
STEP_TICKS_MAX = 1_000_000
_HIGHEST = (255, sum(FEEL.values()), 1, 1, 8191, 4095, 4095)
_DRAWS = 100


@dataclass(frozen=True)
class Rewards:
    """The rewards of a step.

    Attributes:
        food: Reward per piece of food eaten.
        second: Reward per second of robot time.
        bump: Reward per collision: each time that the robot began to touch something.
    """

    food: float = 1.0
    second: float = -0.01
    bump: float = -0.1

    def of_step(self, worlds: DrivenWorlds, actions: NDArray[np.uint8]) -> NDArray[np.float64]:
        """Carries out the robots' actions, and returns their rewards: shape (worlds, robots)."""
        before = worlds.ticks.astype(np.int64)
        worlds.step(actions)
        seconds = PARAMS.tick_s * (worlds.ticks - before)[:, np.newaxis]
        return np.asarray(self.food * worlds.food_eaten + self.second * seconds + self.bump * worlds.collisions)


def senses_space() -> spaces.Box:
    """The space of a robot's senses, as `ArenaEnv` documents them."""
    return spaces.Box(np.zeros(len(_HIGHEST), np.int32), np.array(_HIGHEST, np.int32), dtype=np.int32)


def action_space() -> spaces.Discrete:
    """The space of a robot's actions, as `ArenaEnv` documents them."""
    return spaces.Discrete(action_count())


def driven_worlds(worlds: int, robots: int, limit_s: float, step_ticks: int | None, body: str) -> DrivenWorlds:
    """Creates worlds with a number of robots in each, from the arguments of an environment.

    Raises:
        error.Error: A number is out of its range, or there is no such body.
        error.DependencyNotInstalled: The C code cannot be used.
    """
    if not 1 <= robots <= NODE_MAX:
        raise error.Error(f"{robots} robots do not fit: give 1 to {NODE_MAX}")
    if not PARAMS.tick_s <= limit_s <= SECONDS_MAX:
        raise error.Error(f"{limit_s} s is not a possible length: give {PARAMS.tick_s} to {SECONDS_MAX:.0f} s")
    if step_ticks is not None and not 1 <= step_ticks <= STEP_TICKS_MAX:
        raise error.Error(f"step_ticks is {step_ticks}: give 1 to {STEP_TICKS_MAX}, or None")
    try:
        limit_ticks = round(limit_s / PARAMS.tick_s)
        return DrivenWorlds(worlds, robots, limit_ticks, step_ticks or STEP_TICKS_MAX, body_kind(body))
    except UsageError as fault:
        raise error.Error(str(fault)) from None
    except OctetError as fault:
        raise error.DependencyNotInstalled(str(fault)) from None


def check_open(closed: bool) -> None:
    """Raises error.ClosedEnvironmentError if an environment was closed."""
    if closed:
        raise error.ClosedEnvironmentError("the environment was closed: make a new one")


def draw_environment(draws: np.random.Generator, robots: int) -> tuple[Layout, int]:
    """Draws an environment with room for the robots. Returns it and the seed used for it and the bodies.

    Raises:
        error.Error: None of many environments has room for the robots.
    """
    for _ in range(_DRAWS):
        with suppress(NoRoomError):
            seed = int(draws.integers(SEED_SPAN))
            return generate(seed, 1, PARAMS, robots), seed
    raise error.Error(f"{robots} robots are too many: none of {_DRAWS} random arenas has room for them")


def chosen_layout(options: dict[str, Any] | None, robots: int) -> tuple[Layout, int] | None:
    """The environment in the options of `reset`, `{"environment": (seed, number)}`, and its seed; None if not given.

    Raises:
        error.Error: The option is not a seed and a number, or that environment has no room for the robots.
    """
    if not options or "environment" not in options:
        return None
    try:
        seed, number = map(operator.index, options["environment"])
    except (TypeError, ValueError):
        seed = number = -1
    if not 0 <= seed < SEED_SPAN or not 1 <= number <= NUMBER_MAX:
        given = f"environment is {options['environment']!r}"
        raise error.Error(f"{given}: give a seed 0..{SEED_SPAN - 1} and a number 1..{NUMBER_MAX}")
    try:
        return generate(seed, number, PARAMS, robots), seed
    except NoRoomError as fault:
        raise error.Error(f"{robots} robots are too many: {fault}") from None


def chosen_layouts(options: dict[str, Any] | None, arenas: int) -> Sequence[tuple[Layout, int] | None]:
    """What `chosen_layout` returns, for each of several arenas: `{"environments": [(seed, number), ...]}`.

    Raises:
        error.Error: There are no such environments, or not as many as arenas.
    """
    if not options or "environments" not in options:
        return [chosen_layout(options, 1)] * arenas
    each = options["environments"]
    if not isinstance(each, Sequence) or len(each) != arenas:
        raise error.Error(f"environments is {each!r}: give a list of {arenas}, a seed and a number each")
    return [chosen_layout({"environment": one}, 1) for one in each]


def checked_actions(actions: Any, shape: tuple[int, ...]) -> NDArray[np.uint8]:
    """Checks the actions of all robots.

    Raises:
        error.InvalidAction: They are not integers from 0 to 5 in this shape.
    """
    try:
        given = np.asarray(actions)
    except (ValueError, OverflowError):
        given = np.asarray(None)
    if given.shape != shape or given.dtype.kind not in "iu" or not np.all((given >= 0) & (given < action_count())):
        needed = f"whole numbers 0..{action_count() - 1} of shape {shape}"
        raise error.InvalidAction(f"{actions!r} is not an action: give {needed}")
    return given.astype(np.uint8)
