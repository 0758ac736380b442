"""`octet/Brain-v0`: the firmware acts, and the learner changes its memory or its parameters."""

from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import replace
from typing import Any

import gymnasium
import numpy as np
from gymnasium import error, spaces
from numpy.typing import NDArray

from host_sim.base.errors import OctetError
from host_sim.client.commands import freeze, write_cells
from host_sim.client.robot_client import RobotClient
from host_sim.lab.gymnasium_envs import rules
from host_sim.protocol.generated import CELL_COUNT, PARAMETERS, PROFILES, Reason, Side
from host_sim.sim.make import make, start_robots
from host_sim.sim.run_config import RunConfig
from host_sim.sim.simulation import Simulation
from host_sim.world.memory_kinds import sides_of

KEEP = 3
"""The action that leaves a cell as it is."""

_COUNTED = (Reason.REMEMBERED, Reason.TRIAL, Reason.BOREDOM)
_NOTHING_COUNTED = np.zeros(len(_COUNTED) + 1, np.int64)
_COUNT_MAX = 2**31 - 1
_EMPTY = (0,) * CELL_COUNT


class BrainEnv(gymnasium.Env[Any, Any]):
    """The robot with its own firmware in a random arena; a step is some seconds of robot time.

    The observation, a `Box` of int32:

    | index | meaning                                                       | min | max   | unit  |
    | ----- | ------------------------------------------------------------- | --- | ----- | ----- |
    | 0..6  | cells 1..7 of the memory: 0 nothing, 1 left, 2 right          | 0   | 2     |       |
    | 7     | food left                                                     | 0   | 3     |       |
    | 8     | remembered turns that began in the last step                  | 0   | 2^31-1 |      |
    | 9     | trials that began in it                                       | 0   | 2^31-1 |      |
    | 10    | about-faces in boredom that began in it                       | 0   | 2^31-1 |      |
    | 11    | times that the body began to touch something in it            | 0   | 2^31-1 |      |

    The action, with `acts_on="memory"`, is a `MultiDiscrete` of seven numbers for the cells 1..7: 0 nothing, 1 left,
    2 right, 3 leave it as it is. With `acts_on="parameters"` it has a value for each of the `parameters`, within that
    parameter's range. It takes effect before the step.

    The reward is as in `ArenaEnv`, and so are the end of an episode, its `info`, and the options of `reset`. Each
    episode begins with an empty memory.

    >>> from host_sim.lab.gymnasium_envs.brain_env import BrainEnv
    >>> env = BrainEnv(step_s=5.0)
    >>> observation, info = env.reset(seed=1)
    >>> observation, *_ = env.step([1, 1, 1, 2, 2, 2, 1])
    >>> observation[:7].tolist()
    [1, 1, 1, 2, 2, 2, 1]
    >>> env.close()
    """

    metadata = {"render_modes": []}  # noqa: RUF012 - as Gymnasium has it

    def __init__(  # noqa: PLR0913 - the keywords of gymnasium.make
        self,
        *,
        acts_on: str = "memory",
        parameters: tuple[str, ...] = ("turn_deg", "boredom_limit"),
        step_s: float = 10.0,
        limit_s: float = 600.0,
        profile: str = "article",
        learns: bool = True,
        rewards: rules.Rewards | None = None,
    ) -> None:
        """Starts the robot.

        Args:
            acts_on: memory or parameters.
            parameters: The parameters that an action sets.
            step_s: Length of a step, s of robot time.
            limit_s: Time limit of an episode, s of robot time.
            profile: Name of the robot's behaviour.
            learns: Whether the robot learns by itself, too.
            rewards: Rewards of a step.

        Raises:
            gymnasium.error.Error: An argument is invalid.
            gymnasium.error.DependencyNotInstalled: The firmware is not built.
        """
        self._rewards = rewards or rules.Rewards()
        for seconds in (step_s, limit_s):
            rules.check_seconds(seconds)
        if profile not in PROFILES:
            raise error.Error(f"{profile!r} is not a profile: give one of {', '.join(PROFILES)}")
        self._hand = _hand(acts_on, parameters)
        self.action_space, self.observation_space = self._hand.space, _observation_space()
        self._learns, self._step_ticks = learns, round(step_s / rules.PARAMS.tick_s)
        self._config = RunConfig(environments=1, limit_s=limit_s, profile=profile)
        self._stack = ExitStack()
        try:
            self._simulation = self._stack.enter_context(make(self._config))
        except OctetError as fault:
            raise error.DependencyNotInstalled(str(fault)) from None
        self._counts: NDArray[np.int64] = _NOTHING_COUNTED
        self._runs = False

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[NDArray[np.int32], dict[str, Any]]:
        """Begins an episode.

        Raises:
            gymnasium.error.Error: Seed or options are invalid.
        """
        super().reset(seed=seed)
        run_seed, number = rules.chosen_environment(options) or (int(self.np_random.integers(rules.SEED_SPAN)), 1)
        simulation = self._simulation
        simulation.record.begun.clear()
        simulation.clients[0].dialogue.commands.clear()
        start_robots(simulation.clients, replace(self._config, seed=run_seed), [_EMPTY])
        freeze(simulation.clients[0], not self._learns)
        simulation.seed = run_seed
        simulation.enter(number)
        self._counts, self._runs = _NOTHING_COUNTED, True
        return self._observation(_NOTHING_COUNTED), self._info()

    def step(self, action: NDArray[np.int64]) -> tuple[NDArray[np.int32], float, bool, bool, dict[str, Any]]:
        """Applies the action, and lets the robot run.

        Raises:
            gymnasium.error.ResetNeeded: No episode has begun, or the last one has ended.
            gymnasium.error.InvalidAction: The action is not in the action space.
        """
        if not self._runs:
            raise error.ResetNeeded("no episode has begun, or it has ended: call reset")
        simulation, before = self._simulation, self._simulation.arena.food.left
        self._hand.act(simulation.clients[0], rules.checked_numbers(action, self._hand.space))
        ticks = self._run()
        counts = _counts_of(simulation)
        news = counts - self._counts
        self._counts = counts
        left = simulation.arena.food.left
        reward = float(self._rewards.of(before - left, ticks, int(news[-1])))
        self._runs = not simulation.over
        return self._observation(news), reward, left == 0, simulation.over and left > 0, self._info()

    def close(self) -> None:
        """Ends the robot; closing it again does nothing."""
        self._runs = False
        self._stack.close()

    def _run(self) -> int:
        """Runs one step; returns its number of ticks."""
        simulation, first = self._simulation, self._simulation.tick
        while not simulation.over and (ticks := simulation.tick - first) < self._step_ticks:
            simulation.step(min(simulation.block_ticks, self._step_ticks - ticks))
        return simulation.tick - first

    def _observation(self, news: NDArray[np.int64]) -> NDArray[np.int32]:
        sides = sides_of(self._simulation.clients[0].memory)[1:]
        left = self._simulation.arena.food.left
        return np.array([*sides, left, *news], np.int32)

    def _info(self) -> dict[str, Any]:
        return {
            "robot_s": self._simulation.episode.robot_s,
            "food_left": self._simulation.arena.food.left,
        }


