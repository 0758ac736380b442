"""The atlas of all memories: the search that makes it, against each memory's own run and against other behaviours.

The explorer of docs/learning.md: what it sees, against the world's own rule; what it takes, by hand.
"""

import csv
import math
import re
from concurrent.futures import Future
from dataclasses import replace

import numpy as np
import pytest

from host_sim.base.errors import UsageError
from host_sim.base.paths import ROOT
from host_sim.cli.main import main
from host_sim.lab.study.atlas import FOLDER, MEMORIES, Maps, SeedMap, map_of
from host_sim.lab.study.atlas_report import CELLS, NAMED, correlation, explained, mirrored
from host_sim.lab.study.explorer import Explorer, Room, samples_of, sees, table_of
from host_sim.lab.study.plan import read_plan
from host_sim.lab.study.trial import Trial
from host_sim.sim.fleet import Frozen, run_fleet
from host_sim.sim.run_config import RunConfig
from host_sim.world.arena import Arena
from host_sim.world.geometry import Bar, Pose, SimParams
from host_sim.world.layouts import Layout
from host_sim.world.worlds import world_of

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
def test_map_equals_separate_runs_with_each_memory(config):
    found = map_of(Trial(config)).values[::9]

    frozen = [Frozen(config.seed, memory) for memory in MEMORIES[::9]]
    alone = sorted(run_fleet(config, frozen=frozen), key=lambda it: it.robot)
    assert found[:, :2].tolist() == [[it.ticks, it.finished] for it in alone]
    assert len(np.unique(found[:, 0])) > 3


def test_frozen_programmed_memory_behaves_as_profile_fixed():
    """The judge is another behaviour, which learns nothing by itself."""
    config = replace(SHORT, robots=5, worlds="own", limit_s=100.0)
    frozen = [Frozen(config.seed + i, NAMED["programmed"]) for i in range(5)]

    programmed, ours = run_fleet(replace(config, profile="fixed")), run_fleet(config, frozen=frozen)
    assert {(it.seed, it.ticks, it.pose) for it in ours} == {(it.seed, it.ticks, it.pose) for it in programmed}


def test_frozen_robot_keeps_its_memory():
    results = list(run_fleet(replace(SHORT, limit_s=100.0), frozen=[Frozen(4, (0,) * 8), Frozen(5, (0, 2) * 4)]))

    assert {it.robot: it.memory for it in results} == {1: (0,) * 8, 2: (0, 2) * 4}
    assert all(it.contacts.number for it in results)


def test_mirrored_ring_mirrors_the_map():
    usual, with_mirror = (map_of(Trial(replace(SHORT, changes=changes))) for changes in ((), ("mirror@0s",)))

    assert (with_mirror.values[:, 0] == mirrored(usual.values[:, 0])).all()
    assert (with_mirror.values != usual.values).any()


def test_cells_that_decide_the_time_explain_its_variance():
    cells = np.array(MEMORIES)
    means = 100.0 + 10 * cells[:, 1] + 5 * (cells[:, 4] == 2) * cells[:, 1]

    shares = {words: float(explained(means, of)) for words, of in CELLS.items()}
    assert shares["cells 1 and 4"] == pytest.approx(1)
    assert 0 < shares["cell 4"] < shares["cell 1"] < 1
    assert shares["cells 5 and 7"] == pytest.approx(0)
    assert correlation(means, 3 * means) == pytest.approx(1)


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


def test_atlas_resumes_and_adds_seeds(study, tmp_path, monkeypatch, capsys):
    made: list[int] = []

    def watched(trial: Trial) -> SeedMap:
        made.append(trial.config.seed)
        return map_of(trial)

    monkeypatch.setattr("host_sim.lab.study.atlas.map_of", watched)
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


def test_atlas_writes_its_tables_and_pictures_into_the_document(study, tmp_path):
    docs = tmp_path / "docs"
    docs.mkdir()
    (docs / "learning.md").write_text(
        "[?](tables/a-cells.csv#cells+1+and+4,explained) [?](tables/a.csv#learned,mean_s_compared)\n"
    )

    assert study(2, "--docs", str(docs)) == 0
    assert re.match(r"\[\d+ %\]\S+ \[\d\.\d\d\]", (docs / "learning.md").read_text())
    assert {it.name for it in docs.rglob("a*.*")} == {"a.csv", "a-cells.csv", "a-map.csv", "a-map.png"}


def test_conditions_of_an_atlas_have_their_own_columns_and_comparisons(study, tmp_path, monkeypatch):
    docs = tmp_path / "docs"
    docs.mkdir()
    (docs / "learning.md").write_text(
        "[?](tables/a.csv#kit+learned,mean_s_compared) [?](tables/a-cells.csv#kit,alike)\n"
    )
    monkeypatch.setattr(f"{__name__}.PLAN", PLAN + 'bodies = ["ideal", "kit"]\n')

    assert study(2, "--docs", str(docs)) == 0
    with (docs / "tables/a-map.csv").open(newline="") as file:
        columns = next(csv.reader(file))
    with (docs / "tables/a.csv").open(newline="") as file:
        rows = {(row["condition"], row["figure"]): float(row["value"]) for row in csv.DictReader(file)}
    ratio = rows["kit learned", "mean_s"] / rows["kit programmed", "mean_s"]
    assert [it for it in columns if "mean_s" in it] == ["ideal mean_s", "kit mean_s"]
    assert rows["kit learned", "mean_s_compared"] == pytest.approx(ratio, rel=1e-4)
    assert (docs / "images/a-map.png").exists()


