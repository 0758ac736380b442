"""What figures say of rows that were made up, and how far they are to be trusted."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest

from host_sim.base.paths import ROOT
from host_sim.lab.study.claims import Life, measured
from host_sim.lab.study.clocks import HEADINGS, clocks_of, first_helped, left_of, plan_of, table_of
from host_sim.lab.study.figures import FIGURES, Estimate, compare, coverage, estimate, wilson
from host_sim.lab.study.plan import Goal
from host_sim.lab.study.table import judge, table
from host_sim.protocol.generated import Side
from tests.lab.study.support import SWAPPED, contact, row, run, samples

LEFT_OF_LEFT = (0, 0, 0, 0, 1, 0, 0, 0)
"""A turn toward what is beside the robot, where its body is sound."""


def value(name: str, *runs) -> float:
    (sample,) = samples(*runs)
    return float(FIGURES[name].of(sample, np.arange(len(sample.seeds))))


FOUR = [run("a", seed, row(robot_s)) for seed, robot_s in enumerate((100.0, 200.0, 300.0, 1000.0))]


TRAPPED = (row(contacts=[contact(60.0)] * 2), row(contacts=[contact(61.0)]))
FEW, MANY = row(contacts=[contact(1.0)]), row(contacts=[contact(0.2)] * 3)
TURNS = row(contacts=[contact(turns=3), contact(turns=2, cleared=False)])
WRONG, RIGHT = row(sides=LEFT_OF_LEFT), row()
LATE = [run("a", seed, row(600.0, finished=False)) for seed in range(3)]
MEASURED = {
    "median of the run times": ("median_s", FOUR, 250),
    "mean of the run times": ("mean_s", FOUR, 400),
    "median with three unfinished of seven": ("median_s", LATE + [run("a", i, row(100.0)) for i in range(3, 7)], 100),
    "median with three unfinished of four": ("median_s", [*LATE, run("a", 3, row(100.0))], math.inf),
    "mean with three unfinished of four": ("mean_s", [*LATE, run("a", 3, row(100.0))], 475),
    "median time in shortest tours": ("by_tour", [*FOUR, run("a", 4, row(600.0, finished=False))], 15),
    "percentage of finished environments": ("finished", [run("a", 1, row(), row(finished=False))], 50),
    "mean over all contacts": ("blocked_s", [run("a", 1, FEW), run("a", 2, MANY)], 0.4),
    "trapped contact counts a minute": ("blocked_s", [run("a", 1, row(contacts=[contact(2.0), contact(500.0)]))], 31),
    "environments with a contact over a minute": ("trapped", [run("a", 1, *TRAPPED)], 50),
    "part of the turns that cleared the way": ("score", [run("a", 1, TURNS)], 0.2),
    "known in the last environment": ("wrong", [run("a", 1, WRONG, RIGHT), run("a", 2, RIGHT, WRONG)], 50),
    "exchanged while a body is mirrored": ("wrong", [run("a", 1, row(sides=LEFT_OF_LEFT, body=SWAPPED))], 0),
}


@pytest.mark.parametrize(("name", "runs", "expected"), MEASURED.values(), ids=MEASURED)
def test_figure_is_what_its_description_says(name, runs, expected):
    assert value(name, *runs) == pytest.approx(expected)


def after_swap(seed: int, *sides) -> object:
    """A run whose motors are swapped in its second environment, with what is known after each contact there."""
    contacts = [contact(sides=known, body=SWAPPED) for known in sides]
    return run("a", seed, row(), row(body=SWAPPED, contacts=contacts))


def test_recovery_is_counted_in_contacts_after_the_change():
    right, half, wrong = ((0, *known, 0, 0, 0) for known in ((2, 0, 0, 1), (2, 0, 0, 0), (2, 0, 0, 2)))

    runs = [after_swap(1, wrong, half, right), after_swap(2, right), after_swap(3, wrong)]

    assert value("recovery", *runs) == 3
    assert value("recovered", *runs) == pytest.approx(100 * 2 / 3)


def test_recovery_that_is_forgotten_again_is_not_lasting():
    right, wrong = (0, 2, 0, 0, 1, 0, 0, 0), (0, 2, 0, 0, 2, 0, 0, 0)

    runs = [after_swap(1, wrong, right, wrong, right), after_swap(2, right, right), after_swap(3, right, wrong)]

    assert (value("recovered", *runs), value("recovery", *runs)) == (100, 1)
    assert value("lasting", *runs) == pytest.approx(100 * 2 / 3)
    assert value("lasting_recovery", *runs) == 4


def test_recovery_counts_once_per_seed_with_robots_sharing_a_world():
    right = contact(sides=(0, 2, 0, 0, 1, 0, 0, 0), body=SWAPPED)
    rows = [row(body=SWAPPED, contacts=[right]) for _ in range(20)]
    (sample,) = samples(*(run("a", seed, it, robots=4) for seed, it in enumerate(rows)))

    found = estimate(FIGURES["recovered"], sample)

    assert (found.low, found.high) == pytest.approx([100 * it for it in wilson(np.ones((20, 1)))[1:]])


def test_recovery_is_undefined_without_a_change():
    assert math.isnan(value("recovery", *FOUR))


def test_robot_that_never_knows_all_counts_as_latest():
    runs = [run("a", seed, row(), known_s=known) for seed, known in enumerate((math.inf, 20.0, 30.0))]

    assert value("known_s", *runs) == 30


def test_interval_of_a_mean_agrees_with_its_standard_error():
    draws = np.random.default_rng(5)
    (sample,) = samples(*(run("a", seed, row(time)) for seed, time in enumerate(draws.normal(100.0, 10.0, 400))))

    found = estimate(FIGURES["mean_s"], sample)

    assert found.high - found.low == pytest.approx(2 * 1.96 * 10 / 20, rel=0.15)
    assert found.low < found.value < found.high
    assert estimate(FIGURES["mean_s"], sample) == found


def test_ratio_pairs_equal_seeds_so_that_shared_variation_cancels_out():
    times = np.random.default_rng(5).normal(100.0, 30.0, 50)
    ours = [run("a", seed, row(time)) for seed, time in enumerate(times)]
    theirs = [run("b", seed, row(2 * time)) for seed, time in enumerate(times)]

    found = compare(FIGURES["mean_s"], *samples(*ours, *theirs))

    assert (found.low, found.value, found.high) == pytest.approx((0.5, 0.5, 0.5))


# Wilson's intervals as Newcombe (Statistics in Medicine 17, 1998, 857-872, table I, method 3) prints them.
@pytest.mark.parametrize(
    ("events", "of", "low", "high"),
    [(81, 263, 0.2553, 0.3662), (15, 148, 0.0624, 0.1605), (0, 20, 0.0, 0.1611), (1, 29, 0.0061, 0.1718)],
)
def test_interval_of_a_percentage_equals_published_wilson_intervals(events, of, low, high):
    counted = np.array([1.0] * events + [0.0] * (of - events)).reshape(-1, 1)

    assert wilson(counted)[1:] == pytest.approx((low, high), abs=1e-4)


def test_environments_of_a_seed_that_go_alike_count_as_one():
    alike = np.repeat([[1.0], [0.0]], 50, axis=0).repeat(5, axis=1)

    assert wilson(alike) == pytest.approx(wilson(alike[:, :1]), rel=1e-9)


def test_interval_of_a_paired_difference_has_95_percent_coverage():
    draws, held = np.random.default_rng(11), 0
    (sample,) = samples(*(run("a", seed, row()) for seed in range(60)))
    for _ in range(1000):
        shared, own = draws.random((60, 1)), draws.random((2, 60, 1))
        better, worse = np.where(draws.random((2, 60, 1)) < 0.5, shared, own) < [[[0.9]], [[0.8]]]
        found = compare(FIGURES["finished"], replace(sample, finished=better), replace(sample, finished=worse))
        held += found.low <= 10 <= found.high

    assert 0.93 < held / 1000 < 0.975


def test_coverage_is_how_often_intervals_hold_the_figure_of_all_seeds():
    times = np.random.default_rng(7).gamma(2.0, 50.0, 400)
    (sample,) = samples(*(run("a", seed, row(time, finished=time < 200.0)) for seed, time in enumerate(times)))

    assert 0.9 < coverage(FIGURES["finished"], sample, 50, draws=300) < 0.99
    assert 0.88 < coverage(FIGURES["mean_s"], sample, 50, draws=100) < 0.99
    assert coverage(FIGURES["trapped"], sample, 50, draws=10) == 1


def test_seeds_for_a_difference_find_it_in_four_of_five_studies():
    draws = np.random.default_rng(3)

    def found(seeds: int) -> Estimate:
        ours, theirs = draws.normal([[100.0], [90.0]], 20.0, (2, seeds))
        return Estimate(
            (mean := float((ours - theirs).mean())),
            mean - (half := 1.96 * float((ours - theirs).std()) / seeds**0.5),
            mean + half,
            seeds,
        )

    needed = int(found(2000).seeds_for(10))

    assert 0.75 < np.mean([found(needed).low > 0 for _ in range(1000)]) < 0.85


def test_conditions_are_compared_on_the_seeds_that_all_have():
    ours, theirs = samples(run("a", 1, row(1)), run("a", 2, row(2)), run("b", 2, row(4)), run("b", 3, row(8)))

    assert ours.seeds.tolist() == theirs.seeds.tolist() == [2]
    assert (ours.robot_s.tolist(), theirs.robot_s.tolist()) == ([[2.0]], [[4.0]])


def test_table_has_a_line_for_each_condition():
    runs = [
        run("a", 1, row(100.0, [contact(0.5)]), row(300.0, [contact(61.0)], finished=False, sides=LEFT_OF_LEFT)),
        run("b", 1, row(50.0), row(150.0, collisions=1)),
    ]

    lines = table(samples(*runs)).splitlines()

    assert lines[:3] == [
        "finished: environments with all food eaten",
        "  a   50.0 %  9.5..90.5 %",
        "  b  100.0 %  34.2..100.0 %  +50.0 points (-27.3..+90.5)",
    ]
    assert "  b  100 s  100..100 s  x 0.50 (0.50..0.50)" in lines
    assert "  a  30.25 s  30.25..30.25 s" in lines


@pytest.mark.parametrize(
    ("bounds", "verdict"),
    [
        ({"at_least": 90}, "reached"),
        ({"at_least": 101}, "MISSED "),
        ({"at_least": 100}, "UNSURE "),
        ({"at_most": 110}, "reached"),
        ({"at_most": 98}, "MISSED "),
        ({"at_least": 95, "at_most": 105}, "reached"),
        ({"at_least": 100, "at_most": 105}, "UNSURE "),
    ],
)
def test_goal_is_judged_by_the_whole_interval(bounds, verdict):
    runs = [run("a", seed, row(time)) for seed, time in enumerate(np.random.default_rng(5).normal(100.0, 10.0, 200))]

    (judged,) = judge([Goal("mean_s", "a", **bounds)], samples(*runs))

    assert judged.is_reached == (verdict == "reached")
    assert str(judged).startswith(f"{verdict}  mean_s of a: 99 s (98..100 s), wanted at ")


def test_goal_can_be_a_ratio():
    (judged,) = judge([Goal("mean_s", "a", "b", at_most=0.4)], samples(*FOUR, run("b", 0, row(300.0))))

    assert judged.is_reached
    assert str(judged) == "reached  mean_s of a by b: 0.333 (0.333..0.333), wanted at most 0.4"


NOT_MEMORYLESS = ("5", "7")
"""Where a trial has failed the next is made at the same place: their first trials help more often than the rest."""

NUMBER = re.compile(r"\d+(?:\.\d+)?")
L, R = Side.LEFT, Side.RIGHT


def life(*tried: tuple[int, Side], **cells: Side) -> Life:
    return Life([*tried], [tuple(cells.get(f"cell{i}", Side.NOTHING) for i in range(8))], [True], [[]])


def test_clock_is_the_part_of_the_trials_to_its_side_that_helped():
    lives = [life((2, L), (2, R), (2, L), cell2=L), life((2, R), (3, L), cell3=L), life((2, L), (2, R), cell2=R)]

    clocks = clocks_of(lives, 2)
    assert clocks.left == pytest.approx(1 / 3)
    assert clocks.right == pytest.approx(1 / 3)
    assert clocks.left_wins == pytest.approx(0.5)
    assert clocks.first_helps == pytest.approx(1 / 3)
    assert left_of(lives, 2) == [True, False]
    assert first_helped(lives, 2) == [False, False, False]
    assert first_helped(lives, 3) == [True]


def test_side_that_was_never_tried_never_helps():
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


def test_learning_page_has_the_rows_of_clocks_and_few_seeds_agree(few):
    page = (ROOT / "docs/learning.md").read_text().partition("| " + " | ".join(HEADINGS))[2].partition("\n\n")[0]

    theirs, ours = cells_of(page), cells_of(table_of(few[:50], few[50:]))
    assert [*theirs] == [*ours] == [str(cell) for cell in range(1, 8)]
    for cell, told in theirs.items():
        for (value, *_), (_, low, high) in zip((told[3], told[5]), (ours[cell][3], ours[cell][5]), strict=True):
            assert low - (high - low) / 2 - 1 <= value <= high + (high - low) / 2 + 1, cell


def test_predictions_of_the_page_are_near_the_figures_of_other_robots():
    """The chain is right about those that it was not made of; both halves are as large."""
    page = (ROOT / "docs/learning.md").read_text().partition("| " + " | ".join(HEADINGS))[2].partition("\n\n")[0]

    for cell, told in cells_of(page).items():
        for (predicted,), (value, low, high) in ((told[2], told[3]), (told[4], told[5])):
            if cell not in NOT_MEMORYLESS or predicted == told[2][0]:
                assert abs(predicted - value) <= 2**0.5 * (high - low) / 2 + 0.1, cell
