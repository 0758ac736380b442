"""The counters of a run, as people and programs read them.

What changed in a run, in plain sentences.
"""

import json
from types import SimpleNamespace

import pytest

from host_sim.client.connection import Connection
from host_sim.client.frame_log import FrameLog
from host_sim.client.robot_client import INCIDENTS_MAX, RobotClient
from host_sim.protocol.codec import Protocol
from host_sim.protocol.words import BODY_FAULTS
from host_sim.recording.phrases import body_sentence, news_of
from host_sim.recording.summary import Summary, frame_counts, summarize, text_of
from host_sim.sim.in_process_link import InProcessLink
from host_sim.sim.run_config import RunConfig
from host_sim.sim.world_record import Edited, Refused, WorldRecord
from host_sim.world.edits import Edit
from host_sim.world.geometry import Plant


@pytest.fixture
def client():
    log = FrameLog()
    yield RobotClient(Connection(InProcessLink()), Protocol(), log)
    log.close()


def summary_of(client: RobotClient) -> Summary:
    return summarize(RunConfig(), SimpleNamespace(clients=[client], record=WorldRecord(1, 1, 1)), [], "", 1.0)


def test_loss_is_counted_once(client):
    client.frames.lost = 3
    client.reports.faults = {"missed": 2}

    assert frame_counts(client)["lost"] == 3


@pytest.mark.parametrize(("factor", "said"), [(0.46, "0.5 x"), (9.96, "10.0 x"), (161.4, "161 x")])
def test_summary_text_gives_the_speed_relative_to_real_time(client, factor, said):
    content = {**summary_of(client).content, "real_time_factor": factor}

    assert f"speed     {said} real time" in text_of(content)


def test_saturated_counter_says_so(client):
    client.reports.faults = {"missed": 255, "stale": 254}

    summary = summary_of(client)

    assert json.loads(summary.to_json())["robots"][0]["saturated"] == ["missed"]
    assert "missed: 255 or more" in summary.text
    assert "stale: 254" in summary.text
    assert "254 or more" not in summary.text


def test_summary_of_a_sound_run_does_not_mention_its_link(client):
    assert "link" not in summary_of(client).text


@pytest.mark.parametrize(
    ("outages", "repeated", "delay_s", "said"),
    [
        (2, 7, 0.3, "link      7 frames repeated, gone 2 times; an answer takes 300 ms"),
        (1, 1, None, "link      1 frame repeated, gone 1 time"),
    ],
)
def test_summary_reports_line_events(client, outages, repeated, delay_s, said):
    client.connection.line.outages, client.frames.repeated = outages, repeated
    if delay_s:
        client.round_trip.note(delay_s)

    assert said in summary_of(client).text


def test_interrupted_run_counts_the_environments_asked_for(client):
    assert summary_of(client).ending == "done      0 of 5 environments finished"


def test_change_that_happened_is_not_missed_whatever_its_time_format(client):
    record = WorldRecord(1, 1, 1, happened=["mirror@1s"])
    run = SimpleNamespace(clients=[client], record=record)

    changes = summarize(RunConfig(changes=("mirror@1.0s", "plant@2.0s")), run, [], "", 1.0).content["changes"]

    assert changes == {"happened": ["mirror@1s"], "refused": [], "missed": ["plant@2s"]}


def test_summary_lists_the_first_incidents_and_counts_the_others(client):
    for _ in range(INCIDENTS_MAX + 3):
        client.distrust("the robot restarted")

    *listed, last = summary_of(client).content["incidents"]

    assert len(client.incidents) == INCIDENTS_MAX
    assert listed == ["at tick 0 (node 1) the robot restarted"] * INCIDENTS_MAX
    assert last == "(node 1) 3 more, not listed"


PLANT = Plant((500.0, 500.0), 80.0)


def record(*edits: Edited, robots: int = 1) -> WorldRecord:
    return WorldRecord(1, 5, 30000, robots, edits=list(edits))


def test_news_report_scheduled_changes_and_not_edits_by_hand():
    edits = [
        Edited(5, Edit("add_bar", a=(1.0, 1.0), b=(90.0, 90.0))),
        Edited(6, Edit("plant", at=PLANT.at, radius=PLANT.radius_mm)),
        Edited(7, Edit("lift")),
    ]

    assert news_of(record(*edits)) == [(6, "A plant was put down.")]


def test_plants_that_grow_in_one_tick_are_one_piece_of_news():
    assert news_of(
        record(Edited(6, Edit("grow_plant", 0, radius=90.0)), Edited(6, Edit("grow_plant", 1, radius=90.0)))
    ) == [(6, "A plant has grown.")]


def test_news_name_the_robot_unless_all_are_affected():
    both = [Edited(6, Edit("body", what="mirror", robot=robot)) for robot in (0, 1)]
    one = Edited(9, Edit("body", what="swap-motors", robot=1))

    assert news_of(record(*both, one, robots=2)) == [
        (6, "The sensor ring was mounted the wrong way round."),
        (9, "Robot 2: The motor plugs were swapped."),
    ]


def test_refused_change_is_reported_in_its_place():
    made = record(Edited(9, Edit("plant", at=PLANT.at, radius=PLANT.radius_mm)))
    made.refused.append(Refused(6, "grow@1s", "there is no plant"))

    assert [tick for tick, _ in news_of(made)] == [6, 9]
    assert news_of(made)[0] == (6, "grow@1s could not happen: there is no plant.")


@pytest.mark.parametrize(
    ("what", "sentence"),
    [
        ("stuck-on:front-left", "The front-left sensor is stuck: it always sees something."),
        ("stuck-off:front", "The front sensor is dead: it never sees anything."),
        ("noise:10/1000", "Each sensor is wrong in 10 of 1000 ticks."),
        ("weak-motor:left:60%", "The left motor turns at 60% of its speed."),
        ("odometer:left:-100%", "The left odometer counts -100% of its wheel's travel."),
        ("false-beacon:90", "The beacon shows food 90 mm ahead where there is none."),
        ("slack:3deg", "The gears have 3deg more slack."),
        ("repair", "The body was repaired."),
    ],
)
def test_fault_of_the_body_is_described_in_a_sentence(what, sentence):
    assert body_sentence(what) == sentence


def test_all_body_faults_have_a_sentence():
    details = {"stuck-on": ":front", "stuck-off": ":front", "noise": ":1/2", "false-beacon": ":9", "latency": ":1"}
    details |= dict.fromkeys(("weak-motor", "odometer"), ":left:50%")
    details |= {"lag": ":60ms", "slack": ":3deg", "slip": ":5%"}

    assert all(body_sentence(name + details.get(name, "")).endswith(".") for name in BODY_FAULTS)
