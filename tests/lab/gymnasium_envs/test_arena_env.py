"""octet/Arena-v0: Gymnasium's own checks, seeds, and actions that do what the table says."""

import math

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

import host_sim.lab.gymnasium_envs  # noqa: F401 - registers the environments
from host_sim.lab.gymnasium_envs.arena_env import ArenaEnv
from host_sim.lab.gymnasium_envs.rules import Rewards
from host_sim.protocol.generated import Senses
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
def test_gymnasium_finds_no_fault():
    check_env(gymnasium.make("octet/Arena-v0").unwrapped)


def test_equal_seeds_give_equal_episodes_and_others_do_not(env):
    assert episode(env, 5) == episode(ArenaEnv(), 5) != episode(env, 6)


def test_each_reset_begins_in_another_arena(env):
    env.reset(seed=1)
    first = [env.step(FORWARD)[0].tolist() for _ in range(100)]
    env.reset()

    assert [env.step(FORWARD)[0].tolist() for _ in range(100)] != first


def test_a_step_forward_is_12_mm(env):
    env.reset(seed=1)
    senses, reward, *_, info = env.step(FORWARD)

    assert senses[5:].tolist() == [120, 120]
    assert info == {"robot_s": 0.06, "food_left": 3}
    assert reward == pytest.approx(-0.0006)


@pytest.mark.parametrize(
    ("action", "degrees"), [(LEFT, -10), (RIGHT, 10), (TRY_LEFT, -45), (TRY_RIGHT, 45), (ABOUT, 180)]
)
def test_a_turn_is_as_large_as_the_table_says(env, action, degrees):
    env.reset(seed=1)
    left, right = (int(count) for count in env.step(action)[0][5:])
    forward, back = (left, right) if degrees > 0 else (right, left)

    assert forward == 4096 - back
    assert forward == pytest.approx(abs(degrees) * COUNTS_PER_DEGREE, abs=0.5 * COUNTS_PER_DEGREE)


def test_it_is_the_world_of_the_firmware():
    """Straight on until something is near: the firmware's own robot senses the same, tick by tick."""
    env = ArenaEnv(step_ticks=1)
    env.reset(options={"environment": (3, 1)})
    with make(RunConfig(seed=3, environments=1, settings={"look_min_deg": 1, "step_mm": 250})) as simulation:
        simulation.enter(1)
        for _ in range(62):
            simulation.step()
            assert env.step(FORWARD)[0].tolist()[1:] == [*map(int, next_senses(simulation))][1:]


def test_each_episode_draws_a_body_of_the_kit_that_the_firmware_would_have():
    env = ArenaEnv(step_ticks=1, body="kit")
    env.reset(options={"environment": (3, 1)})
    with make(
        RunConfig(seed=3, environments=1, body="kit", settings={"look_min_deg": 1, "step_mm": 250, "speed_mm_s": 200})
    ) as simulation:
        simulation.enter(1)
        for _ in range(40):
            simulation.step()
            assert env.step(FORWARD)[0].tolist()[1:] == [*map(int, next_senses(simulation))][1:]


def test_real_bodies_differ_from_one_episode_to_the_next():
    ways = []
    env = ArenaEnv(body="kit")
    for seed in (1, 2):
        env.reset(seed=seed)
        ways.append(tuple(env.step(TRY_LEFT)[0][5:]))

    assert len(set(ways)) == len(ways)


def next_senses(simulation) -> Senses:
    return simulation.arena.body.sense(simulation.tick)


def test_food_is_eaten_rewarded_and_gone():
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


def test_an_episode_ends_when_the_time_is_up():
    env = ArenaEnv(limit_s=1)
    env.reset(seed=1)

    assert env.step(ABOUT)[2:4] == (False, True)


def test_an_episode_ends_when_all_food_is_eaten():
    env = ArenaEnv()
    env.reset(seed=1)
    for food in env._worlds.arenas[0].inside.food:
        food.eaten = True

    assert env.step(FORWARD)[2:4] == (True, False)


def test_bumps_cost():
    env = ArenaEnv(rewards=Rewards(food=0, second=0, bump=-1))
    env.reset(seed=1)
    rewards = [env.step(FORWARD)[1] for _ in range(1000)]

    assert min(rewards) == -1  # against a wall, sooner or later
