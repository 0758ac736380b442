"""`tools/octet tune`: it finds what is better, not what touches things, and goes on where it was stopped."""

import json
from dataclasses import replace

import numpy as np
import pytest

from host_sim.base.errors import UsageError
from host_sim.cli.main import main
from host_sim.lab.study import tune_command
from host_sim.lab.study.folder import read_used
from host_sim.lab.study.tuning import Piece, Search, SearchTask, run_pieces, samples_of
from host_sim.sim.run_config import RunConfig
from tests.lab.study.support import row, run, samples

CONFIG = RunConfig(seed=1, environments=1)
NAMES = ("turn_deg", "step_mm")


def made_up(piece, robot_s, bumped=0.0):
    """What came of a piece if its robots took these times."""
    (sample,) = samples(*(run("", seed, row()) for seed in range(piece.seeds)))
    return replace(sample, robot_s=robot_s, bumped=np.full(robot_s.shape, bumped))


class World:
    """The nearer turn_deg is to 40, the sooner a robot is done; with long steps it touches things."""

    def __init__(self) -> None:
        self.runs = 0

    def __call__(self, pieces):
        self.runs += len(pieces)
        for piece in pieces:
            settings, shape = piece.config.settings, (piece.seeds, 1)
            luck = np.random.default_rng(piece.config.seed).normal(0.0, 2.0, shape)
            step_mm = settings.get("step_mm", 12)
            robot_s = 100.0 + abs(settings.get("turn_deg", 10) - 40) - step_mm / 10 + luck
            yield [(piece, made_up(piece, robot_s, float(step_mm > 50)))]


def search(notes, run, seeds=12):
    return Search(SearchTask(CONFIG, "time", NAMES, seeds), run, notes)


def test_tuning_finds_better_settings_without_touches(tmp_path):
    one = search(tmp_path / "notes.jsonl", World())
    one.go(120, lambda _: None)

    found = dict(one.best)
    assert 36 <= found["turn_deg"] <= 44
    assert found.get("step_mm", 12) <= 50


def test_tuning_keeps_the_defaults_if_nothing_is_better(tmp_path):
    def same(pieces):
        for piece in pieces:
            shape = piece.seeds, 1
            worse = 10.0 * len(piece.config.settings)
            yield [(piece, made_up(piece, np.full(shape, 100.0 + worse)))]

    one = search(tmp_path / "notes.jsonl", same)
    one.go(40, lambda _: None)

    assert one.best == ()


def test_stopped_search_resumes_and_finds_the_same(tmp_path):
    whole, again = World(), World()
    one = search(tmp_path / "notes.jsonl", whole)
    one.go(60, lambda _: None)
    lines = (tmp_path / "notes.jsonl").read_text().splitlines()
    half = len(lines) // 2
    (tmp_path / "notes.jsonl").write_text("\n".join([*lines[:half], lines[half][:7]]))

    other = search(tmp_path / "notes.jsonl", again)
    other.go(60, lambda _: None)

    assert (other.best, other.seeds) == (one.best, one.seeds)
    assert 0 < again.runs < whole.runs


def test_search_extended_from_fewer_trials_finds_the_same_values(tmp_path):
    def found(notes, *trials):
        for number in trials:
            one = Search(SearchTask(CONFIG, "time", ["filter"], 12), World(), notes)
            one.go(number, lambda _: None)
        return (tmp_path / notes).read_text().splitlines()

    def values(lines):
        return {tuple(map(str, key)): value for *key, value in map(json.loads, lines[1:])}

    apart, together = values(found(tmp_path / "b", 40)), values(found(tmp_path / "a", 8, 40))

    assert apart == {key: together[key] for key in apart}


def test_empty_file_of_notes_is_refused(tmp_path):
    (tmp_path / "notes.jsonl").touch()

    with pytest.raises(UsageError, match="of another search"):
        search(tmp_path / "notes.jsonl", World())


