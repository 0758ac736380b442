"""One run of a study: equal trials give equal rows, and a row's command repeats it."""

import json
import shlex

import pytest

from host_sim.cli.main import main
from host_sim.lab.study.contacts import BodyState
from host_sim.lab.study.trial import knows_wrong, run_trial
from tests.lab.study.support import SWAPPED, trial


def test_equal_trials_give_equal_rows():
    searching = trial("searcher", 3)

    assert run_trial(searching) == run_trial(searching)


def test_the_command_of_a_run_repeats_it(tmp_path):
    settings = {"filter": 1, "turn_deg": 20}
    given = trial("adaptive", 5, 2, settings=settings, world="posts", limit_s=60.0, robots=2, changes=("plant@1s",))
    run = run_trial(given)

    assert main(["run", *shlex.split(given.config.command())[1:], "--quiet", "--out", str(tmp_path)]) == 0

    assert json.loads((tmp_path / "summary.json").read_text())["log_sha256"] == run.log_sha256


def blocked_ticks(run) -> list[int]:
    return [contact.blocked_ticks for row in run.rows for contact in row.contacts[0]]


def test_with_a_mirrored_ring_from_birth_the_path_is_the_same_and_the_cells_are_exchanged():
    sound, mirrored = (run_trial(trial("article", 3, changes=change)) for change in ((), ("mirror@env1",)))

    assert mirrored.rows[0].robot_s == sound.rows[0].robot_s
    assert blocked_ticks(mirrored) == blocked_ticks(sound)
    assert mirrored.rows[0].sides[0] == tuple(sound.rows[0].sides[0][cell] for cell in (0, 4, 2, 6, 1, 5, 3, 7))


@pytest.mark.parametrize(
    ("change", "is_wrong"), [((), False), (("mirror@env1",), True), (("swap-motors@env1",), True)]
)
def test_what_is_wrong_with_a_reversed_body_is_the_other_way_round(change, is_wrong):
    (row,) = run_trial(trial("fixed", 3, changes=change, limit_s=5)).rows

    assert knows_wrong(row.sides[0], row.bodies[0]) == is_wrong


def test_a_change_of_the_world_leaves_the_turns_as_they_are():
    (row,) = run_trial(trial("fixed", 3, changes=("plant@env1",), limit_s=5)).rows

    assert row.bodies == [BodyState(is_changed=True, is_reversed=False)]


def test_a_change_can_come_later_and_between_two_contacts():
    sound, late = (run_trial(trial("article", 3, changes=change)).rows[0] for change in ((), ("mirror@60s",)))

    before = [contact for contact in late.contacts[0] if contact.tick < 3000]
    assert before == [contact for contact in sound.contacts[0] if contact.tick < 3000]
    assert {contact.body.is_changed for contact in before} == {False}
    assert {contact.body for contact in late.contacts[0][len(before) :]} == {SWAPPED}
