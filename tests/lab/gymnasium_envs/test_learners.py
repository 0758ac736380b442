"""What learners are given beside the environments: names, a scaled observation, and a baseline that learns."""

import subprocess
import sys

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

from host_sim.base.paths import ROOT
from host_sim.lab.gymnasium_envs.q_learning import Learned, learn
from host_sim.lab.gymnasium_envs.scaled import ScaledSenses, scaled


@pytest.mark.parametrize("first", ["", "import octet_robot\n"])
def test_gymnasium_finds_the_environments_by_the_package(first):
    code = f"{first}import gymnasium\nprint(gymnasium.make('octet_robot:octet/Arena-v0').reset(seed=1)[0].shape)"

    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, cwd=ROOT)

    assert (done.stdout, done.stderr) == ("(7,)\n", "")


@pytest.mark.filterwarnings("ignore:.*is different from the unwrapped version")
def test_scaled_senses_are_an_observation_like_any():
    check_env(ScaledSenses(gymnasium.make("octet_robot:octet/Arena-v0").unwrapped), skip_render_check=True)


def test_scaled_senses_say_what_is_near():
    told = scaled(np.array([[200, 0b10001, 1, 1, 2500, 9, 9], [0, 0b00100, 0, 0, 0, 0, 0]], np.int32))

    assert told.tolist() == [[1, 0, 0, 0, 1, 1, 1, 0.5], [0, 0, 1, 0, 0, 0, 0, 0]]


def test_a_curve_has_a_point_for_each_500_steps_up_to_the_last_episode():
    ends, food = Learned(np.zeros((1, 1)), np.array([1, 2, 4]), np.array([0, 499, 500])).curve()

    assert (ends.tolist(), food.tolist()) == ([500, 1000], [1.5, 4.0])


def test_the_baseline_eats_more_and_more():
    learned = learn(seed=1, steps=1600)

    _, food = learned.curve()
    assert food[-1] > 4 * food[0]
    assert np.array_equal(learn(seed=1, steps=100).table, learn(seed=1, steps=100).table)
