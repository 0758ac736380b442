"""`octet/Arena-v0`: a robot controlled by an external learner."""

from typing import Any

import gymnasium
import numpy as np
from gymnasium import error
from numpy.typing import NDArray

from host_sim.lab.gymnasium_envs import rendering, rules


class ArenaEnv(gymnasium.Env[Any, Any]):
    """A robot in a random arena with three pieces of food; the learner selects its actions.

    A step is one action of the robot, carried out by the firmware's own motion, and takes as many control ticks of
    20 ms as the action needs; with `step_ticks`, at most that many; the next action then replaces the rest.

    The observation, a `Box` of int32: the robot's senses, field by field as on the bus.

    | index | meaning                                                                | min | max  | unit   |
    | ----- | ---------------------------------------------------------------------- | --- | ---- | ------ |
    | 0     | number of the control tick, wraps                                      | 0   | 255  | ticks  |
    | 1     | proximity: right 1, front-right 2, front 4, front-left 8, left 16      | 0   | 31   | bits   |
    | 2     | the body touches something                                             | 0   | 1    |        |
    | 3     | food is seen straight ahead                                            | 0   | 1    |        |
    | 4     | distance from the centre of the body to that food; 0: none             | 0   | 8191 | mm     |
    | 5     | distance rolled by the left wheel, forward counts up, wraps            | 0   | 4095 | 0.1 mm |
    | 6     | distance rolled by the right wheel, likewise                           | 0   | 4095 | 0.1 mm |

    The action, a `Discrete(6)`: one of the article's actions.

    | action | meaning                                                                                    |
    | ------ | ------------------------------------------------------------------------------------------ |
    | 0      | a step forward of 12 mm; ends early at an obstacle, and eats food that is within 150 mm then |
    | 1, 2   | turn 10 degrees to the left, to the right: the size of a remembered turn                    |
    | 3, 4   | turn 45 degrees to the left, to the right: the size of a trial                              |
    | 5      | turn about                                                                                  |

    The reward: 1 for each piece of food, -0.01 for each second of robot time, -0.1 for each time that the body begins
    to touch something; `rewards` changes that. An episode terminates when all food is eaten, and is truncated after
    `limit_s` seconds of robot time. `info` has the robot time so far, `robot_s`, and the pieces left, `food_left`.

    Each episode is in a new random arena. `reset(options={"environment": (seed, number)})` takes that environment of
    a run of `tools/run` instead.

    >>> import gymnasium
    >>> from host_sim.lab.gymnasium_envs.arena_env import ArenaEnv
    >>> env = ArenaEnv()
    >>> senses, info = env.reset(seed=1)
    >>> senses, reward, terminated, truncated, info = env.step(0)
    >>> info
    {'robot_s': 0.06, 'food_left': 3}
    """

    metadata = {"render_modes": [*rendering.MODES], "render_fps": rendering.FPS}  # noqa: RUF012 - as Gymnasium has it

    def __init__(
        self,
        limit_s: float = 600.0,
        step_ticks: int | None = None,
        rewards: rules.Rewards | None = None,
        body: str = "ideal",
        *,
        render_mode: str | None = None,
    ) -> None:
        """Creates the environment.

        Args:
            limit_s: Time limit of an episode, s of robot time.
            step_ticks: Maximum number of control ticks of a step; None for as many as its actions need.
            rewards: Rewards of a step.
            body: The robots' bodies: ideal, kit, or a file as in docs/bodies.md; each episode draws its own.
            render_mode: "rgb_array" for `render`, "human" to show each step in a window, or None.

        Raises:
            gymnasium.error.Error: The limit is out of its range, or there is no such mode.
            gymnasium.error.DependencyNotInstalled: The C code cannot be used.
        """
        self._rewards = rewards or rules.Rewards()
        self._worlds = rules.driven_worlds(1, 1, limit_s, step_ticks, body)
        self.observation_space, self.action_space = rules.senses_space(), rules.action_space()
        self._view, self.render_mode = rendering.View(render_mode, self._worlds), render_mode
        self._runs = self._closed = False

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[NDArray[np.int32], dict[str, Any]]:
        """Begins an episode.

        Raises:
            gymnasium.error.Error: Seed or options are invalid.
        """
        rules.check_open(self._closed)
        super().reset(seed=seed)
        chosen = rules.chosen_layout(options, 1)
        self._worlds.enter(0, *(chosen or rules.draw_environment(self.np_random, 1)))
        self._runs = True
        self._view.follow()
        return self._senses(), self._worlds.info(0)

    def step(self, action: int) -> tuple[NDArray[np.int32], float, bool, bool, dict[str, Any]]:
        """Carries out one action.

        Raises:
            gymnasium.error.ResetNeeded: No episode has begun, or the last one has ended.
            gymnasium.error.InvalidAction: The action is not in the action space.
            gymnasium.error.ClosedEnvironmentError: The environment was closed.
        """
        rules.check_open(self._closed)
        if not self._runs:
            raise error.ResetNeeded("no episode has begun, or it has ended: call reset")
        reward = self._rewards.of_step(self._worlds, rules.checked_actions(action, ()))
        terminated, truncated = (bool(ended) for (ended,) in self._worlds.ended())
        self._runs = not (terminated or truncated)
        self._view.follow()
        return self._senses(), float(reward[0, 0]), terminated, truncated, self._worlds.info(0)

    def render(self) -> rendering.Frame | None:
        """The picture of the arena, shape (height, width, 3), with render_mode "rgb_array"; else None."""
        return self._view.render()

    def close(self) -> None:
        """Ends the use of the environment."""
        self._closed = True
        self._view.close()

    def _senses(self) -> NDArray[np.int32]:
        return np.array(self._worlds.senses[0, 0])
