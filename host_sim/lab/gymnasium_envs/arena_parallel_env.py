"""Several robots in one arena, as a parallel environment of PettingZoo."""

from typing import Any

import numpy as np
from gymnasium import error, spaces
from gymnasium.utils import seeding
from numpy.typing import NDArray
from pettingzoo import ParallelEnv

from host_sim.lab.gymnasium_envs import rendering, rules

_Senses = dict[str, NDArray[np.int32]]
_Infos = dict[str, dict[str, Any]]
_Stepped = tuple[_Senses, dict[str, float], dict[str, bool], dict[str, bool], _Infos]


class ArenaParallelEnv(ParallelEnv[str, NDArray[np.int32], int]):  # type: ignore[misc] # PettingZoo has no types
    """Robots that share an arena and its food, and sense each other; agents are `robot_1`, `robot_2`, ...

    Observations, actions and rewards are those of `ArenaEnv`, for each robot by itself. A step ends when the last
    robot has ended its action; robots that finish sooner rest. An episode ends for all at once.

    >>> env = ArenaParallelEnv(robots=2)
    >>> senses, infos = env.reset(seed=1)
    >>> senses, rewards, terminations, truncations, infos = env.step({"robot_1": 0, "robot_2": 1})
    >>> sorted(rewards), infos["robot_1"]
    (['robot_1', 'robot_2'], {'robot_s': 0.06, 'food_left': 3})
    """

    metadata = {  # noqa: RUF012 - as PettingZoo has it
        "name": "octet_arena_v0",
        "render_modes": [*rendering.MODES],
        "render_fps": rendering.FPS,
    }

    def __init__(  # noqa: PLR0913 - each is given by name
        self,
        robots: int = 2,
        limit_s: float = 600.0,
        step_ticks: int | None = None,
        rewards: rules.Rewards | None = None,
        body: str = "ideal",
        *,
        render_mode: str | None = None,
    ) -> None:
        """Creates the environment with 1 to 31 robots; the other arguments are those of `ArenaEnv`.

        Raises:
            gymnasium.error.Error: A number is out of its range.
            gymnasium.error.DependencyNotInstalled: The C code cannot be used.
        """
        self._rewards, self._robots = rewards or rules.Rewards(), robots
        self._worlds = rules.driven_worlds(1, robots, limit_s, step_ticks, body)
        self.possible_agents = [f"robot_{number}" for number in range(1, robots + 1)]
        self.agents: list[str] = []
        self.observation_spaces = {agent: rules.senses_space() for agent in self.possible_agents}
        self.action_spaces = {agent: rules.action_space() for agent in self.possible_agents}
        self._view, self.render_mode = rendering.View(render_mode, self._worlds), render_mode
        self._draws: np.random.Generator | None = None
        self._closed = False

    def observation_space(self, agent: str) -> spaces.Box:
        """The space of a robot's senses."""
        return self.observation_spaces[agent]

    def action_space(self, agent: str) -> spaces.Discrete:
        """The space of a robot's actions."""
        return self.action_spaces[agent]

    def reset(self, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[_Senses, _Infos]:
        """Begins an episode.

        Raises:
            gymnasium.error.Error: Seed or options are invalid, or no arena has room for the robots.
        """
        rules.check_open(self._closed)
        if seed is not None or self._draws is None:
            self._draws = seeding.np_random(seed)[0]
        chosen = rules.chosen_layout(options, self._robots)
        self._worlds.enter(0, *(chosen or rules.draw_environment(self._draws, self._robots)))
        self.agents = list(self.possible_agents)
        self._view.follow()
        return self._senses(), self._infos()

    def step(self, actions: dict[str, int]) -> _Stepped:
        """Carries out one action of each robot.

        Raises:
            gymnasium.error.ResetNeeded: No episode has begun, or the last one has ended.
            gymnasium.error.InvalidAction: A robot has no action, or one that is not in its action space.
            gymnasium.error.ClosedEnvironmentError: The environment was closed.
        """
        rules.check_open(self._closed)
        if not self.agents:
            raise error.ResetNeeded("no episode has begun, or it has ended: call reset")
        if actions.keys() != set(self.agents):
            raise error.InvalidAction(f"actions are for {sorted(actions)}, the robots are {self.agents}")
        checked = np.array([rules.checked_actions(actions[agent], ()) for agent in self.agents], np.uint8)
        (rewards,), agents = self._rewards.of_step(self._worlds, checked).tolist(), self.agents
        terminated, truncated = (bool(ended) for (ended,) in self._worlds.ended())
        self.agents = [] if terminated or truncated else agents
        self._view.follow()
        ends = dict.fromkeys(agents, terminated), dict.fromkeys(agents, truncated)
        return self._senses(), dict(zip(agents, rewards, strict=True)), *ends, self._infos()

    def render(self) -> rendering.Frame | None:
        """The picture of the arena, as in `ArenaEnv`."""
        return self._view.render()

    def close(self) -> None:
        """Ends the use of the environment."""
        self._closed = True
        self._view.close()

    def _senses(self) -> _Senses:
        return {agent: self._worlds.senses[0, i].copy() for i, agent in enumerate(self.possible_agents)}

    def _infos(self) -> _Infos:
        return {agent: self._worlds.info(0) for agent in self.possible_agents}
