"""`octet/Arena-v0` many times at once, for `gymnasium.make_vec`."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from gymnasium import error
from gymnasium.utils import seeding
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from host_sim.lab.gymnasium_envs import rendering, rules

_Batch = tuple[NDArray[np.int32], dict[str, Any]]
_Stepped = tuple[NDArray[np.int32], NDArray[np.float64], NDArray[np.bool_], NDArray[np.bool_], dict[str, Any]]


class ArenaVectorEnv(VectorEnv[NDArray[np.int32], NDArray[np.int64], NDArray[np.generic]]):
    """Many arenas, each with one robot, stepped by one call of C code; all else is as in `ArenaEnv`.

    An arena whose episode has ended begins the next one in the step after that, whatever its action then
    (`AutoresetMode.NEXT_STEP`). Arena i of `reset(seed=s)` does what `ArenaEnv` does after `reset(seed=s + i)`.
    """

    metadata = {  # noqa: RUF012 - as Gymnasium has it
        "autoreset_mode": AutoresetMode.NEXT_STEP,
        "render_modes": [*rendering.MODES],
        "render_fps": rendering.FPS,
    }

    def __init__(  # noqa: PLR0913 - each is given by name
        self,
        num_envs: int = 1,
        limit_s: float = 600.0,
        step_ticks: int | None = None,
        rewards: rules.Rewards | None = None,
        body: str = "ideal",
        *,
        render_mode: str | None = None,
    ) -> None:
        """Creates `num_envs` arenas; the other arguments are those of `ArenaEnv`.

        Raises:
            gymnasium.error.Error: A number is out of its range.
            gymnasium.error.DependencyNotInstalled: The C code cannot be used.
        """
        if num_envs < 1:
            raise error.Error(f"num_envs is {num_envs}: give 1 or more")
        self.num_envs = num_envs
        self._rewards = rewards or rules.Rewards()
        self._worlds = rules.driven_worlds(num_envs, 1, limit_s, step_ticks, body)
        self.single_observation_space, self.single_action_space = rules.senses_space(), rules.action_space()
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self._view, self.render_mode = rendering.View(render_mode, self._worlds), render_mode
        self._draws: list[np.random.Generator] = []
        self._ended = np.zeros(num_envs, np.bool_)

    def reset(
        self, *, seed: int | Sequence[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> _Batch:
        """Begins an episode in each arena.

        Args:
            seed: Seed of the first arena, the next number for each other one; or a seed for each.
            options: As in `ArenaEnv`, for all arenas; or `{"environments": [(seed, number), ...]}`, one for each.

        Raises:
            gymnasium.error.Error: Seeds or options are invalid.
        """
        rules.check_open(self.closed)
        self._take_seeds(seed)
        chosen = rules.chosen_layouts(options, self.num_envs)
        for i, draws in enumerate(self._draws):
            self._worlds.enter(i, *(chosen[i] or rules.draw_environment(draws, 1)))
        self._ended[:] = False
        self._view.follow()
        return self._senses(), self._infos()

    def step(self, actions: NDArray[np.int64]) -> _Stepped:
        """Carries out one action of each robot, or begins its next episode if the last one has ended.

        Raises:
            gymnasium.error.ResetNeeded: No episode has begun.
            gymnasium.error.InvalidAction: The actions are not in the action space.
            gymnasium.error.ClosedEnvironmentError: The environment was closed.
        """
        rules.check_open(self.closed)
        if not self._draws:
            raise error.ResetNeeded("no episode has begun: call reset")
        worlds, checked, anew = self._worlds, rules.checked_actions(actions, (self.num_envs,)), self._ended
        rewards = self._rewards.of_step(worlds, checked)[:, 0]  # nothing happens where an episode has ended
        for i in np.flatnonzero(anew):
            worlds.enter(int(i), *rules.draw_environment(self._draws[i], 1))
        rewards = np.where(anew, 0.0, rewards)
        terminated, truncated = (~anew & ended for ended in worlds.ended())
        self._ended = terminated | truncated
        self._view.follow()
        return self._senses(), rewards, terminated, truncated, self._infos()

    def render(self) -> tuple[rendering.Frame, ...] | None:
        """The picture of each arena with render_mode "rgb_array"; else None."""
        frames = (self._view.render(i) for i in range(self.num_envs))
        return tuple(it for it in frames if it is not None) or None

    def close_extras(self, **_: Any) -> None:
        """Closes the window."""
        self._view.close()

    def _take_seeds(self, seed: int | Sequence[int | None] | None) -> None:
        """Sets each arena's random generator; without a seed, an existing one continues."""
        seeds: Sequence[int | None]
        if seed is None or isinstance(seed, (int, np.integer)):
            seeds = [None if seed is None else int(seed) + i for i in range(self.num_envs)]
        else:
            seeds = seed
        if len(seeds) != self.num_envs:
            raise error.Error(f"{len(seeds)} seeds for {self.num_envs} arenas")
        old: Sequence[np.random.Generator | None] = self._draws or [None] * self.num_envs
        self._draws = [
            draws if one is None and draws is not None else seeding.np_random(one)[0]
            for one, draws in zip(seeds, old, strict=True)
        ]

    def _senses(self) -> NDArray[np.int32]:
        return np.array(self._worlds.senses[:, 0])

    def _infos(self) -> dict[str, Any]:
        given = np.ones(self.num_envs, np.bool_)
        robot_s = self._worlds.ticks * rules.PARAMS.tick_s
        return {
            "robot_s": robot_s,
            "_robot_s": given,
            "food_left": self._worlds.food_left.astype(np.int64),
            "_food_left": given.copy(),
        }
