"""Runs with bodies that are not ideal, and with distances on the wire: the same wherever, and from the log.

Runs in the world whose obstacles can be pushed: the same wherever, and from the log, with pymunk only.

A motor that dies is noticed however late the wheels answer, and sound wheels that answer late are believed.
"""

import json
from dataclasses import replace

import pytest

from host_sim.base.errors import SessionLostError, UsageError
from host_sim.client.frame_log import FrameLog
from host_sim.client.supervision import recover
from host_sim.protocol.codec import Protocol, counter_of
from host_sim.protocol.generated import NOTHING_NEAR, RANGE_NONE
from host_sim.recording.log_reader import read_log
from host_sim.recording.replay import replay
from host_sim.recording.resimulation import resimulate
from host_sim.recording.world_file import read_world
from host_sim.sim.fleet import run_fleet
from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig
from host_sim.world.body_kinds import KIT, body_kind, draw_body
from host_sim.world.crates import Crates
from host_sim.world.edits import Edit
from tests.runs.dead_motors import DELAYS_TICKS, LAGS_MS, SEEDS, figures, lines
from tests.runs.support import ROOT, octet, unpacked

BRIEF = ("--environments", "2", "--limit-s", "8", "--seed", "3", "--body", KIT)


def results(native: bool = True, physics: str = "fast", limit_s: float = 60.0) -> list[tuple[int, ...]]:
    config = RunConfig(seed=3, environments=2, limit_s=limit_s, body=KIT, physics=physics)
    with make(config) as simulation:
        simulation.native = native
        return [(it.ticks, it.robots[0].food_eaten, *it.robots[0].memory) for it in simulation.run()]


def test_kit_run_is_the_same_in_python_in_c_and_with_pymunk():
    assert results() == results(native=False) == results(physics="pymunk")


def test_kit_robot_does_the_same_in_a_fleet_as_alone():
    fleet = run_fleet(RunConfig(seed=3, robots=1, worlds="own", environments=2, limit_s=60.0, body=KIT))

    assert [(it.ticks, it.food_eaten, *it.memory) for it in fleet] == results()


def test_kit_run_is_repeated_from_its_log_and_the_same_over_another_bus(run):
    done = run(*BRIEF)

    assert (done.code, done.errors) == (0, "")
    assert resimulate(done.out / "run.log").trajectory.ticks == 800
    assert done.log == run(*BRIEF, "--bus", "fd").log


def test_kit_bodies_of_different_robots_differ():
    kits = [draw_body(body_kind(KIT), 1, robot) for robot in range(3)]

    assert len({kit.trait[kit_trait] for kit in kits for kit_trait in (5,)}) == len(kits)