def test_damaged_map_is_reported(study, tmp_path, capsys):
    assert study(1) == 0
    (part,) = (tmp_path / "out" / FOLDER).iterdir()
    part.write_bytes(part.read_bytes()[:100])

    assert study(1) == 2
    assert f"cannot read the maps in {part}" in capsys.readouterr().err


def test_compare_refuses_an_atlas(study, tmp_path, capsys):
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
def test_unsupported_atlas_option_is_reported(tmp_path, text, said):
    given = {"memories": '"all"', "profiles": '["article"]', "environments": "1"}
    given |= [text.split(" = ")]
    (tmp_path / "a.toml").write_text("".join(f"{key} = {value}\n" for key, value in given.items()))

    with pytest.raises(UsageError, match=re.escape(said)):
        read_plan(tmp_path / "a.toml")


def test_judged_on_is_refused_without_an_atlas(tmp_path):
    (tmp_path / "a.toml").write_text('profiles = ["article"]\njudged_on = [200, 300]\n')

    with pytest.raises(UsageError, match='2: judged_on needs memories = "all"'):
        read_plan(tmp_path / "a.toml")


def table(name: str) -> list[dict[str, str]]:
    """The rows of a table of the documentation."""
    with (ROOT / f"docs/tables/{name}.csv").open(newline="") as file:
        return [*csv.DictReader(file)]


@pytest.mark.parametrize(
    ("name", "conditions"),
    [("atlas", [""]), ("atlas_worlds", ["random ", "corridors "]), ("atlas_bodies", ["ideal ", "kit "])],
)
def test_learning_page_has_the_atlas_tables_and_the_best_memory(name, conditions):
    page = (ROOT / "docs/learning.md").read_text()

    assert [*dict.fromkeys(row["condition"] for row in table(name))] == [
        f"{it}{words}" for it in conditions for words in [*NAMED, "best", "learned"]
    ]
    explained = [row["condition"] for row in table(f"{name}-cells") if row["figure"] == "explained"]
    assert explained == [f"{it}{words}" for it in conditions for words in CELLS]
    means = {row["memory"]: float(row[f"{conditions[-1]}mean_s"]) for row in table(f"{name}-map")}
    assert len(means) == len(MEMORIES)
    assert f"`{min(means, key=means.__getitem__)}`" in page


EMPTY = Layout((), ((500.0, 1500.0), (2000.0, 1500.0), (3500.0, 1500.0)), Pose(1000.0, 1500.0, 0.0))
WALL = Layout((Bar((1500.0, 0.0), (1500.0, 2400.0)),), ((2000.0, 1500.0),), Pose(1000.0, 1500.0, 0.0))


def test_explorer_sees_food_where_a_robot_looking_there_does():
    world, seen = world_of("random"), []
    for seed in range(40):
        layout = world.generate(seed, 1)
        (x, y), food = layout.start[:2], layout.food[0]
        pose = Pose(x, y, math.atan2(food[1] - y, food[0] - x))
        told = Arena(Layout(layout.bars, (food,), pose), world.params).body.sense(0).look
        (ours,) = sees(np.array([[x, y]]), np.array([food]), layout.bars, world.params.bar_thickness_mm / 2)[0]
        assert ours == told, seed
        seen.append(told)
    assert {*seen} == {False, True}


@pytest.mark.parametrize(
    ("turns", "way_mm", "turned_s"),
    [
        (False, 3500, 0),  # 500 mm back, 1,500 and 1,500 mm on: to the nearest first
        (True, 5500, 1),  # 1,000 and 1,500 mm on, to what it sees first; half a turn at 180 degrees/s, 3,000 mm back
    ],
)
def test_explorer_takes_straight_ways_at_200_mm_s_less_its_reach(turns, way_mm, turned_s):
    finish_s = Explorer(Room(EMPTY, SimParams()), turns=turns).finish_s()

    assert finish_s == pytest.approx((way_mm - 3 * 150) / 200 + turned_s)


def test_explorer_takes_longer_for_food_behind_a_wall():
    one = SimParams(food_bands_mm=((0.0, 4000.0),))
    room = Room(WALL, one)

    assert not room.seen(np.array([WALL.start[:2]]), np.array(WALL.food)).any()
    seeing, turning = (Explorer(room, turns=turns).finish_s() for turns in (False, True))
    straight_s = (1000 - 150) / 200
    assert straight_s + 1 < seeing < turning


def numbers_of(text: str) -> dict[str, list[float]]:
    """The numbers of the table's rows by their names."""
    rows = re.findall(r"^\| ([^|]+) \| (\d+ s \([^|]+) \| ([^|]+) \|$", text, re.MULTILINE)
    return {name: [float(it) for it in re.findall(r"\d+(?:\.\d+)?", mean + " " + part)] for name, mean, part in rows}


def test_learning_page_has_the_explorer_s_rows_and_few_seeds_agree():
    page = numbers_of((ROOT / "docs/learning.md").read_text())
    few = numbers_of(table_of(samples_of(6)))

    assert len(few) == 5
    assert {*few} <= {*page}
    for name in ("shortest tour", "explorer that sees all around", "explorer that turns to look"):
        assert few[name][0] == pytest.approx(page[name][0], abs=3), name
    for means in (few, page):
        order = [means[it][0] for it in ("shortest tour", "explorer that turns to look", "`searcher`", "`article`")]
        assert order == sorted(order)
