"""Whatever is given: the error that Gymnasium's users expect, and an environment that goes on working.

Pictures, copies and the end of environments, with the wrappers of Gymnasium that need them.
"""

import copy
import io
import math
import pickle
import sys
from itertools import pairwise
from types import SimpleNamespace

import gymnasium
import numpy as np
import pytest
from gymnasium import error
from gymnasium.wrappers import RenderCollection
from PIL import Image

import host_sim.lab.gymnasium_envs  # noqa: F401 - registers the environments
from host_sim.lab.gymnasium_envs import driven_worlds
from host_sim.lab.gymnasium_envs.arena_env import ArenaEnv
from host_sim.lab.gymnasium_envs.arena_parallel_env import ArenaParallelEnv
from host_sim.lab.gymnasium_envs.arena_vector_env import ArenaVectorEnv
from host_sim.world.layouts import NoRoomError

NO_ACTIONS = [
    *(6, -1, 2**70, 1.0, math.nan, math.inf, None, "left", True, [0], [[0]], (), {}, np.zeros(2), [[1], [1, 2]]),
]
NO_LIMITS = ({"limit_s": 0}, {"limit_s": math.nan}, {"limit_s": math.inf}, {"step_ticks": 0}, {"step_ticks": -1})
NO_ENVIRONMENTS = (None, 7, (1,), (1, 2, 3), (-1, 1), (2**32, 1), (1, 0), (1.5, 1), "ab")


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: ArenaEnv(body="nobody.toml"), "nobody"),
        (lambda: ArenaEnv(render_mode="ansi"), "give 'human', 'rgb_array' or None"),
        (lambda: ArenaVectorEnv(0), "num_envs"),
        (lambda: ArenaVectorEnv(2).reset(seed=[1, 2, 3]), "3 seeds for 2 arenas"),
        *((lambda robots=it: ArenaParallelEnv(robots), "robots do not fit") for it in (0, -1, 32)),
        *((lambda it=it: ArenaEnv().reset(options={"environment": it}), "give a seed") for it in NO_ENVIRONMENTS),
        *((lambda it=it: ArenaEnv(**it), "give ") for it in NO_LIMITS),
        *((lambda it=it: ArenaVectorEnv(**it), "give ") for it in NO_LIMITS),
        *((lambda it=it: ArenaParallelEnv(**it), "give ") for it in NO_LIMITS),
    ],
)
def test_invalid_argument_is_refused(make, said):
    with pytest.raises(error.Error, match=said):
        make()


@pytest.mark.parametrize("action", NO_ACTIONS, ids=repr)
def test_invalid_action_is_refused_and_the_next_step_works(action):
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
def test_vector_environment_refuses_invalid_actions_and_goes_on(actions):
    envs = ArenaVectorEnv(2)
    envs.reset(seed=1)
    with pytest.raises(error.InvalidAction):
        envs.step(actions)

    assert envs.step(np.array([0, 1]))[4]["robot_s"].tolist() == pytest.approx([0.06, 0.06])


@pytest.mark.parametrize("actions", [{}, {"robot_1": 0}, {"robot_1": 0, "robot_3": 0}, {"robot_1": 0, "robot_2": 9}])
def test_parallel_environment_refuses_invalid_actions(actions):
    env = ArenaParallelEnv(2)
    env.reset(seed=1)
    with pytest.raises(error.InvalidAction):
        env.step(actions)


def test_step_before_reset_or_after_the_end_is_refused():
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
def test_invalid_seed_is_refused(seed):
    for env in (ArenaEnv(), ArenaVectorEnv(2), ArenaParallelEnv(2)):
        with pytest.raises((error.Error, TypeError)):
            env.reset(seed=seed)


def test_robots_without_room_in_the_arena_are_refused(monkeypatch):
    def full(_seed, number, *_):
        raise NoRoomError(number, 7)

    monkeypatch.setattr("host_sim.lab.gymnasium_envs.rules.generate", full)
    with pytest.raises(error.Error, match="8 robots are too many: none of 100 random arenas"):
        ArenaParallelEnv(8).reset(seed=1)
    with pytest.raises(error.Error, match="8 robots are too many: there is room for 7 robots"):
        ArenaParallelEnv(8).reset(options={"environment": (1, 1)})


def test_missing_c_library_is_reported(monkeypatch, tmp_path):
    monkeypatch.setattr(driven_worlds, "LIBRARY", tmp_path / "liboctet_driven.so")
    driven_worlds.loaded.cache_clear()
    with pytest.raises(error.DependencyNotInstalled, match=r"liboctet_driven\.so is missing; build it"):
        ArenaEnv()


RED, GREEN, BLUE = range(3)


def test_gymnasium_collects_pictures_that_change_with_the_robot():
    env = RenderCollection(gymnasium.make("octet/Arena-v0", render_mode="rgb_array", limit_s=60))
    env.reset(seed=1)
    for action in (5, 0, 0):
        env.step(action)

    pictures = env.render()

    assert len(pictures) == 4
    assert {picture.shape for picture in pictures} == {pictures[0].shape}
    assert pictures[0].dtype == np.uint8
    assert all(not np.array_equal(a, b) for a, b in pairwise(pictures))


