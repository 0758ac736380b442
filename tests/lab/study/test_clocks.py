"""The learner as a Markov chain: the table of docs/learning.md, and what it is computed from."""

import re

import pytest

from host_sim.base.paths import ROOT
from host_sim.lab.study.claims import Life, measured
from host_sim.lab.study.clocks import HEADINGS, clocks_of, first_helped, left_of, plan_of, table_of
from host_sim.protocol.generated import Side

NOT_MEMORYLESS = ("5", "7")
"""Where a trial has failed the next is made at the same place: their first trials help more often than the rest."""

NUMBER = re.compile(r"\d+(?:\.\d+)?")
L, R = Side.LEFT, Side.RIGHT


def life(*tried: tuple[int, Side], **cells: Side) -> Life:
    return Life([*tried], [tuple(cells.get(f"cell{i}", Side.NOTHING) for i in range(8))], [True], [[]])


def test_a_clock_is_the_part_of_the_trials_to_its_side_that_helped():
    lives = [life((2, L), (2, R), (2, L), cell2=L), life((2, R), (3, L), cell3=L), life((2, L), (2, R), cell2=R)]

    clocks = clocks_of(lives, 2)
    assert clocks.left == pytest.approx(1 / 3)
    assert clocks.right == pytest.approx(1 / 3)
    assert clocks.left_wins == pytest.approx(0.5)
    assert clocks.first_helps == pytest.approx(1 / 3)
    assert left_of(lives, 2) == [True, False]
    assert first_helped(lives, 2) == [False, False, False]
    assert first_helped(lives, 3) == [True]


def test_a_side_that_was_never_tried_never_helps():
    assert clocks_of([life((1, L), cell1=L)], 1) == (1, 0)


@pytest.fixture(scope="module")
def few():
    """Fifty robots that tell, and fifty others, on the first of the page's seeds."""
    (lives,) = measured(plan_of(50), 2)
    return lives


def cells_of(text: str) -> dict[str, list[list[float]]]:
    """The rows of a table by their cell."""
    rows = [[it.strip() for it in line.strip("|").split("|")] for line in text.splitlines() if line.startswith("| ")]
    return {
        row[0]: [[float(it) for it in NUMBER.findall(cell)] for cell in row[1:]] for row in rows if row[0].isdigit()
    }


def test_the_page_has_the_rows_of_the_command_and_few_seeds_agree(few):
    page = (ROOT / "docs/learning.md").read_text().partition("| " + " | ".join(HEADINGS))[2].partition("\n\n")[0]

    theirs, ours = cells_of(page), cells_of(table_of(few[:50], few[50:]))
    assert [*theirs] == [*ours] == [str(cell) for cell in range(1, 8)]
    for cell, row in theirs.items():
        for (value, *_), (_, low, high) in zip((row[3], row[5]), (ours[cell][3], ours[cell][5]), strict=True):
            assert low - (high - low) / 2 - 1 <= value <= high + (high - low) / 2 + 1, cell


def test_the_predictions_of_the_page_are_near_what_others_did():
    """The chain is right about those that it was not made of; both halves are as large."""
    page = (ROOT / "docs/learning.md").read_text().partition("| " + " | ".join(HEADINGS))[2].partition("\n\n")[0]

    for cell, row in cells_of(page).items():
        for (predicted,), (value, low, high) in ((row[2], row[3]), (row[4], row[5])):
            if cell not in NOT_MEMORYLESS or predicted == row[2][0]:
                assert abs(predicted - value) <= 2**0.5 * (high - low) / 2 + 0.1, cell
