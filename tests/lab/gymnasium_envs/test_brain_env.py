"""octet/Brain-v0: Gymnasium's own checks, and a firmware that does what it is told."""

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

import host_sim.lab.gymnasium_envs  # noqa: F401 - registers the environments
from host_sim.lab.gymnasium_envs.brain_env import KEEP, BrainEnv
from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig

NO_CHANGE = [KEEP] * 7


@pytest.mark.parametrize("acts_on", ["memory", "parameters"])
def test_gymnasium_finds_no_fault(acts_on):
    env = gymnasium.make("octet/Brain-v0", acts_on=acts_on).unwrapped
    check_env(env)
    env.close()


def test_left_alone_it_is_the_run_of_the_command_line():
    with make(RunConfig(seed=7, environments=1)) as simulation:
        (episode,) = simulation.run()
    env = BrainEnv()
    env.reset(options={"environment": (7, 1)})
    ended = truncated = False
    while not (ended or truncated):
        observation, _, ended, truncated, info = env.step(NO_CHANGE)

    assert info == {"robot_s": episode.robot_s, "food_left": episode.eaten.count(False)}
    assert tuple(observation[:7]) == episode.robots[0].memory[1:]
    env.close()


def test_a_long_training_takes_no_more_memory_than_an_episode():
    env = BrainEnv(step_s=0.02, acts_on="parameters")
    for _ in range(3):
        env.reset(seed=1)
        env.step([10, 9])

    simulation = env._simulation
    assert len(simulation.record.begun) == 1
    assert len(simulation.clients[0].dialogue.commands) < 10
    env.close()


def test_cells_are_written_and_kept():
    env = BrainEnv(step_s=0.02, learns=False)
    env.reset(seed=1)

    assert env.step([1, 2, 0, 2, 1, 1, 2])[0][:7].tolist() == [1, 2, 0, 2, 1, 1, 2]
    assert env.step([KEEP, 0, KEEP, KEEP, KEEP, KEEP, 1])[0][:7].tolist() == [1, 0, 0, 2, 1, 1, 1]
    assert env.reset()[0][:7].tolist() == [0] * 7
    env.close()


def test_a_robot_that_must_not_learn_does_not():
    env = BrainEnv(step_s=300, learns=False)
    env.reset(seed=1)

    assert env.step(NO_CHANGE)[0][:7].tolist() == [0] * 7
    env.close()


def test_parameters_take_effect():
    """A robot that is bored by its first remembered turn turns about more often."""
    bored = []
    for limit in (2, 254):
        env = BrainEnv(acts_on="parameters", parameters=("boredom_limit",), step_s=300)
        env.reset(seed=1)
        bored.append(env.step([limit])[0][10])
        env.close()

    assert bored[0] > bored[1]


def test_equal_seeds_give_equal_episodes():
    def episode() -> list:
        env = BrainEnv(step_s=20)
        seen = [env.reset(seed=3)[0].tolist()]
        draws = np.random.default_rng(1)
        seen += [env.step(draws.integers(4, size=7))[0].tolist() for _ in range(3)]
        env.close()
        return seen

    assert episode() == episode()
