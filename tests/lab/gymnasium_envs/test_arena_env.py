"""octet/Arena-v0: Gymnasium's own checks, seeds, and actions that do what the table says."""

import math

import gymnasium
import numpy as np
import pytest
from gymnasium import error
from gymnasium.utils.env_checker import check_env
from pettingzoo.test import parallel_api_test, parallel_seed_test

import host_sim.lab.gymnasium_envs  # noqa: F401 - registers the environments
from host_sim.lab.gymnasium_envs.arena_env import ArenaEnv
from host_sim.lab.gymnasium_envs.arena_parallel_env import ArenaParallelEnv
from host_sim.lab.gymnasium_envs.rules import Rewards
from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig
from host_sim.world.geometry import SimParams

FORWARD, LEFT, RIGHT, TRY_LEFT, TRY_RIGHT, ABOUT = range(6)
COUNTS_PER_DEGREE = 10 * math.pi * SimParams().wheel_track_mm / 360


@pytest.fixture
def env() -> ArenaEnv:
    return ArenaEnv()


def episode(env: gymnasium.Env, seed: int, steps: int = 60) -> list[tuple]:
    draws = np.random.default_rng(0)
    seen = [tuple(env.reset(seed=seed)[0])]
    for _ in range(steps):
        senses, reward, ended, truncated, info = env.step(int(draws.integers(6)))
        seen.append((*senses, reward, ended, truncated, info["robot_s"]))
    return seen


@pytest.mark.filterwarnings("ignore:.*no window can be opened")  # "human" is tried, too
def test_environment_passes_gymnasium_s_checks():
    check_env(gymnasium.make("octet/Arena-v0").unwrapped)


def test_equal_seeds_give_equal_episodes_and_others_do_not(env):
    assert episode(env, 5) == episode(ArenaEnv(), 5) != episode(env, 6)


def test_reset_begins_in_another_arena(env):
    env.reset(seed=1)
    first = [env.step(FORWARD)[0].tolist() for _ in range(100)]
    env.reset()

    assert [env.step(FORWARD)[0].tolist() for _ in range(100)] != first


def test_forward_step_is_12_mm(env):
    env.reset(seed=1)
    senses, reward, *_, info = env.step(FORWARD)

    assert senses[5:].tolist() == [120, 120]
    assert info == {"robot_s": 0.06, "food_left": 3}
    assert reward == pytest.approx(-0.0006)


@pytest.mark.parametrize(
    ("action", "degrees"), [(LEFT, -10), (RIGHT, 10), (TRY_LEFT, -45), (TRY_RIGHT, 45), (ABOUT, 180)]
)
def test_turns_have_the_angles_of_the_action_table(env, action, degrees):
    env.reset(seed=1)
    left, right = (int(count) for count in env.step(action)[0][5:])
    forward, back = (left, right) if degrees > 0 else (right, left)

    assert forward == 4096 - back
    assert forward == pytest.approx(abs(degrees) * COUNTS_PER_DEGREE, abs=0.5 * COUNTS_PER_DEGREE)


@pytest.mark.parametrize(("body", "settings", "ticks"), [("ideal", {}, 62), ("kit", {"speed_mm_s": 200}, 40)])
def test_environment_senses_as_the_firmware_s_robot_tick_by_tick(body, settings, ticks):
    """Straight on until something is near: the firmware's own robot senses the same, tick by tick."""
    env = ArenaEnv(step_ticks=1, body=body)
    env.reset(options={"environment": (3, 1)})
    far = {"look_min_deg": 1, "step_mm": 250, **settings}
    with make(RunConfig(seed=3, environments=1, body=body, settings=far)) as simulation:
        simulation.enter(1)
        for _ in range(ticks):
            simulation.step()
            sensed = simulation.arena.body.sense(simulation.tick)
            assert env.step(FORWARD)[0].tolist()[1:] == [*map(int, sensed)][1:]


def test_kit_bodies_differ_from_episode_to_episode():
    ways = []
    env = ArenaEnv(body="kit")
    for seed in (1, 2):
        env.reset(seed=seed)
        ways.append(tuple(env.step(TRY_LEFT)[0][5:]))

    assert len(set(ways)) == len(ways)


def test_eaten_food_is_rewarded_and_removed():
    env = ArenaEnv(rewards=Rewards(food=10, second=0, bump=0))
    seed = next(seed for seed in range(200) if eats_at_once(seed))
    env.reset(options={"environment": (seed, 1)})
    rewards = []
    while not rewards or not rewards[-1]:
        rewards.append(env.step(FORWARD)[1])

    assert rewards[-1] == 10
    assert env.step(FORWARD)[-1]["food_left"] == 2