class _MemoryHand:
    """Writes cells."""

    def __init__(self) -> None:
        self.space = spaces.MultiDiscrete([KEEP + 1] * (CELL_COUNT - 1))

    def act(self, client: RobotClient, numbers: NDArray[np.int64]) -> None:
        sides = {cell: int(side) for cell, side in enumerate(numbers, 1) if side != KEEP}
        now = sides_of(client.memory)
        if any(now[cell] != side for cell, side in sides.items()):
            write_cells(client, sides)


class _ParameterHand:
    """Sets parameters."""

    def __init__(self, names: Sequence[str]) -> None:
        self._numbers = [PARAMETERS[name].number for name in names]
        low = [PARAMETERS[name].minimum for name in names]
        high = [PARAMETERS[name].maximum for name in names]
        self.space = spaces.MultiDiscrete(np.subtract(high, low) + 1, start=low)

    def act(self, client: RobotClient, numbers: NDArray[np.int64]) -> None:
        for parameter, value in zip(self._numbers, numbers.tolist(), strict=True):
            client.dialogue.command("set", parameter=parameter, value=value)


def _hand(acts_on: str, parameters: Sequence[str]) -> _MemoryHand | _ParameterHand:
    if acts_on == "memory":
        return _MemoryHand()
    if acts_on != "parameters":
        raise error.Error(f"acts_on is {acts_on!r}: give 'memory' or 'parameters'")
    if isinstance(parameters, str) or not parameters or not set(parameters) <= PARAMETERS.keys():
        raise error.Error(f"parameters are {parameters!r}: give some of {', '.join(PARAMETERS)}")
    return _ParameterHand(parameters)


def _observation_space() -> spaces.Box:
    cells, counts = [max(Side)] * (CELL_COUNT - 1), [_COUNT_MAX] * len(_NOTHING_COUNTED)
    high = np.array([*cells, len(rules.PARAMS.food_bands_mm), *counts], np.int32)
    return spaces.Box(np.zeros_like(high), high, dtype=np.int32)


def _counts_of(simulation: Simulation) -> NDArray[np.int64]:
    """Counts in this environment so far: actions begun by reason, and collisions."""
    begun = simulation.episode.robots[0].begun
    return np.array([*(begun.get(reason, 0) for reason in _COUNTED), simulation.arena.body.collisions])
