"""Behaviours side by side: equal trials give equal rows, and the table says what the rows do."""

import pytest

from host_sim.cli.main import main
from host_sim.protocol.generated import FEEL
from host_sim.robot_io import NOTHING_SENSED
from host_sim.study.faults import FAULTS
from host_sim.study.table import table
from host_sim.study.trial import Row, Trial, run_trial


def row(profile: str, seed: int, **fields) -> Row:
    return Row(profile, seed, 1, **{"sides": (0,) * 8, **fields})


def test_equal_trials_give_equal_rows():
    trial = Trial("searcher", 3, environments=1)

    assert run_trial(trial) == run_trial(trial)


def test_with_a_mirrored_ring_from_birth_the_path_is_the_same_and_the_cells_are_exchanged():
    sound, mirrored = (run_trial(Trial("article", 3, 1, fault=fault))[0] for fault in ("none", "mirrored"))

    assert (mirrored.robot_s, mirrored.blocked_s) == (sound.robot_s, sound.blocked_s)
    assert mirrored.sides == tuple(sound.sides[cell] for cell in (0, 4, 2, 6, 1, 5, 3, 7))


@pytest.mark.parametrize("fault", ["noise", "stuck-front", "swapped"])
def test_any_other_fault_makes_another_run(fault):
    sound, faulty = (run_trial(Trial("article", 3, 1, fault=wrong))[0] for wrong in ("none", fault))

    assert sound != faulty


def test_a_fault_can_begin_later():
    sound, late = (run_trial(Trial("article", 3, 2, fault=fault, fault_from=2)) for fault in ("none", "mirrored"))

    assert sound[0] == late[0]
    assert sound[1] != late[1]


def test_a_mirrored_ring_has_right_for_left():
    class Feeling:
        def sense(self, _tick):
            return NOTHING_SENSED._replace(feel=FEEL["RIGHT"] | FEEL["FRONT_LEFT"])

    assert FAULTS["mirrored"](Feeling(), None).sense(0).feel == FEEL["LEFT"] | FEEL["FRONT_RIGHT"]


def test_the_table_has_the_figures_of_the_rows():
    rows = [
        row("article", 1, finished=True, robot_s=100.0, blocked_s=[0.5, 1.5], sides=(0, 1, 0, 0, 2, 0, 0, 0)),
        row("article", 2, finished=False, robot_s=300.0, blocked_s=[61.0], sides=(0, 2, 0, 0, 0, 0, 0, 0)),
        row("five", 1, finished=True, robot_s=50.0, collisions=1),
        row("five", 2, finished=True, robot_s=150.0),
    ]

    first, second = (line.split("  ") for line in table(rows).splitlines()[1:3])

    figures = [[word.strip() for word in line if word.strip()] for line in (first, second)]
    assert figures[0] == ["article", "50.0 %", "200 s", "200 s", "1.00 (1.00..1.00)", "21.00 s", "1", "50.0 %", "0"]
    assert figures[1] == ["five", "100.0 %", "100 s", "100 s", "0.50 (0.50..0.50)", "-", "0", "0.0 %", "1"]


def test_the_command_prints_a_line_for_each_profile(capsys):
    words = ["compare", "never", "five", "--seeds", "1", "--environments", "1", "--set", "filter=1", "--jobs", "1"]

    assert main(words) == 0

    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines[2:4]] == ["never", "five"]


@pytest.mark.parametrize(
    "words", [["genius"], ["article", "--fault", "gremlin"], ["article", "--set", "filter=2"], []]
)
def test_wrong_usage_is_one_line(capsys, words):
    assert main(["compare", *words]) == 2

    assert capsys.readouterr().err.count("\n") == 1
