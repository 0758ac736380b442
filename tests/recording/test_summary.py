"""The counters of a run, as people and programs read them."""

import json
from types import SimpleNamespace

import pytest

from host_sim.client.connection import Connection
from host_sim.client.frame_log import FrameLog
from host_sim.client.robot_client import INCIDENTS_MAX, RobotClient
from host_sim.protocol.codec import Protocol
from host_sim.recording.summary import Summary, frame_counts, summarize, text_of
from host_sim.sim.in_process_link import InProcessLink
from host_sim.sim.run_config import RunConfig
from host_sim.sim.world_record import WorldRecord


@pytest.fixture
def client():
    log = FrameLog()
    yield RobotClient(Connection(InProcessLink()), Protocol(), log)
    log.close()


def summary_of(client: RobotClient) -> Summary:
    return summarize(RunConfig(), SimpleNamespace(clients=[client], record=WorldRecord(1, 1, 1)), [], "", 1.0)


def test_a_loss_is_counted_once(client):
    client.frames.lost = 3
    client.reports.faults = {"missed": 2}

    assert frame_counts(client)["lost"] == 3


@pytest.mark.parametrize(("factor", "said"), [(0.46, "0.5 x"), (9.96, "10.0 x"), (161.4, "161 x")])
def test_a_watched_run_that_is_slower_than_real_time_says_how_slow(client, factor, said):
    content = {**summary_of(client).content, "real_time_factor": factor}

    assert f"speed     {said} real time" in text_of(content)


def test_a_counter_at_its_limit_says_so(client):
    client.reports.faults = {"missed": 255, "stale": 254}

    summary = summary_of(client)

    assert json.loads(summary.to_json())["robots"][0]["saturated"] == ["missed"]
    assert "missed: 255 or more" in summary.text
    assert "stale: 254" in summary.text
    assert "254 or more" not in summary.text


def test_a_sound_run_says_nothing_about_its_link(client):
    assert "link" not in summary_of(client).text


def test_what_happened_to_the_line_is_said(client):
    client.connection.line.outages, client.frames.repeated = 2, 7
    client.round_trip.note(0.3)

    assert "link      7 frames repeated, gone 2 times; an answer takes 300 ms" in summary_of(client).text


def test_one_of_a_kind_is_in_the_singular(client):
    client.connection.line.outages, client.frames.repeated = 1, 1

    assert "link      1 frame repeated, gone 1 time" in summary_of(client).text


def test_a_run_that_was_cut_short_counts_the_environments_asked_for(client):
    assert summary_of(client).ending == "done      0 of 5 environments finished"


def test_a_change_that_happened_was_not_missed_however_its_time_was_written(client):
    record = WorldRecord(1, 1, 1, happened=["mirror@1s"])
    run = SimpleNamespace(clients=[client], record=record)

    changes = summarize(RunConfig(changes=("mirror@1.0s", "plant@2.0s")), run, [], "", 1.0).content["changes"]

    assert changes == {"happened": ["mirror@1s"], "refused": [], "missed": ["plant@2s"]}


def test_incidents_are_listed(client):
    client.distrust("the robot restarted")

    assert summary_of(client).content["incidents"] == ["at tick 0 (node 1) the robot restarted"]


def test_of_very_many_incidents_the_first_are_listed_and_the_others_counted(client):
    for _ in range(INCIDENTS_MAX + 3):
        client.distrust("the robot restarted")

    *listed, last = summary_of(client).content["incidents"]

    assert len(client.incidents) == len(listed) == INCIDENTS_MAX
    assert last == "(node 1) 3 more, not listed"
