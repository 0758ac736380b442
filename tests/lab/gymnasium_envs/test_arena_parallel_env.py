"""Several robots in one arena: PettingZoo's own checks, and robots that sense each other."""

import pytest
from pettingzoo.test import parallel_api_test, parallel_seed_test

from host_sim.lab.gymnasium_envs.arena_env import ArenaEnv
from host_sim.lab.gymnasium_envs.arena_parallel_env import ArenaParallelEnv

FORWARD, LEFT, ABOUT = 0, 1, 5


@pytest.fixture
def env() -> ArenaParallelEnv:
    return ArenaParallelEnv(robots=3, limit_s=20)


def test_pettingzoo_finds_no_fault(env, capsys):
    parallel_api_test(env, num_cycles=200)

    assert "Passed" in capsys.readouterr().out


def test_equal_seeds_give_equal_episodes():
    parallel_seed_test(lambda: ArenaParallelEnv(robots=3, limit_s=20))


def test_one_robot_alone_does_as_in_the_other_environment():
    alone, other = ArenaParallelEnv(robots=1), ArenaEnv()
    senses, _ = alone.reset(seed=4)
    assert senses["robot_1"].tolist() == other.reset(seed=4)[0].tolist()
    for action in (FORWARD, LEFT, ABOUT, FORWARD, FORWARD) * 10:
        senses, rewards, *_ = alone.step({"robot_1": action})
        theirs, reward, *_ = other.step(action)
        assert (senses["robot_1"].tolist(), rewards["robot_1"]) == (theirs.tolist(), reward)


def test_a_step_ends_with_the_longest_action(env):
    env.reset(seed=1)
    senses, _, _, _, infos = env.step({"robot_1": FORWARD, "robot_2": ABOUT, "robot_3": LEFT})

    assert {info["robot_s"] for info in infos.values()} == {1.02}
    assert senses["robot_1"][5:].tolist() == [120, 120]


def feels(robots: int, number: int) -> list[int]:
    """What the first robot feels as all go straight on."""
    env = ArenaParallelEnv(robots)
    env.reset(options={"environment": (1, number)})
    return [env.step(dict.fromkeys(env.agents, FORWARD))[0]["robot_1"][1] for _ in range(60)]


def test_robots_sense_each_other():
    """In a full arena a robot sooner or later feels what it does not feel alone there."""
    assert any(feels(25, number) != feels(1, number) for number in range(1, 21))


def test_all_end_at_once(env):
    env.reset(seed=1)
    while env.agents:
        *_, terminations, truncations, _ = env.step(dict.fromkeys(env.agents, ABOUT))

    assert truncations == dict.fromkeys(env.possible_agents, True)
    assert terminations == dict.fromkeys(env.possible_agents, False)
