"""Whatever is given: the error that Gymnasium's users expect, and an environment that goes on working."""

import math

import numpy as np
import pytest
from gymnasium import error

from host_sim.lab.gymnasium_envs import driven_worlds
from host_sim.lab.gymnasium_envs.arena_env import ArenaEnv
from host_sim.lab.gymnasium_envs.arena_parallel_env import ArenaParallelEnv
from host_sim.lab.gymnasium_envs.arena_vector_env import ArenaVectorEnv
from host_sim.world.layouts import NoRoomError

NO_ACTIONS = [
    6,
    -1,
    2**70,
    1.0,
    math.nan,
    math.inf,
    None,
    "left",
    True,
    [0],
    [[0]],
    (),
    {},
    np.zeros(2),
    [[1], [1, 2]],
]


def test_a_body_that_is_none():
    with pytest.raises(error.Error, match="nobody"):
        ArenaEnv(body="nobody.toml")


@pytest.mark.parametrize("action", NO_ACTIONS, ids=repr)
def test_an_action_that_is_none(action):
    env = ArenaEnv()
    env.reset(seed=1)
    with pytest.raises(error.InvalidAction, match="is not an action"):
        env.step(action)

    assert env.step(np.int64(0))[-1]["robot_s"] == 0.06


@pytest.mark.parametrize(
    "actions",
    [*NO_ACTIONS, [0], [0, 1, 2], [0, 6], [0, math.nan], np.array([0.0, math.inf]), np.array([0, -1])],
    ids=repr,
)
def test_actions_of_several_arenas_that_are_none(actions):
    envs = ArenaVectorEnv(2)
    envs.reset(seed=1)
    with pytest.raises(error.InvalidAction):
        envs.step(actions)

    assert envs.step(np.array([0, 1]))[4]["robot_s"].tolist() == pytest.approx([0.06, 0.06])


@pytest.mark.parametrize("actions", [{}, {"robot_1": 0}, {"robot_1": 0, "robot_3": 0}, {"robot_1": 0, "robot_2": 9}])
def test_actions_of_robots_that_are_none(actions):
    env = ArenaParallelEnv(2)
    env.reset(seed=1)
    with pytest.raises(error.InvalidAction):
        env.step(actions)


def test_a_step_before_the_beginning_or_after_the_end():
    single, several = ArenaEnv(limit_s=1), ArenaParallelEnv(2, limit_s=1)
    for begin in (lambda: None, lambda: (single.reset(), several.reset())):
        begin()
        if several.agents:
            single.step(5), several.step(dict.fromkeys(several.agents, 5))
        with pytest.raises(error.ResetNeeded):
            single.step(0)
        with pytest.raises(error.ResetNeeded):
            several.step({})
    with pytest.raises(error.ResetNeeded):
        ArenaVectorEnv(2).step(np.zeros(2, np.int64))


@pytest.mark.parametrize("seed", [-1, 1.5, "one", math.nan])
def test_a_seed_that_is_none(seed):
    for env in (ArenaEnv(), ArenaVectorEnv(2), ArenaParallelEnv(2)):
        with pytest.raises((error.Error, TypeError)):
            env.reset(seed=seed)


def test_a_wrong_number_of_seeds():
    with pytest.raises(error.Error, match="3 seeds for 2 arenas"):
        ArenaVectorEnv(2).reset(seed=[1, 2, 3])


@pytest.mark.parametrize("environment", [None, 7, (1,), (1, 2, 3), (-1, 1), (2**32, 1), (1, 0), (1.5, 1), "ab"])
def test_an_environment_that_is_none(environment):
    with pytest.raises(error.Error, match="give a seed"):
        ArenaEnv().reset(options={"environment": environment})


@pytest.mark.parametrize("robots", [0, -1, 32])
def test_more_robots_than_there_can_be(robots):
    with pytest.raises(error.Error, match="robots do not fit"):
        ArenaParallelEnv(robots)


def test_more_robots_than_have_room(monkeypatch):
    def full(_seed, number, *_):
        raise NoRoomError(number, 7)

    monkeypatch.setattr("host_sim.lab.gymnasium_envs.rules.generate", full)
    with pytest.raises(error.Error, match="8 robots are too many: none of 100 random arenas"):
        ArenaParallelEnv(8).reset(seed=1)
    with pytest.raises(error.Error, match="8 robots are too many: there is room for 7 robots"):
        ArenaParallelEnv(8).reset(options={"environment": (1, 1)})


@pytest.mark.parametrize(
    "arguments",
    [{"limit_s": 0}, {"limit_s": math.nan}, {"limit_s": math.inf}, {"step_ticks": 0}, {"step_ticks": -1}],
    ids=repr,
)
def test_limits_out_of_range(arguments):
    for kind in (ArenaEnv, ArenaVectorEnv, ArenaParallelEnv):
        with pytest.raises(error.Error):
            kind(**arguments)


def test_no_arenas():
    with pytest.raises(error.Error, match="num_envs"):
        ArenaVectorEnv(0)


def test_c_code_that_is_missing_is_named(monkeypatch, tmp_path):
    monkeypatch.setattr(driven_worlds, "LIBRARY", tmp_path / "liboctet_driven.so")
    driven_worlds.loaded.cache_clear()
    with pytest.raises(error.DependencyNotInstalled, match=r"liboctet_driven\.so is missing; build it"):
        ArenaEnv()
