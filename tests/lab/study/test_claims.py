"""What the article claims, measured: the table of docs/article.md, and what it is computed from."""

import re
from dataclasses import replace

import numpy as np
import pytest

from host_sim.base.paths import ROOT
from host_sim.lab.study.claims import STUDY, Life, erased, life_of, measured, symmetric_rows, table_of
from host_sim.lab.study.plan import read_plan
from host_sim.protocol.generated import Reason, Side
from host_sim.sim.fleet import run_fleet
from host_sim.world.memory_kinds import sides_of

ROW = re.compile(r"^\| (.+) \| ([\d.]+)(?: %)? \(([\d.]+)\.\.([\d.]+)(?: %)?\) \|$", re.MULTILINE)
PAGE = (ROOT / "docs/article.md").read_text()


@pytest.fixture(scope="module")
def lives():
    return measured(replace(read_plan(STUDY), first_seed=2_100_001, seeds=30), 2)


def test_a_life_agrees_with_the_fleet_about_trials_meals_and_memories():
    """The judge is the fleet, which counts in C."""
    (trial, *_) = read_plan(STUDY).conditions
    config = replace(trial.config, seed=7, environments=3)
    life = life_of(replace(trial, config=config))

    fleet = list(run_fleet(replace(config, robots=1, worlds="own")))
    assert life.memories == [sides_of(it.memory) for it in fleet]
    assert len(life.tried) == sum(it.begun.get(Reason.TRIAL, 0) for it in fleet)
    assert [len(meals) for meals in life.meals] == [it.food_eaten for it in fleet]


def test_what_is_kept_was_tried_last(lives):
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
def test_the_listing_erases_by_the_place_of_the_robot(x_mm, plot):
    assert erased(x_mm) == plot


def test_the_page_has_the_rows_of_the_command_and_few_seeds_agree(lives):
    """Thirty seeds say the same within twice their interval and a point."""
    page = {name: [float(it) for it in numbers] for name, *numbers in ROW.findall(PAGE)}
    few = {name: [float(it) for it in numbers] for name, *numbers in ROW.findall(table_of(lives))}

    assert page.keys() == few.keys()
    assert len(page) >= 25
    for name, (value, _, _) in page.items():
        _, low, high = few[name]
        assert low - (high - low) / 2 - 1 <= value <= high + (high - low) / 2 + 1, name
    assert np.isfinite([*page.values()]).all()
