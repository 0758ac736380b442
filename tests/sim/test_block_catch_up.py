"""Ticks that were exchanged elsewhere leave a client as if it had exchanged them itself.

When changes are due.
"""

import pytest

from host_sim.client.commands import stop
from host_sim.client.pacing import BegunTick, Lockstep
from host_sim.client.robot_client import RobotClient
from host_sim.client.session import heard_more
from host_sim.protocol.codec import COUNTERS, Frame, crc8
from host_sim.sim.block_catch_up import Ticks, routine_reports, take_last_reports, take_routine_reports, take_ticks
from host_sim.sim.simulation import ChangeSchedule
from host_sim.world.changes import Change
from tests.client.support import LEARNED, ODOMETERS, PROTOCOL, MeddledLink, drive_for, learned, senses

GARBAGE = Frame(0x7FF, b"")


def next_one(frame: Frame) -> Frame:
    """The same report once more, with the next counter."""
    counter = (frame.data[1] % 16 + 1) % COUNTERS
    data = bytes([0, frame.data[1] // 16 * 16 + counter, *frame.data[2:]])
    return Frame(frame.id, bytes([crc8(frame.id, data)]) + data[1:])


def is_known(client: RobotClient, frame: Frame) -> bool:
    before = client.frames.duplicate
    client.inbox.take(frame)
    return client.frames.duplicate > before


def last_of(client: RobotClient, name: str) -> Frame:
    return [frame for frame in client.log.frames if frame.id == PROTOCOL.id_of(name)][-1]


@pytest.fixture
def client():
    return learned(MeddledLink())


def test_ticks_taken_over_count_as_sent_and_the_client_continues_from_them():
    link = MeddledLink()
    client = learned(link)
    sent, counter = client.frames.sent, (LEARNED + 1) % COUNTERS
    sensed = PROTOCOL.encode_senses(senses(LEARNED, ODOMETERS[id(client)]), counter)
    link.put(sensed)
    drive = next(frame for frame in link.waiting if PROTOCOL.decode_drive(frame))
    link.waiting.clear()
    told = client.inbox.held_check

    take_ticks(client, Ticks(1, drive, [heard_more(told.heard, sensed.data, told.drive)]))

    assert (client.tick, client.frames.sent, client.inbox.last) == (LEARNED, sent + 1, drive)
    assert [each.tick for each in drive_for(client, 2, LEARNED + 1)] == [(LEARNED + tick) % 256 for tick in (1, 2)]
    stop(client)
    assert client.incidents == []


def test_tick_begun_elsewhere_is_finished_by_lockstep():
    link = MeddledLink()
    client = learned(link)
    sent, sensed = client.frames.sent, senses(LEARNED, ODOMETERS[id(client)])
    link.put(PROTOCOL.encode_senses(sensed, (LEARNED + 1) % COUNTERS))

    (drive,) = Lockstep([client]).exchange([sensed], BegunTick(1, ()))

    assert (drive.tick, client.frames.sent, client.frames.repeated) == (LEARNED % 256, sent + 1, 0)


def test_last_reports_are_taken_over_and_then_known_as_duplicates(client):
    client.unsettled = LEARNED
    heartbeat = next_one(last_of(client, "HEARTBEAT"))

    take_last_reports(client, [GARBAGE, heartbeat])

    assert client.unsettled is None
    assert is_known(client, heartbeat)


def test_block_without_reports_settles_no_check(client):
    client.unsettled = LEARNED

    take_last_reports(client, [])

    assert client.unsettled == LEARNED


def test_routine_reports_taken_over_are_then_known_as_duplicates(client):
    memory = client.memory
    reports = [(kind, next_one(frame)) for kind, frame in routine_reports(client)]
    assert {kind for kind, _ in reports} == {
        *("FAULTS 0", "FAULTS 1", "HEALTH", "HEARTBEAT", "MEMORY 0", "MEMORY 1"),
    }

    take_routine_reports(client, reports)

    assert client.inbox.last == reports[-1][1]
    assert all(is_known(client, frame) for _, frame in reports)
    assert client.memory == memory != (0,) * 8


def test_second_half_of_a_memory_may_come_in_a_later_tick(client):
    first, second = ((kind, next_one(frame)) for kind, frame in routine_reports(client) if "MEMORY" in kind)

    take_routine_reports(client, [first])
    memories = client.reports.memories
    client.inbox.take(second[1])

    assert client.reports.memories == memories + 1


def test_report_that_needs_attention_is_not_routine(client):
    client.reports.heartbeat = {**client.reports.heartbeat, "state": 0}
    client.inbox.take(next_one(next_one(last_of(client, "MEMORY"))))

    assert {kind.split()[0] for kind, _ in routine_reports(client)} == {"FAULTS", "HEALTH"}


def schedule(*texts: str) -> ChangeSchedule:
    return ChangeSchedule([Change.parse(text) for text in texts], 0.02)


def due(coming: ChangeSchedule, tick: int) -> list[str]:
    return [str(change) for change in coming.due(tick)]


def test_change_is_due_once_from_its_tick_on():
    coming = schedule("plant@2s")
    coming.enter(1, 0)

    assert [due(coming, tick) for tick in (99, 100, 101)] == [[], ["plant@2s"], []]


def test_seconds_count_from_the_start_of_the_run_in_later_environments_too():
    coming = schedule("plant@2s")
    coming.enter(1, 0)
    coming.enter(2, 60)

    assert coming.next_tick == 100


def test_change_of_an_environment_counts_from_the_start_of_that_environment():
    coming = schedule("grow@env2+2s", "plant@env2")
    coming.enter(1, 0)
    assert coming.next_tick > 1_000_000
    coming.enter(2, 60)

    assert due(coming, 60) == ["plant@env2"]
    assert coming.next_tick == 160


def test_change_after_the_end_of_its_environment_is_dropped():
    coming = schedule("plant@env1+2s")
    coming.enter(1, 0)
    coming.enter(2, 60)

    assert due(coming, 1000) == []


def test_changes_of_one_tick_keep_their_order():
    coming = schedule("grow@2s", "plant@2s", "mirror@1s")
    coming.enter(1, 0)

    assert due(coming, 500) == ["mirror@1s", "grow@2s", "plant@2s"]


def test_changes_are_due_again_when_the_run_begins_anew():
    coming = schedule("plant@2s", "mirror@env1")
    coming.enter(1, 0)
    assert len(due(coming, 200)) == 2
    coming.enter(1, 300)

    assert due(coming, 300) == ["mirror@env1"]
    assert coming.next_tick == 400
