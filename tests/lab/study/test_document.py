"""docs/learning.md: each number in it is that of its table, and its study makes all of it anew.

What the article claims, measured: the table of docs/article.md, and what it is computed from.
"""

import csv
import importlib
import re
import shlex
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from host_sim.base.errors import OctetError
from host_sim.cli.main import main
from host_sim.cli.parsing import Parser
from host_sim.lab.study.claims import STUDY, Life, erased, life_of, measured, symmetric_rows, table_of
from host_sim.lab.study.document import fill, write_table
from host_sim.lab.study.plan import read_plan
from host_sim.protocol.generated import Reason, Side
from host_sim.sim.fleet import run_fleet
from host_sim.world.memory_kinds import sides_of
from tests.lab.study.support import row, run, samples

ROOT = Path(__file__).resolve().parents[3]
LEARNING = ROOT / "docs/learning.md"
MEASURED = re.compile(r"\d[\d.,]*\s?(?:%|s\b|contacts|episodes|times)")
NOT_PROSE = re.compile(r"```.*?```|`[^`]*`|!?\[[^\]]*\]\([^)]*\)|^\|.*?$|<!--.*?-->", re.DOTALL | re.MULTILINE)


def test_numbers_of_the_learning_page_equal_their_tables():
    text = LEARNING.read_text()

    assert fill(text, LEARNING.parent) == text, "make it anew: tools/octet study studies/NAME.toml --docs docs"


def test_measured_numbers_of_the_learning_page_come_from_tables():
    assert MEASURED.findall(NOT_PROSE.sub("", LEARNING.read_text())) == []


def test_by_hand_commands_of_the_learning_page_parse():
    blocks = re.findall(r"^```sh by-hand\n(.*?)^```$", LEARNING.read_text(), re.DOTALL | re.MULTILINE)
    every = [shlex.split(line) for block in blocks for line in block.splitlines()]
    lines = [words for program, *words in every if program == "tools/octet"]

    assert len(lines) >= 5
    for words in lines:
        parser = Parser()
        importlib.import_module(f"host_sim.lab.study.{words[0]}_command").add(parser.add_subparsers())
        assert parser.parse_args(words).command


@pytest.fixture
def docs(tmp_path) -> Path:
    """A folder with a table of two conditions."""
    many = [run("a", seed, row(100.0 + seed)) for seed in range(5)] + [
        run("b c", seed, row(50.0)) for seed in range(5)
    ]
    write_table(samples(*many), tmp_path / "tables/t.csv")
    return tmp_path


@pytest.mark.parametrize(
    ("text", "filled"),
    [
        ("[?](tables/t.csv#a,mean_s)", "[102 s](tables/t.csv#a,mean_s)"),
        ("[3 s](tables/t.csv#b+c,median_s)", "[50 s](tables/t.csv#b+c,median_s)"),
        ("[](tables/t.csv#b+c,mean_s_compared)", "[0.49](tables/t.csv#b+c,mean_s_compared)"),
        ("[](tables/t.csv#a,mean_s,interval)", "[101..103 s](tables/t.csv#a,mean_s,interval)"),
        ("[a](b.md)", "[a](b.md)"),
        (
            "<!-- table t.csv: mean_s finished -->\n| old |\n\nnext",
            "<!-- table t.csv: mean_s finished -->\n|  | mean | finished |\n|---|---|---|\n"
            "| `a` | 102 s (101..103) | 100.0 % (56.6..100.0) |\n"
            "| `b c` | 50 s (50..50) | 100.0 % (56.6..100.0) |\n\nnext",
        ),
    ],
)
def test_fill_replaces_numbers_by_those_of_their_tables(docs, text, filled):
    assert fill(text, docs) == filled
    assert fill(filled, docs) == filled


def test_fill_reports_a_missing_number_or_table(docs):
    with pytest.raises(OctetError, match="has no figure mean_s of x"):
        fill("[1](tables/t.csv#x,mean_s)", docs)
    with pytest.raises(OctetError, match=r"cannot read the table .*/u\.csv"):
        fill("[1](tables/u.csv#x,mean_s)", docs)


