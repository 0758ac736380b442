"""One run of a study: equal trials give equal rows, alone or as fleets; contacts are counted tick by tick."""

import json
import math
import shlex
from dataclasses import fields

import numpy as np
import pytest

from host_sim.base.errors import UsageError
from host_sim.cli.main import main
from host_sim.lab.study.contacts import ContactWatch, _contacts, digits_of
from host_sim.lab.study.fleets import samples_of_fleets
from host_sim.lab.study.plan import Plan
from host_sim.lab.study.sample import TRAPPED_S, samples_of
from host_sim.lab.study.tables import tables_of
from host_sim.lab.study.trial import Trial, run_trial, tour_s
from host_sim.protocol.generated import Reason
from host_sim.sim.make import make
from host_sim.sim.native_fleet import loaded
from host_sim.sim.run_config import RunConfig
from host_sim.world.geometry import SimParams
from tests.lab.study.support import NOTHING, SOUND, SWAPPED, trial


def test_equal_trials_give_equal_rows():
    searching = trial("searcher", 3)

    assert run_trial(searching) == run_trial(searching)


def test_command_of_a_trial_repeats_its_run(tmp_path):
    settings = {"filter": 1, "turn_deg": 20}
    given = trial("adaptive", 5, 2, settings=settings, world="posts", limit_s=60.0, robots=2, changes=("plant@1s",))
    (run,) = run_trial(given)["runs"]

    assert main(["run", *shlex.split(given.config.command())[1:], "--quiet", "--out", str(tmp_path)]) == 0

    assert json.loads((tmp_path / "summary.json").read_text())["log_sha256"] == run["log_sha256"]


def test_command_of_a_long_run_has_its_limit_to_the_tick():
    assert "--limit-s 86399.98" in trial("article", 1, limit_s=86_399.98).config.command()


def test_ring_mirrored_from_the_start_exchanges_cells_on_the_same_path():
    sound, mirrored = (run_trial(trial("article", 3, changes=change)) for change in ((), ("mirror@env1",)))

    assert [it["blocked_s"] for it in mirrored["contacts"]] == [it["blocked_s"] for it in sound["contacts"]]
    (here,), (there,) = mirrored["environments"], sound["environments"]
    assert here["robot_s"] == there["robot_s"]
    assert here["sides"] == "".join(there["sides"][cell] for cell in (0, 4, 2, 6, 1, 5, 3, 7))


@pytest.mark.parametrize(
    ("change", "is_wrong"), [((), False), (("mirror@env1",), True), (("swap-motors@env1",), True)]
)
def test_fixed_turns_are_wrong_for_a_mirrored_or_swapped_body(change, is_wrong):
    (row,) = run_trial(trial("fixed", 3, changes=change, limit_s=5))["environments"]

    assert (row["changed"], row["wrong"]) == (bool(change), is_wrong)


def test_change_of_the_world_does_not_reverse_the_turns():
    (row,) = run_trial(trial("fixed", 3, changes=("plant@env1",), limit_s=5))["environments"]

    assert (row["changed"], row["wrong"]) == (True, 0)


def test_later_change_affects_only_the_contacts_after_it():
    sound, late = (run_trial(trial("article", 3, changes=change))["contacts"] for change in ((), ("mirror@60s",)))

    before = [contact for contact in late if contact["begun_s"] < 60]
    assert before == [contact for contact in sound if contact["begun_s"] < 60]
    assert {contact["changed"] for contact in before} == {False}
    assert {contact["changed"] for contact in late[len(before) :]} == {True}


FRONT_RIGHT = 0b00010
LEARNED = (0, 1, 0, 0, 0, 0, 0, 0)


def test_contact_lasts_from_the_first_turn_to_the_clear_way():
    ticks = [
        (0, Reason.WANDER, 1),
        *[(FRONT_RIGHT, Reason.TRIAL, 2)] * 3,
        *[(FRONT_RIGHT, Reason.REMEMBERED, 3)] * 2,
        (FRONT_RIGHT, Reason.REMEMBERED, 4),
        (0, Reason.WANDER, 5),
        (FRONT_RIGHT, Reason.BOREDOM, 6),
    ]

    memories, bodies = [(0, NOTHING), (5, LEARNED)], [(0, SOUND), (8, SWAPPED)]
    found = list(_contacts(np.array(ticks, np.int16), memories, bodies, 1.0))

    assert [(it["begun_s"], it["blocked_s"], it["pattern"]) for it in found] == [(1, 6, 1), (8, 1, 1)]
    assert [(it["trials"], it["remembered"], it["boredoms"]) for it in found] == [(1, 2, 0), (0, 0, 1)]
    assert [(it["cleared"], it["changed"], it["wrong"]) for it in found] == [
        (True, False, False),
        (False, True, True),
    ]
    assert {it["sides"] for it in found} == {digits_of(LEARNED)}


