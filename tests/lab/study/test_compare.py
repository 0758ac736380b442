"""`tools/octet compare`: of studies and of profiles, and its exit code."""

import pytest

from host_sim.cli.main import main

GOAL = '[[goals]]\nfigure = "finished"\ncondition = "article"\nat_{word} = {bound}\n'
ONE = ["--seeds", "1", "--environments", "1", "--jobs", "1"]


def test_profiles_are_compared_at_once(capsys):
    assert main(["compare", "never", "five", "--set", "filter=1", *ONE]) == 0

    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "never five: 1 seed of 1 environment each"
    assert [line.split()[0] for line in lines[2:4]] == ["never", "five"]


@pytest.mark.parametrize(("word", "bound", "code"), [("least", 0, 0), ("most", -1, 1)])
def test_a_missed_goal_is_an_exit_code(tmp_path, capsys, word, bound, code):
    plan, out = tmp_path / "a.toml", str(tmp_path / "out")
    text = 'title = "Mine"\nprofiles = ["article", "never"]\nseeds = 1\nenvironments = 1\nlimit_s = 20\n'
    plan.write_text(text + GOAL.format(word=word, bound=bound))
    assert main(["study", str(plan), "--out", out, "--jobs", "1"]) == 0

    assert main(["compare", out]) == code

    printed = capsys.readouterr().out
    assert "Mine: 1 seed of 1 environment each" in printed
    assert ("MISSED" in printed) == (code == 1)


def test_a_study_without_a_title_is_called_as_its_file(tmp_path, capsys):
    (tmp_path / "mine.toml").write_text('profiles = ["fixed"]\nseeds = 1\nenvironments = 1\nlimit_s = 5\n')
    assert main(["study", str(tmp_path / "mine.toml"), "--out", str(tmp_path / "out"), "--jobs", "1"]) == 0

    assert main(["compare", str(tmp_path / "out")]) == 0

    assert "mine: 1 seed of" in capsys.readouterr().out


@pytest.mark.parametrize(
    "words",
    [
        ["genius"],
        ["artcle"],
        ["article", "--change", "gremlin@env1"],
        ["article", "--set", "filter=2"],
        [".", "--seeds", "3"],
        [".", "--set", "filter=1"],
        [".", "--jobs", "77"],
        ["."],
        [".", "article"],
        ["article", "--change", "mirror@env1", "--change", "repair@env2"],
        [],
    ],
)
def test_wrong_usage_is_one_line(capsys, words):
    assert main(["compare", *words]) == 2

    assert capsys.readouterr().err.count("\n") == 1


def test_an_option_for_profiles_is_refused_with_a_study(tmp_path, capsys):
    assert main(["compare", str(tmp_path), "--seeds", "3"]) == 2

    said = f"octet: {tmp_path} is the folder of a study: leave out --seeds, for profiles only\n"
    assert capsys.readouterr().err == said