def test_study_with_docs_writes_tables_plots_and_numbers(tmp_path):
    studies, docs = tmp_path / "studies", tmp_path / "docs"
    for folder in (studies, docs):
        folder.mkdir()
    few = 'profiles = ["fixed"]\nplots = ["score"]\nseeds = 2\nenvironments = 1\nlimit_s = 20\n'
    (studies / "score.toml").write_text(few)
    (docs / "learning.md").write_text("[?](tables/score.csv#fixed,finished)\n")

    words = ["--docs", str(docs), "--out", str(tmp_path / "out"), "--jobs", "1"]
    assert main(["study", str(studies / "score.toml"), *words]) == 0

    assert re.match(r"\[\d+\.\d %\]", (docs / "learning.md").read_text())
    assert (docs / "images/score-score.png").exists()


def test_folder_without_the_document_is_reported(tmp_path, capsys):
    assert main(["study", str(ROOT / "studies/score.toml"), "--docs", str(tmp_path)]) == 2

    assert f"there is no {tmp_path / 'learning.md'}" in capsys.readouterr().err


def test_tables_of_the_page_have_the_conditions_of_their_studies():
    """What a study's file says now is what its table was made of, condition by condition."""
    tables = {*re.findall(r"tables/([\w-]+)\.csv", LEARNING.read_text())}

    assert len(tables) >= 5
    for name in {it for it in tables if not it.startswith("atlas")}:  # test_atlas.py has those
        with (ROOT / f"docs/tables/{name}.csv").open(newline="") as file:
            conditions = dict.fromkeys(line["condition"] for line in csv.DictReader(file))
        assert [*conditions] == [it.condition for it in read_plan(ROOT / f"studies/{name}.toml").conditions], name


ROW = re.compile(r"^\| (.+) \| ([\d.]+)(?: %)? \(([\d.]+)\.\.([\d.]+)(?: %)?\) \|$", re.MULTILINE)
PAGE = (ROOT / "docs/article.md").read_text()


@pytest.fixture(scope="module")
def lives():
    return measured(replace(read_plan(STUDY), first_seed=2_100_001, seeds=30), 2)


def test_life_agrees_with_the_fleet_about_trials_meals_and_memories():
    """The judge is the fleet, which counts in C."""
    (trial, *_) = read_plan(STUDY).conditions
    config = replace(trial.config, seed=7, environments=3)
    life = life_of(replace(trial, config=config))

    fleet = list(run_fleet(replace(config, robots=1, worlds="own")))
    assert life.memories == [sides_of(it.memory) for it in fleet]
    assert len(life.tried) == sum(it.begun.get(Reason.TRIAL, 0) for it in fleet)
    assert [len(meals) for meals in life.meals] == [it.food_eaten for it in fleet]


def test_kept_side_is_that_of_the_last_trial(lives):
    for life in lives[0]:
        for pattern, side in enumerate(life.memories[-1]):
            tried = [of for at, of in life.tried if at == pattern]
            assert not side or tried[-1] == side


def test_first_trials_are_counted_by_pattern():
    tried = [(2, Side.LEFT), (5, Side.RIGHT), (2, Side.RIGHT)]
    life = Life(tried, [(0, 0, Side.RIGHT, 0, 0, Side.RIGHT, 0, 0)], [True], [[]])

    rows = [(row.name, row.value) for row in symmetric_rows([life], (2, 5))]
    assert [value for name, value in rows if "first trial" in name] == [0, 100]
    assert [value for name, value in rows if "trials until" in name] == [2, 1]


@pytest.mark.parametrize(("x_mm", "plot"), [(0, 0), (999, 0), (1000, 2), (1150, 2), (1151, 1), (2749, 1), (2750, 2)])
def test_listing_erases_by_the_place_of_the_robot(x_mm, plot):
    assert erased(x_mm) == plot


def test_article_page_has_the_rows_of_claims_and_few_seeds_agree(lives):
    """Thirty seeds say the same within twice their interval and a point."""
    page = {name: [float(it) for it in numbers] for name, *numbers in ROW.findall(PAGE)}
    few = {name: [float(it) for it in numbers] for name, *numbers in ROW.findall(table_of(lives))}

    assert page.keys() == few.keys()
    assert len(page) >= 25
    for name, (value, _, _) in page.items():
        _, low, high = few[name]
        assert low - (high - low) / 2 - 1 <= value <= high + (high - low) / 2 + 1, name
    assert np.isfinite([*page.values()]).all()
