"""The programming interface: the same runs as by the command line, and tables of them."""

import doctest
import importlib
import json
import pkgutil
from dataclasses import fields

import numpy as np
import pytest

import host_sim
from host_sim.api import RunConfig, UsageError, resimulate, run
from host_sim.cli.main import main
from host_sim.client.frame_log import digest_of

CONFIG = RunConfig(seed=3, environments=2, limit_s=20)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("api")


@pytest.fixture(scope="module")
def done(folder):
    return run(CONFIG, log=folder / "run.log")


def test_api_run_equals_that_of_the_command_line(done, folder, tmp_path):
    options = ["--bus", "none", "--seed", "3", "--environments", "2", "--limit-s", "20", "--quiet"]
    assert main(["run", *options, "--out", str(tmp_path)]) == 0

    assert json.loads((tmp_path / "summary.json").read_text())["log_sha256"] == done.log_sha256
    assert digest_of((folder / "run.log").read_bytes()) == done.log_sha256
    assert (folder / "run.world.json").read_bytes() == (tmp_path / "run.world.json").read_bytes()


def test_run_without_a_log_has_the_same_digest(done):
    assert run(CONFIG).log_sha256 == done.log_sha256


def test_callback_gets_each_episode_as_it_ends():
    told = []

    ended = run(CONFIG, each=told.append)

    assert told == ended.episodes


def test_refused_run_leaves_the_log_of_an_earlier_one(tmp_path):
    run(RunConfig(environments=1, limit_s=1), log=tmp_path / "run.log")
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}

    with pytest.raises(UsageError, match="refused"):
        run(RunConfig(settings={"turn_deg": 200}), log=tmp_path / "run.log")

    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == before


def test_run_that_ends_early_can_be_resimulated(tmp_path):
    run(RunConfig(seed=1, environments=1, limit_s=1), log=tmp_path / "run.log")

    def ends(_episode):
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        run(CONFIG, log=tmp_path / "run.log", each=ends)

    assert resimulate(tmp_path / "run.log").trajectory.ticks == 1000


def test_run_begins_with_the_given_memory():
    cells = (0, 2, 2, 2, 1, 1, 1, 1)

    assert run(RunConfig(environments=1, limit_s=1), memories=[cells]).memories == [cells]


def test_ticks_are_columns_of_equal_length(done, folder):
    ticks, again = done.ticks(), resimulate(folder / "run.log").trajectory

    assert {column.shape for column in ticks.values()} == {(done.trajectory.ticks,)}
    assert np.array_equal(ticks["feel"], again.tracks[0].column("feel"))
    assert ticks["tick"][300] == ticks["tick_number"][300] % 256
    assert (ticks["x"][-1], ticks["y"][-1]) == tuple(again.tracks[0].pose(again.ticks - 1)[:2])


def test_impossible_run_raises_an_error_of_one_line(tmp_path):
    with pytest.raises(UsageError, match=r"^32 robots from node 1 need node 32; the last is 31$"):
        run(RunConfig(robots=32))
    with pytest.raises(UsageError, match="cannot write"):
        run(CONFIG, log=tmp_path / "nowhere" / "run.log")


@pytest.mark.parametrize(("name", "value"), [("seed", -1), ("limit_s", 1e6), ("profile", "genius"), ("owner", 256)])
def test_configuration_refuses_a_wrong_value_by_its_name(name, value):
    with pytest.raises(UsageError, match=f"{name} must be one of .*, not {value!r}"):
        RunConfig(**{name: value})


def test_docstring_of_run_config_has_each_option_with_its_range():
    assert "seed: seed for environments and random turns (0..4294967295)." in RunConfig.__doc__
    assert all(f"        {field.name}: " in RunConfig.__doc__ for field in fields(RunConfig))


MODULES = [
    info.name
    for info in pkgutil.walk_packages(host_sim.__path__, "host_sim.")
    if ">>>" in (importlib.util.find_spec(info.name).loader.get_source(info.name) or "")
]


def failures_in(module: object) -> int:
    return doctest.testmod(module, report=False).failed


def test_modules_have_doctest_examples():
    assert {"host_sim.sim.make", "host_sim.world.arena", "host_sim.world.body", "host_sim.world.layouts"} <= set(
        MODULES
    )


@pytest.mark.parametrize("name", MODULES)
def test_doctest_examples_of_a_module_hold(name):
    assert failures_in(importlib.import_module(name)) == 0


def test_wrong_doctest_example_is_detected(capsys):
    wrong = type(doctest)("wrong", "An example.\n\n>>> 1 + 1\n3\n")

    assert failures_in(wrong) == 1
    capsys.readouterr()
