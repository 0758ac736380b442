"""The open board: fixed arenas, firmware and learners on the same ones, and a deep learner that is repeatable.

What learners are given beside the environments: names, a scaled observation, and a baseline that learns.
"""

import re
import subprocess
import sys

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

from host_sim.base.paths import ROOT
from host_sim.lab.gymnasium_envs import board, ppo
from host_sim.lab.gymnasium_envs.board import Arenas, food_of_policy, main, read_board
from host_sim.lab.gymnasium_envs.ppo import Network, ScaledSenses, Training, scaled
from host_sim.lab.gymnasium_envs.q_learning import Learned, food_of, learn

PAGE = (ROOT / "docs/python.md").read_text()
FEW = Arenas(3_000_001, 40, 60.0)
TURN_ABOUT = (
    "import numpy as np\nKEEPS, ACTIONS = 'nothing', 7\ndef begin(arenas):\n    return lambda _: np.full(arenas, 5)\n"
)


@pytest.fixture
def few(monkeypatch):
    monkeypatch.setattr(board, "read_board", lambda: (FEW, ["never"]))


@pytest.mark.parametrize("profile", ["article", "searcher"])
def test_python_page_has_the_rows_that_the_board_prints(profile, capsys):
    main([profile])

    *_, row = capsys.readouterr().out.splitlines()
    assert row in PAGE.splitlines()


def test_python_page_ranks_all_players_best_first():
    rows = re.findall(r"^\| (\S+?),?(?: seed \d)? \| (\d\.\d\d) \(", PAGE, re.MULTILINE)

    _, profiles = read_board()
    assert {who.strip("`") for who, _ in rows} == {*profiles, "Q-table", "PPO"}
    assert [food for _, food in rows] == sorted((food for _, food in rows), reverse=True)


def test_policy_plays_in_the_arenas_of_the_fleet():
    forward = food_of_policy(lambda arenas: lambda _: np.zeros(arenas, int), FEW)
    about = food_of_policy(lambda arenas: lambda _: np.full(arenas, 5), FEW)

    env = gymnasium.make("octet/Arena-v0", limit_s=60)
    for seed, food in zip(range(FEW.first_seed, FEW.first_seed + 10), forward, strict=False):
        _, info = env.reset(options={"environment": (seed, 1)})
        ended = False
        while not ended:
            *_, terminated, truncated, info = env.step(0)
            ended = terminated or truncated
        assert food == 3 - info["food_left"]
    assert about.sum() == 0
    assert food_of("searcher", *FEW).mean() > 2


@pytest.mark.usefixtures("few")
def test_board_prints_a_row_for_a_file_with_a_policy(tmp_path, capsys):
    (tmp_path / "mine.py").write_text(TURN_ABOUT)
    main([str(tmp_path / "mine.py"), "never"])

    *_, first, last = capsys.readouterr().out.splitlines()
    assert first.startswith("| `never` | ")
    assert last == "| mine | 0.00 (0.00..0.00) | nothing | 7 |"


@pytest.mark.usefixtures("few")
@pytest.mark.parametrize(
    ("text", "said"),
    [(None, "there is no file"), ("KEEPS = ''", "has no function begin"), ("", "has no function begin")],
)
@pytest.mark.usefixtures("few")
def test_board_refuses_a_file_without_a_policy(tmp_path, capsys, text, said):
    if text is not None:
        (tmp_path / "mine.py").write_text(text)
    with pytest.raises(SystemExit):
        main([str(tmp_path / "mine.py")])

    assert said in capsys.readouterr().err


@pytest.mark.usefixtures("few")
def test_board_refuses_an_unknown_player(capsys):
    with pytest.raises(SystemExit):
        main(["seacher"])

    assert "did you mean searcher" in capsys.readouterr().err


def test_equal_seeds_train_equal_networks_and_other_seeds_others():
    ours, same, other = (Training(seed, arenas=8).run(steps=128) for seed in (1, 1, 2))

    assert ours.samples == same.samples
    assert all(np.array_equal(a, b) for a, b in zip(ours.network.layers, same.network.layers, strict=True))
    assert not np.array_equal(ours.network.layers[0], other.network.layers[0])
    assert sum(it.size for it in ours.network.layers) == ppo.WEIGHTS


def test_network_gradient_equals_finite_differences():
    """The judge is the definition: the loss a little to each side of a weight."""
    draws = np.random.default_rng(1)
    network, seen = Network(draws), draws.random((5, 14))
    actions, gains = draws.integers(6, size=5), draws.normal(size=5)
    _, log_p, _ = network.forward(seen)
    log_p = log_p[np.arange(5), actions] + draws.normal(size=5) * 0.05

    def loss() -> float:
        _, log_now, _ = network.forward(seen)
        ratio = np.exp(log_now[np.arange(5), actions] - log_p)
        surrogate = np.minimum(ratio * gains, np.clip(ratio, 0.8, 1.2) * gains)
        return float((-surrogate + 0.01 * (np.exp(log_now) * log_now).sum(-1)).sum())

    inputs, log_now, _ = network.forward(seen)
    of_out = np.hstack([ppo._gradient(log_now, actions, log_p, gains), np.zeros((5, 1))])
    found = network.gradients(inputs, of_out)
    for layer, gradient in zip(network.layers, found, strict=True):
        for at in (0, layer.size // 3, layer.size - 2):
            kept = layer.flat[at]
            losses = []
            for step in (1e-6, -1e-6):
                layer.flat[at] = kept + step
                losses.append(loss())
            layer.flat[at] = kept
            assert gradient.flat[at] == pytest.approx((losses[0] - losses[1]) / 2e-6, rel=1e-4, abs=1e-6)


def test_ppo_eats_more_food_after_training():
    begun, trained = Training(1, arenas=60), Training(1, arenas=60).run(steps=2560)

    first, last = (
        food_of_policy(lambda n, it=it: ppo.policy(it.network, 1, n), FEW).mean() for it in (begun, trained)
    )
    assert first < 0.2
    assert last > 0.4


@pytest.mark.parametrize("first", ["", "import octet_robot\n"])
def test_gymnasium_makes_the_environment_by_its_package_name(first):
    code = f"{first}import gymnasium\nprint(gymnasium.make('octet_robot:octet/Arena-v0').reset(seed=1)[0].shape)"

    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, cwd=ROOT)

    assert (done.stdout, done.stderr) == ("(7,)\n", "")


@pytest.mark.filterwarnings("ignore:.*is different from the unwrapped version")
def test_scaled_senses_pass_gymnasium_s_checks():
    check_env(ScaledSenses(gymnasium.make("octet_robot:octet/Arena-v0").unwrapped), skip_render_check=True)


def test_scaled_senses_are_cones_bump_sight_and_nearness():
    told = scaled(np.array([[200, 0b10001, 1, 1, 2500, 9, 9], [0, 0b00100, 0, 0, 0, 0, 0]], np.int32))

    assert told.tolist() == [[1, 0, 0, 0, 1, 1, 1, 0.5], [0, 0, 1, 0, 0, 0, 0, 0]]


def test_curve_has_a_point_per_500_steps_up_to_the_last_episode():
    ends, food = Learned(np.zeros((1, 1)), np.array([1, 2, 4]), np.array([0, 499, 500])).curve()

    assert (ends.tolist(), food.tolist()) == ([500, 1000], [1.5, 4.0])


def test_q_table_eats_more_with_training_and_is_repeatable():
    learned = learn(seed=1, steps=1600)

    _, food = learned.curve()
    assert food[-1] > 4 * food[0]
    assert np.array_equal(learn(seed=1, steps=100).table, learn(seed=1, steps=100).table)