def contacts(native: bool) -> list:
    watch = ContactWatch(0)
    with make(RunConfig(seed=4, environments=1, limit_s=40.0)) as simulation:
        simulation.native, simulation.watch = native, watch
        list(simulation.run())
    return watch.contacts(0.02)


@pytest.mark.parametrize("native", [True, False])
def test_sides_at_the_end_of_a_contact_include_its_last_lesson(native):
    first, *_ = contacts(native)

    assert (first["pattern"], first["trials"], first["cleared"]) == (1, 1, True)
    assert first["sides"] == digits_of(LEARNED)


def test_c_loop_and_python_loop_give_equal_contacts():
    assert contacts(native=True) == contacts(native=False) != []


def test_turns_of_the_contacts_equal_those_that_the_robot_began():
    contacts = run_trial(trial("article", 2))["contacts"]
    with make(RunConfig(seed=2, environments=1)) as simulation:
        (episode,) = simulation.run()

    assert sum(it["trials"] for it in contacts) == episode.begun(Reason.TRIAL)
    assert sum(it["remembered"] for it in contacts) == episode.begun(Reason.REMEMBERED)


LOGGED = {"blocked_at", "wrong_at", "recovery", "settled"}
"""What only logs tell."""


@pytest.mark.parametrize("body", ["ideal", "kit"])
def test_fleet_has_the_figures_of_separate_runs(body):
    plan = Plan("", [Trial(RunConfig(environments=2, limit_s=40.0, profile="never", body=body))], 3, 3)

    (one,), (other,) = samples_of_fleets(plan), samples_of(tables_of(map(run_trial, plan.trials())))

    for name in {it.name for it in fields(one)} - LOGGED - {"name", "robots"}:
        assert np.allclose(getattr(one, name), getattr(other, name)), name
    assert one.contacts.sum() > 0


def test_robot_knows_its_turns_as_soon_in_a_fleet_as_alone():
    plan = Plan("", [Trial(RunConfig(environments=2, profile="adaptive"))], 3, 8)

    (one,), (other,) = samples_of_fleets(plan), samples_of(tables_of(map(run_trial, plan.trials())))

    assert np.isfinite(one.known_s).sum() > 3
    assert np.array_equal(one.known_s, other.known_s)


def test_robots_that_share_memories_in_own_worlds_know_sooner():
    alone, sharing = (
        Trial(RunConfig(environments=2, profile="adaptive", robots=8, worlds="own", settings={"share": share}))
        for share in (0, 1)
    )

    one, other = samples_of_fleets(Plan("", [alone, sharing], 1, 6))

    assert one.robots == 8
    assert one.robot_s.shape == one.tour_s.shape == (6, 16)
    assert np.median(other.known_s) < np.median(one.known_s) / 3


@pytest.mark.parametrize(("settings", "speed_mm_s"), [({}, 200), ({"speed_mm_s": 100}, 100)])
def test_robots_are_no_quicker_than_the_tour_less_the_eating_distance(settings, speed_mm_s):
    searching = [run_trial(trial("searcher", seed, settings=settings))["environments"][0] for seed in range(1, 13)]

    spared_s = 5 * SimParams().eat_reach_mm / speed_mm_s
    assert all(it["robot_s"] > it["tour_s"] - spared_s for it in searching)
    assert min(it["robot_s"] / it["tour_s"] for it in searching) < 1.5


def test_tour_is_unknown_for_too_much_food_to_try_all_orders(tmp_path):
    (tmp_path / "much.toml").write_text(f"food = {[[300 * i, 500] for i in range(2, 11)]}\n")

    assert math.isnan(tour_s(RunConfig(world=str(tmp_path / "much.toml")), 1))


def test_robots_that_share_an_environment_have_no_tour():
    assert math.isnan(run_trial(trial("searcher", 1, robots=2))["environments"][0]["tour_s"])


def test_fleet_and_study_count_contacts_up_to_the_same_time():
    assert loaded()[1].FLEET_TRAPPED_TICKS * SimParams().tick_s == TRAPPED_S


def test_fleet_refuses_a_change_during_the_run():
    plan = Plan("", [Trial(RunConfig(changes=("mirror@1s",)))])

    with pytest.raises(UsageError, match=r"nothing changes in a fleet: .* such as mirror@0s"):
        samples_of_fleets(plan)
