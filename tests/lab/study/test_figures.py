"""What figures say of rows that were made up, and how far they are to be trusted."""

import math

import numpy as np
import pytest

from host_sim.lab.study.bootstrap import estimate
from host_sim.lab.study.figures import FIGURES
from host_sim.lab.study.goals import judge
from host_sim.lab.study.plan import Goal
from host_sim.lab.study.table import table
from tests.lab.study.support import SWAPPED, contact, row, run, samples

LEFT_OF_LEFT = (0, 0, 0, 0, 1, 0, 0, 0)
"""A turn toward what is beside the robot, where its body is sound."""


def value(name: str, *runs) -> float:
    (sample,) = samples(*runs)
    return float(FIGURES[name].of(sample, np.arange(len(sample.seeds))))


FOUR = [run("a", seed, row(robot_s)) for seed, robot_s in enumerate((100.0, 200.0, 300.0, 1000.0))]


@pytest.mark.parametrize(("name", "expected"), [("median_s", 250), ("iqm_s", 250), ("mean_s", 400)])
def test_times(name, expected):
    assert value(name, *FOUR) == expected


def test_finished_is_a_part_of_the_environments():
    assert value("finished", run("a", 1, row(), row(number=2, finished=False))) == 50


def test_blocked_time_is_a_mean_over_all_contacts():
    few, many = row(contacts=[contact(1.0)]), row(contacts=[contact(0.2)] * 3)

    assert value("blocked_s", run("a", 1, few), run("a", 2, many)) == pytest.approx(0.4)


def test_trapped_is_more_than_a_minute_at_once():
    assert (
        value("trapped", run("a", 1, row(contacts=[contact(60.0)] * 2), row(number=2, contacts=[contact(61.0)])))
        == 50
    )


def test_the_score_is_the_part_of_the_turns_that_cleared_the_way():
    contacts = [contact(turns=3), contact(turns=2, cleared=False)]

    assert value("score", run("a", 1, row(contacts=contacts))) == pytest.approx(0.2)


def test_wrong_is_what_is_known_in_the_last_environment():
    wrong, right = row(sides=[LEFT_OF_LEFT]), row(number=2)

    assert value("wrong", run("a", 1, wrong, right), run("a", 2, right, wrong)) == 50


def test_what_is_wrong_is_the_other_way_round_in_a_body_that_is():
    assert value("wrong", run("a", 1, row(sides=[LEFT_OF_LEFT], bodies=[SWAPPED]))) == 0


def after_swap(seed: int, *sides) -> object:
    """A run whose motors are swapped in its second environment, with what is known after each contact there."""
    contacts = [contact(sides=known, body=SWAPPED) for known in sides]
    return run("a", seed, row(), row(number=2, bodies=[SWAPPED], contacts=contacts))


def test_recovery_is_counted_in_contacts_after_the_change():
    right, half, wrong = ((0, *known, 0, 0, 0) for known in ((2, 0, 0, 1), (2, 0, 0, 0), (2, 0, 0, 2)))

    runs = [after_swap(1, wrong, half, right), after_swap(2, right), after_swap(3, wrong)]

    assert value("recovery", *runs) == 3
    assert value("recovered", *runs) == pytest.approx(100 * 2 / 3)


def test_without_a_change_there_is_no_recovery():
    assert math.isnan(value("recovery", *FOUR))


def test_who_never_knows_all_is_later_than_everybody_else():
    runs = [run("a", seed, row(), known_s=known) for seed, known in enumerate((None, 20.0, 30.0))]

    assert value("known_s", *runs) == 30


def test_the_interval_of_a_mean_is_what_the_seeds_give():
    draws = np.random.default_rng(5)
    (sample,) = samples(*(run("a", seed, row(time)) for seed, time in enumerate(draws.normal(100.0, 10.0, 400))))

    found = estimate(FIGURES["mean_s"], sample)

    assert found.half_width == pytest.approx(1.96 * 10 / 20, rel=0.15)
    assert found.low < found.value < found.high
    assert found.seeds_for(found.half_width / 2) == 1600
    assert estimate(FIGURES["mean_s"], sample) == found


def test_a_ratio_is_of_the_same_seeds_so_that_what_they_share_cancels_out():
    times = np.random.default_rng(5).normal(100.0, 30.0, 50)
    ours = [run("a", seed, row(time)) for seed, time in enumerate(times)]
    theirs = [run("b", seed, row(2 * time)) for seed, time in enumerate(times)]

    found = estimate(FIGURES["mean_s"], *samples(*ours, *theirs))

    assert (found.low, found.value, found.high) == pytest.approx((0.5, 0.5, 0.5))


def test_conditions_are_compared_on_the_seeds_that_all_have():
    ours, theirs = samples(run("a", 1, row(1)), run("a", 2, row(2)), run("b", 2, row(4)), run("b", 3, row(8)))

    assert ours.seeds.tolist() == theirs.seeds.tolist() == [2]
    assert (ours.robot_s.tolist(), theirs.robot_s.tolist()) == ([[2.0]], [[4.0]])


def test_the_table_has_a_line_for_each_condition():
    runs = [
        run(
            "a",
            1,
            row(100.0, [contact(0.5)]),
            row(300.0, [contact(61.0)], number=2, finished=False, sides=[LEFT_OF_LEFT]),
        ),
        run("b", 1, row(50.0), row(150.0, number=2, collisions=1)),
    ]

    lines = [
        [word.strip() for word in line.split("  ") if word.strip()] for line in table(samples(*runs)).splitlines()
    ]

    assert lines[1] == [
        *("a", "50.0 ±0.0 %", "200 ±0 s", "200 ±0 s", "200 ±0 s", "30.75 ±0.00 s", "50.0 %", "100.0 %", "0.0 %"),
        *("1.00", "1.00", "-"),
    ]
    assert lines[2] == [
        *("b", "100.0 ±0.0 %", "100 ±0 s", "100 ±0 s", "100 ±0 s", "-", "0.0 %", "0.0 %", "50.0 %"),
        *("-", "0.50", "0"),
    ]


@pytest.mark.parametrize(
    ("bounds", "reached"),
    [({"at_least": 250}, True), ({"at_least": 251}, False), ({"at_most": 250}, True), ({"at_most": 249}, False)],
)
def test_a_goal_is_a_bound_of_a_figure(bounds, reached):
    (judged,) = judge([Goal("median_s", "a", **bounds)], samples(*FOUR))

    assert judged.is_reached == reached
    assert ("reached" if reached else "MISSED") in str(judged)


def test_a_goal_can_be_a_ratio():
    (judged,) = judge([Goal("mean_s", "a", "b", at_most=0.4)], samples(*FOUR, run("b", 0, row(300.0))))

    assert judged.is_reached
    assert str(judged) == "reached  mean_s of a by b: 0.333, wanted at most 0.4"
