"""The atlas of all memories: the search that makes it, against each memory's own run and against other behaviours."""

import csv
import re
from concurrent.futures import Future
from dataclasses import replace

import numpy as np
import pytest

from host_sim.base.errors import UsageError
from host_sim.base.paths import ROOT
from host_sim.cli.main import main
from host_sim.lab.study import workers
from host_sim.lab.study.atlas import FOLDER, MEMORIES, Maps, SeedMap, map_of
from host_sim.lab.study.atlas_report import CELLS, NAMED, alike, explained, turned_over
from host_sim.lab.study.plan import read_plan
from host_sim.lab.study.trial import Trial
from host_sim.sim.fleet import Frozen, run_fleet
from host_sim.sim.run_config import RunConfig

SHORT = RunConfig(profile="article", seed=5, environments=1, limit_s=40.0, world="small")
PLAN = """
memories = "all"
profiles = ["article"]
worlds = ["small"]
seeds = {}
environments = 1
limit_s = 40
judged_on = [101, 104]
"""


@pytest.mark.parametrize("config", [SHORT, replace(SHORT, body="kit", seed=9)])
def test_the_search_finds_what_each_memory_does_in_a_run_of_its_own(config):
    found = map_of(Trial(config)).values[::9]

    frozen = [Frozen(config.seed, memory) for memory in MEMORIES[::9]]
    alone = sorted(run_fleet(config, frozen=frozen), key=lambda it: it.robot)
    assert found[:, :2].tolist() == [[it.ticks, it.finished] for it in alone]
    assert len(np.unique(found[:, 0])) > 3


def test_the_programmed_memory_does_what_the_programmed_robot_does():
    """The judge is another behaviour, which learns nothing by itself."""
    config = replace(SHORT, robots=5, worlds="own", limit_s=100.0)
    frozen = [Frozen(config.seed + i, NAMED["programmed"]) for i in range(5)]

    programmed, ours = run_fleet(replace(config, profile="fixed")), run_fleet(config, frozen=frozen)
    assert {(it.seed, it.ticks, it.pose) for it in ours} == {(it.seed, it.ticks, it.pose) for it in programmed}


def test_a_robot_that_learns_no_more_keeps_its_memory():
    results = list(run_fleet(replace(SHORT, limit_s=100.0), frozen=[Frozen(4, (0,) * 8), Frozen(5, (0, 2) * 4)]))

    assert {it.robot: it.memory for it in results} == {1: (0,) * 8, 2: (0, 2) * 4}
    assert all(it.contacts.number for it in results)


def test_behind_a_mirrored_ring_the_map_is_turned_over():
    usual, mirrored = (map_of(Trial(replace(SHORT, changes=changes))) for changes in ((), ("mirror@0s",)))

    assert (mirrored.values[:, 0] == turned_over(usual.values[:, 0])).all()
    assert (mirrored.values != usual.values).any()


def test_cells_that_decide_the_time_explain_its_variance():
    cells = np.array(MEMORIES)
    means = 100.0 + 10 * cells[:, 1] + 5 * (cells[:, 4] == 2) * cells[:, 1]

    shares = {words: float(explained(means, of)) for words, of in CELLS.items()}
    assert shares["cells 1 and 4"] == pytest.approx(1)
    assert 0 < shares["cell 4"] < shares["cell 1"] < 1
    assert shares["cells 5 and 7"] == pytest.approx(0)
    assert alike(means, 3 * means) == pytest.approx(1)


class _Here:
    """An executor in this process."""

    def __init__(self, *_: object, **__: object) -> None:
        pass

    def submit(self, work, items):
        done: Future = Future()
        done.set_result(work(items))
        return done

    def shutdown(self, **_: object) -> None:
        pass


@pytest.fixture
def study(tmp_path, monkeypatch):
    """Makes a study of so many seeds, and says what it printed."""
    monkeypatch.setattr("host_sim.lab.workers.ProcessPoolExecutor", _Here)

    def make(seeds: int, *more: str) -> int:
        (tmp_path / "a.toml").write_text(PLAN.format(seeds))
        return main(["study", str(tmp_path / "a.toml"), "--out", str(tmp_path / "out"), "--jobs", "1", *more])

    return make


