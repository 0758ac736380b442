"""One run of a study: equal trials give equal rows, and a row's command repeats it."""

import json
import shlex

import pytest

from host_sim.cli.main import main
from host_sim.errors import UsageError
from host_sim.protocol.generated import FEEL
from host_sim.robot_io import NOTHING_SENSED
from host_sim.study.faults import FAULTS, change_of
from host_sim.study.trial import Trial, run_trial


def test_equal_trials_give_equal_rows():
    trial = Trial("searcher", 3, environments=1)

    assert run_trial(trial) == run_trial(trial)


def test_the_command_of_a_run_repeats_it(tmp_path):
    trial = Trial(
        "adaptive", 5, environments=2, settings={"filter": 1, "turn_deg": 20}, world="posts", limit_s=60.0, robots=2
    )
    run = run_trial(trial)

    assert main(["run", *shlex.split(trial.command())[1:], "--quiet", "--out", str(tmp_path)]) == 0

    assert json.loads((tmp_path / "summary.json").read_text())["log_sha256"] == run.log_sha256


def blocked_ticks(run) -> list[int]:
    return [contact.blocked_ticks for row in run.rows for contact in row.contacts[0]]


def test_with_a_mirrored_ring_from_birth_the_path_is_the_same_and_the_cells_are_exchanged():
    sound, mirrored = (run_trial(Trial("article", 3, 1, change=change)) for change in ("", "mirrored@env1"))

    assert mirrored.rows[0].robot_s == sound.rows[0].robot_s
    assert blocked_ticks(mirrored) == blocked_ticks(sound)
    assert mirrored.rows[0].sides[0] == tuple(sound.rows[0].sides[0][cell] for cell in (0, 4, 2, 6, 1, 5, 3, 7))


def test_what_is_wrong_with_a_mirrored_ring_is_the_other_way_round():
    wrong = [run_trial(Trial("fixed", 3, 1, change=change)).rows[0].wrong for change in ("", "mirrored@env1")]

    assert wrong == [0, 1]


@pytest.mark.parametrize("fault", ["noise", "stuck-front", "swapped"])
def test_any_other_fault_makes_another_run(fault):
    sound, faulty = (run_trial(Trial("article", 3, 1, change=change, limit_s=60)) for change in ("", f"{fault}@env1"))

    assert sound.rows[0].contacts != faulty.rows[0].contacts


def test_a_fault_can_begin_later():
    sound, late = (run_trial(Trial("article", 3, 2, change=change)).rows for change in ("", "mirrored@env2"))

    assert sound[0] == late[0]
    assert sound[1] != late[1]
    assert [row.is_changed for row in late] == [False, True]


@pytest.mark.parametrize("text", ["swapped", "swapped@env0", "gremlin@env1", "swapped@1", ""])
def test_what_is_no_change_is_said_with_those_there_are(text):
    with pytest.raises(UsageError, match=r"is no change such as swapped@env6; there are noise,"):
        change_of(text)


def test_a_mirrored_ring_has_right_for_left():
    class Feeling:
        def sense(self, _tick):
            return NOTHING_SENSED._replace(feel=FEEL["RIGHT"] | FEEL["FRONT_LEFT"])

    assert FAULTS["mirrored"](Feeling(), None).sense(0).feel == FEEL["LEFT"] | FEEL["FRONT_RIGHT"]