def eats_at_once(seed: int) -> bool:
    """Whether a piece of food lies straight ahead of the start."""
    env = ArenaEnv()
    senses, _ = env.reset(options={"environment": (seed, 1)})
    return bool(senses[3])


def test_episode_is_truncated_when_the_time_is_up():
    env = ArenaEnv(limit_s=1)
    env.reset(seed=1)

    assert env.step(ABOUT)[2:4] == (False, True)


def test_episode_terminates_when_all_food_is_eaten():
    env = ArenaEnv()
    env.reset(seed=1)
    for food in env._worlds.arenas[0].inside.food:
        food.eaten = True

    assert env.step(FORWARD)[2:4] == (True, False)


def test_bump_lowers_the_reward():
    env = ArenaEnv(rewards=Rewards(food=0, second=0, bump=-1))
    env.reset(seed=1)
    rewards = [env.step(FORWARD)[1] for _ in range(1000)]

    assert min(rewards) == -1  # against a wall, sooner or later


@pytest.fixture
def parallel_env() -> ArenaParallelEnv:
    return ArenaParallelEnv(robots=3, limit_s=20)


def test_parallel_environment_passes_pettingzoo_s_checks(parallel_env, capsys):
    parallel_api_test(parallel_env, num_cycles=200)

    assert "Passed" in capsys.readouterr().out


def test_parallel_environment_repeats_episodes_of_equal_seeds():
    parallel_seed_test(lambda: ArenaParallelEnv(robots=3, limit_s=20))


def test_parallel_environment_of_one_robot_equals_the_single_one():
    alone, other = ArenaParallelEnv(robots=1), ArenaEnv()
    senses, _ = alone.reset(seed=4)
    assert senses["robot_1"].tolist() == other.reset(seed=4)[0].tolist()
    for action in (FORWARD, LEFT, ABOUT, FORWARD, FORWARD) * 10:
        senses, rewards, *_ = alone.step({"robot_1": action})
        theirs, reward, *_ = other.step(action)
        assert (senses["robot_1"].tolist(), rewards["robot_1"]) == (theirs.tolist(), reward)


def test_parallel_step_ends_with_the_longest_action(parallel_env):
    parallel_env.reset(seed=1)
    senses, _, _, _, infos = parallel_env.step({"robot_1": FORWARD, "robot_2": ABOUT, "robot_3": LEFT})

    assert {info["robot_s"] for info in infos.values()} == {1.02}
    assert senses["robot_1"][5:].tolist() == [120, 120]


def feels(robots: int, number: int) -> list[int]:
    """What the first robot feels as all go straight on."""
    parallel_env = ArenaParallelEnv(robots)
    parallel_env.reset(options={"environment": (1, number)})
    return [parallel_env.step(dict.fromkeys(parallel_env.agents, FORWARD))[0]["robot_1"][1] for _ in range(60)]


def test_robots_sense_each_other():
    """In a full arena a robot sooner or later feels what it does not feel alone there."""
    assert any(feels(25, number) != feels(1, number) for number in range(1, 21))


def test_episodes_of_all_robots_end_at_once(parallel_env):
    parallel_env.reset(seed=1)
    while parallel_env.agents:
        *_, terminations, truncations, _ = parallel_env.step(dict.fromkeys(parallel_env.agents, ABOUT))

    assert truncations == dict.fromkeys(parallel_env.possible_agents, True)
    assert terminations == dict.fromkeys(parallel_env.possible_agents, False)


COUNT = 6


@pytest.fixture
def envs() -> gymnasium.vector.VectorEnv:
    return gymnasium.make_vec("octet/Arena-v0", num_envs=COUNT, vectorization_mode="vector_entry_point", limit_s=6)


def test_vector_environment_equals_single_environments(envs):
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


def test_vector_step_does_not_overwrite_earlier_observations(envs):
    before, _ = envs.reset(seed=1)
    kept = before.copy()
    envs.step(np.zeros(COUNT, np.int64))

    assert np.array_equal(before, kept)
    assert before in envs.observation_space


def test_vector_reset_takes_a_seed_for_each_arena(envs):
    first, _ = envs.reset(seed=[3] * COUNT)
    steps = [envs.step(np.zeros(COUNT, np.int64))[0] for _ in range(50)]

    assert all((senses == senses[0]).all() for senses in [first, *steps])


def test_vector_step_can_be_one_tick():
    envs = gymnasium.make_vec("octet/Arena-v0", num_envs=2, vectorization_mode="vector_entry_point", step_ticks=1)
    envs.reset(seed=1)

    assert envs.step(np.array([0, 5]))[0][:, 0].tolist() == [1, 1]


def test_reset_options_choose_the_environment_of_each_arena(envs):
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
def test_vector_reset_refuses_invalid_environments(envs, environments):
    with pytest.raises(error.Error, match="give a"):
        envs.reset(options={"environments": environments})