def test_a_study_that_was_stopped_goes_on(study, tmp_path, monkeypatch, capsys):
    made: list[int] = []

    def watched(trial: Trial) -> SeedMap:
        made.append(trial.config.seed)
        return map_of(trial)

    monkeypatch.setattr(workers, "map_of", watched)
    assert study(2) == 0
    assert study(3) == 0

    assert made == [1, 2, 3]
    out = capsys.readouterr().out
    assert "(1 runs, 2 existed already)" in out
    assert "seeds 1..3" in out
    assert "memories on seeds 101..104:" in out
    assert "cells 1 and 4" in out
    with (tmp_path / "out/map.csv").open(newline="") as file:
        rows = {row["memory"]: row for row in csv.DictReader(file)}
    ticks = Maps(tmp_path / "out").atlas("article", [1, 2, 3]).mean_s
    assert len(rows) == 2187
    assert float(rows["01112121"]["mean_s"]) == pytest.approx(ticks[MEMORIES.index(NAMED["programmed"])], abs=0.06)
    assert (tmp_path / "out/map.png").read_bytes().startswith(b"\x89PNG")


def test_its_tables_and_pictures_go_into_the_document(study, tmp_path):
    docs = tmp_path / "docs"
    docs.mkdir()
    (docs / "learning.md").write_text(
        "[?](tables/a-cells.csv#cells+1+and+4,explained) [?](tables/a.csv#learned,mean_s_compared)\n"
    )

    assert study(2, "--docs", str(docs)) == 0
    assert re.match(r"\[\d+ %\]\S+ \[\d\.\d\d\]", (docs / "learning.md").read_text())
    assert {it.name for it in docs.rglob("a*.*")} == {"a.csv", "a-cells.csv", "a-map.csv", "a-map.png"}


def test_a_map_that_is_damaged_is_said(study, tmp_path, capsys):
    assert study(1) == 0
    (part,) = (tmp_path / "out" / FOLDER).iterdir()
    part.write_bytes(part.read_bytes()[:100])

    assert study(1) == 2
    assert f"cannot read the maps in {part}" in capsys.readouterr().err


def test_an_atlas_is_not_compared(study, tmp_path, capsys):
    assert study(1) == 0

    for what in ("out", "a.toml"):
        assert main(["compare", str(tmp_path / what)]) == 2
        assert "an atlas is not compared" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("environments = 2", ":1: an atlas of all memories has profiles"),
        ('memories = "some"', ':1: memories are "all"'),
        ("goals = []", ":4: goals are not in an atlas"),
        ("judged_on = [3, 2]", ":4: judged_on is the first and the last of some seeds"),
        ("judged_on = [50, 200]", ":4: the study's seeds 1..100 are not held out: something is judged on 50..200"),
    ],
)
def test_what_an_atlas_cannot_have_is_said(tmp_path, text, said):
    given = {"memories": '"all"', "profiles": '["article"]', "environments": "1"}
    given |= [text.split(" = ")]
    (tmp_path / "a.toml").write_text("".join(f"{key} = {value}\n" for key, value in given.items()))

    with pytest.raises(UsageError, match=re.escape(said)):
        read_plan(tmp_path / "a.toml")


def test_seeds_to_judge_on_are_for_an_atlas_only(tmp_path):
    (tmp_path / "a.toml").write_text('profiles = ["article"]\njudged_on = [200, 300]\n')

    with pytest.raises(UsageError, match='2: judged_on needs memories = "all"'):
        read_plan(tmp_path / "a.toml")


def test_the_page_has_the_tables_of_its_study_and_names_the_best_memory():
    page = (ROOT / "docs/learning.md").read_text()
    with (ROOT / "docs/tables/atlas-map.csv").open(newline="") as file:
        means = {row["memory"]: float(row["mean_s"]) for row in csv.DictReader(file)}

    with (ROOT / "docs/tables/atlas.csv").open(newline="") as file:
        judged = dict.fromkeys(row["condition"] for row in csv.DictReader(file))
    with (ROOT / "docs/tables/atlas-cells.csv").open(newline="") as file:
        cells = [row["condition"] for row in csv.DictReader(file)]
    assert [*judged] == [*NAMED, "best", "learned"]
    assert cells == [*CELLS]
    assert len(means) == len(MEMORIES)
    assert f"`{min(means, key=means.__getitem__)}`" in page
