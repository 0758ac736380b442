"""Fleets, comparisons and studies of a behaviour in a C file. The judge is the built-in behaviour `article`."""

import csv
import json
from pathlib import Path

import pytest

from host_sim.api import RunConfig
from host_sim.base.errors import BrainError
from host_sim.cli.main import main
from host_sim.lab.study.figures import FIGURES, compare
from host_sim.lab.study.fleets import sample_of
from host_sim.lab.study.folder import StudyFolder
from host_sim.lab.study.trial import Trial, run_trial
from host_sim.sim.fleet import run_fleet
from host_sim.sim.own_brain import OWN_HEADERS

WALL_FOLLOWER = OWN_HEADERS.parent / "examples" / "wall_follower.c"
TEMPLATE = (OWN_HEADERS / "mine.c").read_text()
BESIDE = "uint8_t *volatile beside = (uint8_t *)brain;\n    for (int i = 0; i < 300; i++) beside[i] = 7;"
CRASH = TEMPLATE.replace("brain->awaits = NOTHING;", BESIDE)  # only the address sanitizer notices that
COUNT = "if (++brain->own[0] == 0 && ++brain->own[1] == 8)\n        brain->own[2] = (uint8_t)(9 / brain->own[2]);"
LATE = TEMPLATE.replace("brain->awaits = NOTHING;", COUNT)
PLAN = 'profiles = ["article", "{mine}"]\nseeds = 2\nenvironments = 1\nlimit_s = 60\n'


@pytest.fixture
def mine(tmp_path):
    (tmp_path / "mine.c").write_text(TEMPLATE)
    return tmp_path / "mine.c"


def studied(folder: Path, mine: Path) -> int:
    (folder / "a.toml").write_text(PLAN.format(mine=mine))
    return main(["study", str(folder / "a.toml"), "--out", str(folder / "out"), "--jobs", "1"])


def test_fleet_of_the_template_behaves_as_article(mine, tmp_path, capsys):
    tables = []
    for profile in ("article", str(mine)):
        words = ["--robots", "40", "--environments", "2", "--limit-s", "300", "--out", str(tmp_path / "out")]
        assert main(["run", "--profile", profile, *words]) == 0
        tables.append(list(csv.reader((tmp_path / "out/robots.csv").read_text().splitlines())))

    assert tables[0] == tables[1]
    assert len(tables[0]) == 81
    assert f"profile {mine}" in capsys.readouterr().out


def test_example_wall_follower_finishes_more_and_sooner_than_searcher():
    theirs, ours = (sample_of(it, RunConfig(profile=it), 5_000_001, 300) for it in ("searcher", str(WALL_FOLLOWER)))

    assert compare(FIGURES["mean_s"], ours, theirs).high < 1
    assert ours.finished.mean() > 0.995
    assert not ours.bumped.any()
    assert ours.wrong.mean() == 0


def test_sharing_fleet_of_the_template_behaves_as_article(mine):
    config = {"robots": 6, "worlds": "own", "environments": 1, "settings": {"share": 1}, "limit_s": 200.0}

    ours, theirs = (list(run_fleet(RunConfig(profile=it, **config))) for it in (str(mine), "article"))

    assert ours == theirs


@pytest.mark.parametrize("words", [["run", "--robots", "50", "--profile"], ["compare", "--seeds", "1", "article"]])
def test_mistake_is_found_first_in_a_separate_process(words, mine, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    mine.write_text(CRASH)

    assert main([*words, str(mine)]) == 1

    assert "mine.c:45: a place beside a variable is used, at tick 0" in capsys.readouterr().err


def test_late_mistake_ends_a_fleet(mine):
    mine.write_text(LATE)

    with pytest.raises(BrainError, match=r"mine\.c:45:\d+: a division by zero, at tick [3-9]\d{3}, "):
        list(run_fleet(RunConfig(profile=str(mine), robots=30, worlds="own", environments=5)))


def test_c_file_is_compared_with_a_built_in_profile(mine, capsys):
    assert main(["compare", "article", str(mine), "--seeds", "2", "--environments", "1", "--jobs", "1"]) == 0

    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == f"article {mine}: 2 seeds of 1 environment each"
    rows = [line.split()[1:] for line in lines if line.startswith(("  article", f"  {mine}"))]
    assert len(rows) >= 10
    assert all(own[: len(theirs)] == theirs for theirs, own in zip(rows[::2], rows[1::2], strict=True))


def test_study_with_a_c_file_has_its_rows_and_its_sha256(mine, tmp_path):
    assert studied(tmp_path, mine) == 0

    told = json.loads((tmp_path / "out/study.json").read_text())
    environments = StudyFolder(tmp_path / "out").tables()["environments"]
    is_own = environments["condition"] == str(mine)
    assert len(told["sources"][str(mine)]) == 64
    for column in ("finished", "robot_s", "collisions", "sides"):
        assert environments[column][is_own].tolist() == environments[column][~is_own].tolist()


def test_study_is_not_resumed_with_another_source(mine, tmp_path, capsys):
    assert studied(tmp_path, mine) == 0
    mine.write_text(TEMPLATE + "/* changed */\n")

    assert studied(tmp_path, mine) == 2

    assert "has other sources; nothing was changed" in capsys.readouterr().err


def test_comparison_keeps_the_source_that_it_began_with(mine):
    config = RunConfig(profile=str(mine), fast=True, environments=1, limit_s=60.0)
    before = run_trial(Trial(config.with_seed(2)))["runs"]
    begun = config.with_seed(2)
    mine.write_text(TEMPLATE.replace("set[STEP_MM]", "set[STEP_MM] / 2"))

    assert run_trial(Trial(begun))["runs"] == before
    again = RunConfig(profile=str(mine), fast=True, environments=1, limit_s=60.0, seed=2)
    assert run_trial(Trial(again))["runs"] != before


def test_c_file_is_refused_on_a_cluster(mine, capsys, monkeypatch):
    monkeypatch.setattr("host_sim.lab.study.compare_command.workers_of", lambda _: None)

    assert main(["compare", str(mine), "--cluster", "tcp://nowhere:1"]) == 2

    assert f"--profile {mine} is a file of this machine: leave --cluster out" in capsys.readouterr().err