def test_picture_shows_the_food_that_is_left():
    env = ArenaEnv(render_mode="rgb_array")
    env.reset(seed=1)

    picture = env.render().astype(int)

    green = (picture[..., GREEN] > 120) & (picture[..., RED] < 40)
    assert 3 * 80 < green.sum() < 3 * 130  # three discs of 100 mm, at 0.12 pixels a mm: 113 pixels each


def test_render_without_a_mode_is_none():
    env = ArenaEnv()
    env.reset(seed=1)

    assert env.render() is None


class FakeTk:
    """What tkinter is asked for; a real one was tried with Xvfb, whose screen showed the arena."""

    TclError = ValueError

    def __init__(self):
        self.pictures, self.updates, self.is_gone = [], 0, False

    def Tk(self, **_):  # noqa: N802 - as tkinter has it
        return self

    def Label(self, master):  # noqa: N802
        assert master is self
        return SimpleNamespace(pack=lambda: None, configure=self._configure)

    def _configure(self, image):
        self.pictures.append(image)

    def PhotoImage(self, master, data):  # noqa: N802
        if master.is_gone:
            raise self.TclError("application has been destroyed")
        return np.array(Image.open(io.BytesIO(data)))

    def update(self):
        self.updates += 1

    def destroy(self):
        self.is_gone = True


@pytest.fixture
def tk(monkeypatch) -> FakeTk:
    fake = FakeTk()
    monkeypatch.setitem(sys.modules, "tkinter", fake)
    return fake


def test_human_mode_shows_each_step_in_a_window_until_it_is_closed(tk):
    env, same = ArenaEnv(render_mode="human"), ArenaEnv(render_mode="rgb_array")
    for each in (env, same):
        each.reset(seed=1)
        each.step(0)

    assert len(tk.pictures) == tk.updates == 2
    assert np.array_equal(tk.pictures[-1], same.render())
    tk.destroy()
    env.step(0)
    assert len(tk.pictures) == 2


def test_window_closes_with_its_environment_and_is_not_copied(tk):
    for env in (
        ArenaEnv(render_mode="human"),
        ArenaVectorEnv(2, render_mode="human"),
        ArenaParallelEnv(render_mode="human"),
    ):
        tk.is_gone = False
        env.reset(seed=1)
        assert copy.deepcopy(env)._view._window is None
        env.close()
        assert tk.is_gone


def test_human_mode_draws_each_step_in_the_terminal_without_a_window(capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "tkinter", None)
    env = ArenaEnv(render_mode="human")
    with pytest.warns(UserWarning, match="no window can be opened: import of tkinter halted"):
        env.reset(seed=1)
    env.step(0)

    drawn = capsys.readouterr().out.split("\x1b[H")
    assert len(drawn) == 3
    assert drawn[1].count("\u2580") > 500


@pytest.mark.parametrize("duplicate", [copy.deepcopy, lambda env: pickle.loads(pickle.dumps(env))])
@pytest.mark.parametrize("body", ["ideal", "kit"])
def test_copy_continues_as_the_original_does(duplicate, body):
    env = ArenaEnv(limit_s=60, body=body)
    env.reset(seed=3)
    actions = np.random.default_rng(1).integers(6, size=80)
    for action in actions[:40]:
        env.step(action)

    other = duplicate(env)

    for action in actions[40:]:
        ours, theirs = env.step(action), other.step(action)
        assert np.array_equal(ours[0], theirs[0])
        assert ours[1:] == theirs[1:]
    assert np.array_equal(env.reset()[0], other.reset()[0])  # the next arena is the same, too


def test_copy_does_not_move_with_the_original():
    env = ArenaEnv()
    env.reset(seed=3)
    other = copy.deepcopy(env)
    env.step(5)

    assert env.step(0)[4]["robot_s"] > other.step(0)[4]["robot_s"]


def test_copies_of_vector_and_parallel_environments_continue_alike():
    many, several = ArenaVectorEnv(3, limit_s=2), ArenaParallelEnv(2)
    many.reset(seed=1)
    several.reset(seed=1)
    for step in range(30):  # the arenas end and begin anew at different steps
        many.step(np.array([0, step % 6, 5]))
        several.step({"robot_1": 0, "robot_2": step % 6})

    others = copy.deepcopy(many), pickle.loads(pickle.dumps(several))

    for _ in range(20):
        for ours, theirs in zip(many.step(np.array([0, 1, 2])), others[0].step(np.array([0, 1, 2])), strict=True):
            if isinstance(ours, np.ndarray):
                assert np.array_equal(ours, theirs)
        ours, theirs = (env.step({"robot_1": 1, "robot_2": 0}) for env in (several, others[1]))
        assert ours[1:] == theirs[1:]
        assert all(np.array_equal(ours[0][agent], theirs[0][agent]) for agent in several.possible_agents)


def test_closed_environment_refuses_step_and_reset():
    single, many, several = ArenaEnv(), ArenaVectorEnv(2), ArenaParallelEnv(2)
    for env, action in ((single, 0), (many, np.zeros(2, int)), (several, {"robot_1": 0, "robot_2": 0})):
        env.reset(seed=1)
        env.close()
        env.close()
        with pytest.raises(error.ClosedEnvironmentError):
            env.step(action)
        with pytest.raises(error.ClosedEnvironmentError):
            env.reset()