def test_body_file_takes_missing_traits_from_its_base(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text('base = "kit"\nlag_ms = [40, 10]\nslip = 0\n')

    kind = body_kind(str(path))

    assert kind is not None
    assert (kind.traits["lag_ms"], kind.traits["slip"], kind.traits["motor_ms"]) == ((40, 10), (0, 0), (60, 15))


@pytest.mark.parametrize(
    ("body", "step_mm"),
    [("ideal", None), ("kit", 24), ("docs/bodies/sharp_body.toml", 24), ("docs/bodies/late_body.toml", None)],
)
def test_kit_based_body_brings_its_settings_unless_the_run_sets_them(body, step_mm):
    assert RunConfig(body=body).robot_settings.get("step_mm") == step_mm
    assert RunConfig(body=body, settings={"step_mm": 12}).robot_settings["step_mm"] == 12


@pytest.mark.parametrize(
    ("line", "why"),
    [
        ("slip = 2", "slip is 0 to 1, its tolerance 0 to 1"),
        ("lag_ms = [10, -1]", "lag_ms is 0 to 1000, its tolerance 0 to 1000"),
        ("lag_ms = 'much'", "lag_ms is a number, or [number, tolerance]"),
        ("lag = 3", "there is no 'lag'"),
        ("base = 'other'", "base is ideal or kit, not 'other'"),
        ("base = ['kit']", "base is ideal or kit, not ['kit']"),
    ],
)
def test_invalid_body_value_is_reported_with_its_line(tmp_path, line, why):
    path = tmp_path / "mine.toml"
    path.write_text(f"# a body\n{line}\n")

    with pytest.raises(UsageError, match=r"mine\.toml:2: ") as refused:
        body_kind(str(path))
    assert why in str(refused.value)


def test_command_line_refuses_an_invalid_body_file(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text("slack_mm = 99\n")

    done = octet("run", "--body", path, "--out", tmp_path / "out")

    assert done.returncode != 0
    assert f"{path}:1: slack_mm is 0 to 10" in done.stderr


def test_robot_stops_in_order_when_its_wheels_lag_too_much(tmp_path):
    path = tmp_path / "late.toml"
    path.write_text("lag_ms = 300\n")

    with make(RunConfig(seed=1, environments=1, limit_s=60.0, body=str(path))) as simulation:
        episode = next(simulation.run())

        assert episode.robots[0].memory == (0,) * 8
        assert not simulation.drives[0].left_mm_s
        assert not simulation.drives[0].right_mm_s


PROTOCOL = Protocol()
ASKED = RunConfig(seed=3, environments=1, limit_s=20, profile="distance")


def run(path, config):
    log = FrameLog(path)
    with make(config, log) as simulation:
        for _ in simulation.run():
            pass
        repeated = simulation.clients[0].frames.repeated
        incidents = simulation.clients[0].incidents
    log.close()
    return repeated, incidents


def messages(path):
    decoded = [(line.frame, PROTOCOL.decode(line.frame)) for line in read_log(path)]
    return [(frame, message) for frame, message in decoded if message.name in ("RANGES", "SENSES")]


def test_ranges_go_before_the_senses_of_their_tick(tmp_path):
    run(tmp_path / "run.log", ASKED)

    sent = messages(tmp_path / "run.log")
    assert len(sent) == 2 * 1000
    seen = 0
    for (before, ranges), (after, senses) in zip(sent[::2], sent[1::2], strict=True):
        assert (ranges.name, senses.name) == ("RANGES", "SENSES")
        assert ranges.signals["tick"] == senses.signals["tick"]
        assert counter_of(before) == counter_of(after)
        seen += ranges.signals["range_front"] != RANGE_NONE
    assert seen


def test_robot_that_does_not_ask_for_distances_gets_none(tmp_path):
    run(tmp_path / "run.log", RunConfig(seed=3, environments=1, limit_s=2))

    assert {message.name for _, message in messages(tmp_path / "run.log")} == {"SENSES"}


def test_run_with_distances_is_replayed_and_simulated_again(tmp_path):
    run(tmp_path / "run.log", ASKED)

    outcome = replay(read_log(tmp_path / "run.log"), PROTOCOL)
    assert (outcome.difference, outcome.drives) == (None, 1000)
    assert resimulate(tmp_path / "run.log").trajectory.ticks == 1000


def test_replay_without_the_distances_finds_a_difference(tmp_path):
    run(tmp_path / "run.log", ASKED)
    ranges = f" {PROTOCOL.id_of('RANGES'):03X}#"
    lines = (tmp_path / "run.log").read_text().splitlines(keepends=True)
    (tmp_path / "without.log").write_text("".join(line for line in lines if ranges not in line))

    assert replay(read_log(tmp_path / "without.log"), PROTOCOL).difference is not None


def test_distances_are_repeated_on_a_bad_bus_and_arrive_unchanged(tmp_path):
    clean, bad = tmp_path / "clean.log", tmp_path / "bad.log"
    run(clean, ASKED)
    faults = ("drop:20%", "duplicate:10%", "reorder:10%")
    repeated, incidents = run(bad, replace(ASKED, faults=faults))

    assert repeated > 100
    assert not incidents
    assert messages(bad) == messages(clean)


def test_simulation_with_distances_does_not_use_the_loop_in_c():
    with make(ASKED) as simulation:
        simulation.enter(1)
        assert simulation.loop is None


def test_client_still_wants_distances_after_a_recovery():
    with make(ASKED) as simulation:
        simulation.enter(1)
        simulation.step()
        (client,) = simulation.clients
        recover(client, SessionLostError("a test"))

        assert client.wants_ranges
        assert client.ranges == NOTHING_NEAR
        simulation.step()


BLIND = [word for sensor in ("front", "front-left", "front-right") for word in ("--change", f"stuck-off:{sensor}@0s")]
SHORT_RUN = ("--world", "crates", "--environments", "2", "--limit-s", "20", "--seed", "2", *BLIND)


def test_crates_run_is_repeated_from_its_log_and_the_same_over_another_bus(run):
    done = run(*SHORT_RUN, "--bus", "none")

    assert (done.code, done.errors) == (0, "")
    assert done.log == run(*SHORT_RUN, "--bus", "fd").log
    pushes = [edit for _, edit in read_world(done.out / "run.world.json").edits if edit.do == "push_bar"]
    repeated = resimulate(done.out / "run.log")
    assert len(pushes) > 10
    assert repeated.trajectory.ticks == 2000
    assert octet("replay", str(done.out / "run.log")).returncode == 0


def test_pushes_are_not_news_and_the_page_explains_why_it_has_no_what_if(run):
    done = run(*SHORT_RUN, "--bus", "none")
    page = unpacked((done.out / "replay.html").read_text())

    assert "What if? cannot repeat this run: pymunk moved its crates." in page
    assert not any("push" in sentence for _, sentence in resimulate(done.out / "run.log").trajectory.news)
    assert json.loads((done.out / "summary.json").read_text())["world"] == "crates"


@pytest.mark.parametrize("ends", [((-1.0, 500.0), (200.0, 500.0)), ((500.0, 500.0), (550.0, 550.0))], ids=str)
def test_crate_pushed_to_an_impossible_place_stays_where_it_was(monkeypatch, ends):
    """A person can put one halfway into a wall, or make it so short that rounding is too much for it."""
    monkeypatch.setattr(Crates, "push", lambda *_: [Edit("push_bar", 0, a=ends[0], b=ends[1])])
    with make(RunConfig(world="crates", environments=1, limit_s=0.2)) as simulation:
        simulation.enter(1)
        before = simulation.arena.obstacles.bars
        while not simulation.over:
            simulation.step()

    assert simulation.tick == 10
    assert simulation.arena.obstacles.bars == before
    assert simulation.record.edits == []


@pytest.mark.parametrize(
    "words", [("--physics", "fast"), ("--robots", "2", "--worlds", "own"), ("--robots", "40")], ids=" ".join
)
def test_crates_world_is_refused_with_fast_physics_and_for_fleets(tmp_path, words):
    done = octet("run", "--world", "crates", *words, "--out", str(tmp_path / "out"))

    assert done.returncode == 2
    assert done.stderr == "octet: only pymunk can push what --world crates has: no --physics fast, and no fleet\n"
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("delay_ticks", DELAYS_TICKS)
@pytest.mark.parametrize("lag_ms", LAGS_MS)
def test_dead_motor_is_noticed_within_3_s_and_sound_wheels_are_not_denied(lag_ms, delay_ticks):
    of = figures(lag_ms, delay_ticks, 3)

    assert (of.unnoticed, of.denied) == (0, 0)


def test_faults_page_has_the_printed_table():
    page = (ROOT / "docs/faults.md").read_text().splitlines()

    for line in lines(SEEDS, LAGS_MS[:2]):
        assert line in page
