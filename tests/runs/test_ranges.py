"""Distances on the wire: who gets them, when, and that a run with them can be repeated from its log."""

from host_sim.base.errors import SessionLostError
from host_sim.client.frame_log import FrameLog
from host_sim.client.supervision import recover
from host_sim.protocol.codec import Protocol, counter_of
from host_sim.protocol.generated import NOTHING_NEAR, RANGE_NONE
from host_sim.recording.log_reader import read_log
from host_sim.recording.replay import replay
from host_sim.recording.resimulation import resimulate
from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig

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


def test_a_robot_that_does_not_ask_gets_none(tmp_path):
    run(tmp_path / "run.log", RunConfig(seed=3, environments=1, limit_s=2))

    assert {message.name for _, message in messages(tmp_path / "run.log")} == {"SENSES"}


def test_a_run_with_distances_is_replayed_and_simulated_again(tmp_path):
    run(tmp_path / "run.log", ASKED)

    outcome = replay(read_log(tmp_path / "run.log"), PROTOCOL)
    assert (outcome.difference, outcome.drives) == (None, 1000)
    assert resimulate(tmp_path / "run.log").trajectory.ticks == 1000


def test_a_replay_without_the_distances_finds_a_difference(tmp_path):
    run(tmp_path / "run.log", ASKED)
    ranges = f" {PROTOCOL.id_of('RANGES'):03X}#"
    lines = (tmp_path / "run.log").read_text().splitlines(keepends=True)
    (tmp_path / "without.log").write_text("".join(line for line in lines if ranges not in line))

    assert replay(read_log(tmp_path / "without.log"), PROTOCOL).difference is not None


def test_a_bad_bus_repeats_them_too_and_changes_nothing(tmp_path):
    clean, bad = tmp_path / "clean.log", tmp_path / "bad.log"
    run(clean, ASKED)
    faults = ("drop:20%", "duplicate:10%", "reorder:10%")
    repeated, incidents = run(bad, RunConfig(**{**vars(ASKED), "faults": faults}))

    assert repeated > 100
    assert not incidents
    assert messages(bad) == messages(clean)


def test_the_loop_in_c_is_left_out():
    with make(ASKED) as simulation:
        simulation.enter(1)
        assert simulation.loop is None


def test_what_is_known_of_a_robot_that_is_asked_how_it_is_stays():
    with make(ASKED) as simulation:
        simulation.enter(1)
        simulation.step()
        (client,) = simulation.clients
        recover(client, SessionLostError("a test"))

        assert client.wants_ranges
        assert client.ranges == NOTHING_NEAR
        simulation.step()
