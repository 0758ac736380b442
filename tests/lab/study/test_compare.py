"""`tools/octet compare`, of studies and of profiles, and its exit code; plots of a study.

Each option of the commands for studies does something that can be seen: the table of tests/cli says what.
"""

import subprocess
import sys

import numpy as np
import pytest
from PIL import Image

from host_sim.base.paths import ROOT
from host_sim.cli.main import main
from host_sim.lab.study.heiserman import CLASSES, scores
from host_sim.lab.study.plots import draw_plots
from tests.cli.option_rows import LAB, Trial, tried
from tests.lab.study.support import SWAPPED, contact, row, run, samples
from tests.runs.support import octet

GOAL = '[[goals]]\nfigure = "finished"\ncondition = "article"\nat_{word} = {bound}\n'
ONE = ["--seeds", "1", "--environments", "1", "--jobs", "1"]


def test_compare_runs_the_given_profiles_without_a_study(capsys):
    assert main(["compare", "never", "five", "--set", "filter=1", *ONE]) == 0

    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "never five: 1 seed of 1 environment each"
    assert [line.split()[0] for line in lines[2:4]] == ["never", "five"]
    assert "To detect 5 % of the mean time of five: an unknown number of seeds (power 80 %)." in lines


def test_command_line_with_a_body_is_judged_without_packages():
    code = 'from host_sim.__main__ import judge; print(*judge(["compare", "article", "--body", "kit"]))'

    judged = subprocess.run([sys.executable, "-S", "-c", code], capture_output=True, text=True, check=False, cwd=ROOT)

    assert (judged.returncode, judged.stderr) == (0, "")


@pytest.fixture
def compared(tmp_path, capsys):
    """Makes studies of texts, one after the other in a folder; the exit code of compare, and what it says."""

    def compare(*texts: str, name: str = "a") -> tuple[int, str]:
        plan, out = tmp_path / f"{name}.toml", str(tmp_path / "out")
        for text in texts:
            plan.write_text(f"environments = 1\n{text}")
            assert main(["study", str(plan), "--out", out, "--jobs", "1"]) == 0
        capsys.readouterr()
        return main(["compare", out]), capsys.readouterr().out

    return compare


@pytest.mark.parametrize(("word", "bound", "code"), [("least", 0, 0), ("most", -1, 1)])
def test_compare_exits_with_1_if_a_goal_is_missed(compared, word, bound, code):
    text = 'title = "Mine"\nprofiles = ["article", "never"]\nseeds = 1\nlimit_s = 20\n'

    found, said = compared(text + GOAL.format(word=word, bound=bound))

    assert found == code
    assert "Mine: 1 seed of 1 environment each" in said
    assert ("MISSED" in said) == (code == 1)


def test_seeds_that_are_no_longer_in_the_plan_are_not_compared(compared):
    text = 'profiles = ["article"]\nseeds = 2\nlimit_s = 5\n'

    _, said = compared(f"{text}first_seed = 1", f"{text}first_seed = 11\nchosen_on = [1, 10]")

    assert "a: 2 seeds of 1 environment each, none of 1..10" in said


def test_compare_of_equal_conditions_says_that_they_are_equal(compared):
    _, said = compared('profiles = ["fixed"]\nseeds = 2\nlimit_s = 5\n[settings.a]\n[settings.b]\n')

    assert "b takes as long as a with each seed." in said


def test_study_without_a_title_is_named_after_its_file(compared):
    _, said = compared('profiles = ["fixed"]\nseeds = 1\nlimit_s = 5\n', name="mine")

    assert "mine: 1 seed of" in said


@pytest.mark.parametrize(
    "words",
    [
        ["genius"],
        ["artcle"],
        ["article", "--change", "gremlin@env1"],
        ["article", "--set", "filter=2"],
        ["article", "--difference", "0"],
        [".", "--seeds", "3"],
        [".", "--set", "filter=1"],
        [".", "--jobs", "77"],
        ["."],
        [".", "article"],
        ["article", "--change", "mirror@env1", "--change", "repair@env2"],
        [],
    ],
)
def test_wrong_usage_is_reported_in_one_line(capsys, words):
    assert main(["compare", *words]) == 2

    assert capsys.readouterr().err.count("\n") == 1


def test_option_for_profiles_is_refused_with_a_study(tmp_path, capsys):
    assert main(["compare", str(tmp_path), "--seeds", "3"]) == 2

    said = f"octet: {tmp_path} is the folder of a study: leave out --seeds, for profiles only\n"
    assert capsys.readouterr().err == said


def test_draw_plots_writes_four_pictures(tmp_path):
    changed = row(contacts=[contact(body=SWAPPED)], body=SWAPPED)
    few = samples(*(run(name, seed, row(10.0 * seed), changed) for name in "ab" for seed in (1, 2)))

    paths = draw_plots(few, tmp_path / "new/plots")

    assert [path.stem for path in paths] == ["learning", "survival", "score", "recovery"]
    for path in paths:
        with Image.open(path) as picture:
            assert picture.size == (770, 462)


def test_recovery_is_not_drawn_without_a_change(tmp_path):
    assert "recovery" not in [path.stem for path in draw_plots(samples(run("a", 1, row())), tmp_path)]


@pytest.mark.parametrize("kind", CLASSES)
def test_score_curve_of_a_creature_is_repeatable_and_a_running_mean(kind):
    curve = list(scores(kind, 7, 50))

    assert curve == list(scores(kind, 7, 50))
    assert len(curve) == 50
    good = np.array(curve) * np.arange(1, 51)
    assert np.allclose(np.diff(good, prepend=0), np.round(np.diff(good, prepend=0)))


def test_learning_robots_score_more_than_those_without_memory():
    early, late = (
        {kind: np.mean([list(scores(kind, seed, count))[-1] for seed in range(60)]) for kind in CLASSES}
        for count in (10, 100)
    )

    assert early["Alpha"] == pytest.approx(late["Alpha"], abs=0.06)
    assert late["Beta"] > late["Alpha"] + 0.25
    assert late["Gamma"] > late["Alpha"] + 0.25


def test_study_with_own_worlds_is_compared_as_fleets(tmp_path, capsys):
    plan = tmp_path / "a.toml"
    few = "robots = [2]\nown_worlds = true\nseeds = 2\nenvironments = 1\nlimit_s = 5\n"
    plan.write_text(f'profiles = ["fixed"]\n{few}')

    assert main(["study", str(plan), "--out", str(tmp_path / "out")]) == 2
    assert f"use tools/octet compare {plan}" in capsys.readouterr().err
    assert main(["compare", str(plan)]) == 0
    said = capsys.readouterr().out
    assert "a: 2 seeds of 1 environment each" in said
    assert "used      seeds 1..4 for choosing: everything" in said


@pytest.fixture(scope="module")
def trial(tmp_path_factory: pytest.TempPathFactory) -> Trial:
    folder = tmp_path_factory.mktemp("options")
    trial = Trial(folder)
    assert octet("study", folder / "plan.toml", "--jobs", "1", "--out", folder / "studied").returncode == 0
    return trial


@pytest.mark.parametrize(("command", "name"), tried(*LAB))
def test_option_has_the_effect_in_its_row(command, name, trial):
    trial.check(command, name)
