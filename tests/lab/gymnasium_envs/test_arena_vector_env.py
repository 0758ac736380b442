"""octet/Arena-v0 many times at once: each does what it would do alone."""

import gymnasium
import numpy as np
import pytest
from gymnasium import error

import host_sim.lab.gymnasium_envs  # noqa: F401 - registers the environments
from host_sim.lab.gymnasium_envs.arena_env import ArenaEnv

COUNT = 6


@pytest.fixture
def envs() -> gymnasium.vector.VectorEnv:
    return gymnasium.make_vec("octet/Arena-v0", num_envs=COUNT, vectorization_mode="vector_entry_point", limit_s=6)


def test_each_does_what_it_would_do_alone_episode_after_episode(envs):
    draws = np.random.default_rng(1)
    single = [ArenaEnv(limit_s=6) for _ in range(COUNT)]
    alone = [env.reset(seed=7 + i)[0] for i, env in enumerate(single)]
    together, _ = envs.reset(seed=7)
    ended = [False] * COUNT
    episodes = 0
    for _ in range(120):
        assert np.array_equal(together, alone)
        actions = draws.integers(6, size=COUNT)
        together, rewards, terminated, truncated, infos = envs.step(actions)
        for i, env in enumerate(single):
            if ended[i]:
                alone[i], info = env.reset()
                wanted = (0.0, False, False)
            else:
                alone[i], *wanted, info = env.step(int(actions[i]))
            assert (rewards[i], terminated[i], truncated[i]) == tuple(wanted)
            assert infos["robot_s"][i] == pytest.approx(info["robot_s"])
            ended[i] = bool(wanted[1] or wanted[2])
            episodes += ended[i]

    assert episodes > COUNT


def test_observations_stay_as_they_are(envs):
    before, _ = envs.reset(seed=1)
    kept = before.copy()
    envs.step(np.zeros(COUNT, np.int64))

    assert np.array_equal(before, kept)
    assert before in envs.observation_space


def test_a_seed_for_each(envs):
    first, _ = envs.reset(seed=[3] * COUNT)
    steps = [envs.step(np.zeros(COUNT, np.int64))[0] for _ in range(50)]

    assert all((senses == senses[0]).all() for senses in [first, *steps])


def test_a_step_may_be_a_tick():
    envs = gymnasium.make_vec("octet/Arena-v0", num_envs=2, vectorization_mode="vector_entry_point", step_ticks=1)
    envs.reset(seed=1)

    assert envs.step(np.array([0, 5]))[0][:, 0].tolist() == [1, 1]


def test_each_arena_takes_the_environment_that_it_is_told(envs):
    chosen = [(7, 2), (8, 1), (9, 3), (7, 2), (1, 1), (2, 1)]
    single = [ArenaEnv(limit_s=6) for _ in chosen]
    alone = [env.reset(options={"environment": one})[0] for env, one in zip(single, chosen, strict=True)]
    together, _ = envs.reset(options={"environments": chosen})
    for _ in range(80):
        assert np.array_equal(together, alone)
        together = envs.step(np.zeros(COUNT, np.int64))[0]
        alone = [env.step(0)[0] for env in single]

    assert np.array_equal(together[0], together[3])
    assert len({senses.tobytes() for senses in together}) > 1


@pytest.mark.parametrize("environments", [[(1, 1)], 7, [(1, 1)] * 5 + [(1, 0)], "123456"])
def test_environments_that_are_none_are_refused(envs, environments):
    with pytest.raises(error.Error, match="give a"):
        envs.reset(options={"environments": environments})