def test_notes_stay_whole_if_a_search_is_killed_while_reading(tmp_path, monkeypatch):
    notes = tmp_path / "notes.jsonl"
    search(notes, World()).go(20, lambda _: None)
    before = notes.read_bytes()

    def killed(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(json, "loads", killed)
    with pytest.raises(KeyboardInterrupt):
        search(notes, World())

    assert notes.read_bytes() == before


def test_notes_of_another_search_are_refused_and_kept(tmp_path):
    search(tmp_path / "notes.jsonl", World())
    before = (tmp_path / "notes.jsonl").read_bytes()

    with pytest.raises(UsageError, match="of another search"):
        search(tmp_path / "notes.jsonl", World(), seeds=13)

    assert (tmp_path / "notes.jsonl").read_bytes() == before


def test_sample_equals_what_its_robots_do_alone():
    config = RunConfig(environments=1, limit_s=30)
    (sample,) = samples_of(config, [(("turn_deg", 20),)], 5, 30, lambda pieces: [run_pieces(pieces)])

    ((_, alone),) = run_pieces([Piece(RunConfig(seed=33, environments=1, limit_s=30, settings={"turn_deg": 20}), 1)])
    assert sample.seeds.tolist() == list(range(5, 35))
    assert sample.robot_s[28, 0] == alone.robot_s[0, 0]


def test_tune_prints_what_it_found_and_run_takes_a_file_of_settings(tmp_path, capsys):
    few = ["--only", "turn_deg", "--environments", "1", "--limit-s", "40", "--trials", "8", "--seeds", "4"]
    words = ["tune", *few, "--held-out", "4", "--set", "step_mm=12", "--out", str(tmp_path), "--jobs", "1"]
    assert main(words) == 0

    said = capsys.readouterr().out
    assert said.startswith("searched  1 parameters of article on seeds 1..")
    preset = tmp_path / "article.txt"
    if "nothing better" not in said:
        assert "held out  seeds 5000001..5000004" in said
        assert preset.read_text().splitlines()[1].startswith("turn_deg=")
    preset.write_text("# by hand\nturn_deg=20  # wider\nstep_mm=15\n")

    def log_of(*words: str) -> str:
        short = ["run", "--environments", "1", "--limit-s", "5", "--bus", "none", "--quiet"]
        assert main([*short, "--out", str(tmp_path / "run"), *words]) == 0
        return str(json.loads((tmp_path / "run/summary.json").read_text())["log_sha256"])

    last_wins = log_of("--set", f"@{preset}", "--set", "step_mm=16")
    assert last_wins == log_of("--set", "turn_deg=20", "--set", "step_mm=16") != log_of("--set", f"@{preset}")


def test_only_tune_and_one_example_use_the_held_out_seeds():
    uses = [it.what for it in read_used() if it.last >= tune_command.HELD_OUT]

    assert uses == [
        "the settings that tools/octet tune finds, and those of wall_follower.c",
        "wall_follower.c: learning.md",
    ]


def test_held_out_seeds_begin_after_those_of_the_search(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(tune_command, "HELD_OUT", 5)
    monkeypatch.setattr(Search, "go", lambda search, *_: vars(search).update(best=(("turn_deg", 20),), _next=41))
    few = ["--environments", "1", "--limit-s", "5", "--held-out", "3", "--out", str(tmp_path), "--jobs", "1"]

    assert main(["tune", "--only", "turn_deg", "turn_deg", *few]) == 0

    said = capsys.readouterr().out
    assert "searched  1 parameters of article on seeds 1..40" in said
    assert "held out  seeds 41..43" in said


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--only", "turn_deg", "--set", "turn_deg=3"], "nothing to tune"),
        (["--profile", "genius"], "genius"),
        (["--set", "@nowhere.txt"], "cannot read nowhere.txt: there is no such file"),
        (["--set", "turn_deg=999"], "from 1 to 180"),
        (["--held-out", "1"], "--held-out"),
        (["--trials", "3"], "--trials"),
    ],
)
def test_wrong_usage_is_reported_in_one_line(tmp_path, capsys, words, said):
    assert main(["tune", "--out", str(tmp_path / "out"), *words]) == 2

    error = capsys.readouterr().err
    assert said in error
    assert error.count("\n") == 1


def test_mistake_in_a_file_of_settings_is_reported_with_its_line(tmp_path, capsys):
    (tmp_path / "a.txt").write_text("turn_deg=20\n\nturn=3\n")

    assert main(["run", "--set", f"@{tmp_path}/a.txt", "--out", str(tmp_path / "run")]) == 2

    assert f"{tmp_path}/a.txt:3: unknown parameter 'turn'" in capsys.readouterr().err
