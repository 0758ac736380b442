"""Ticks that were exchanged elsewhere leave a client as if it had exchanged them itself."""

from host_sim.client.commands import stop
from host_sim.client.pacing import BegunTick, Lockstep
from host_sim.client.robot_client import RobotClient
from host_sim.client.session import heard_more
from host_sim.protocol.codec import COUNTERS, Frame, crc8
from host_sim.sim.block_catch_up import Ticks, routine_reports, take_last_reports, take_routine_reports, take_ticks
from tests.client.meddled_link import LEARNED, MeddledLink, learned
from tests.client.support import ODOMETERS, PROTOCOL, drive_for, senses

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


def test_ticks_count_as_sent_and_the_next_one_goes_on_from_there():
    link = MeddledLink()
    client = learned(link)
    sent, counter = client.frames.sent, (LEARNED + 1) % COUNTERS
    sensed = PROTOCOL.encode_senses(senses(LEARNED, ODOMETERS[id(client)]), counter)
    link.put(sensed)
    drive = next(frame for frame in link.waiting if PROTOCOL.decode_drive(frame))
    link.waiting.clear()
    told = client.inbox.told

    take_ticks(client, Ticks(1, drive, [heard_more(told.heard, sensed.data, told.drive)]))

    assert (client.tick, client.frames.sent, client.inbox.last) == (LEARNED, sent + 1, drive)
    assert [each.tick for each in drive_for(client, 2, LEARNED + 1)] == [(LEARNED + tick) % 256 for tick in (1, 2)]
    stop(client)
    assert client.incidents == []


def test_a_tick_that_was_only_begun_elsewhere_is_finished_here():
    link = MeddledLink()
    client = learned(link)
    sent, sensed = client.frames.sent, senses(LEARNED, ODOMETERS[id(client)])
    link.put(PROTOCOL.encode_senses(sensed, (LEARNED + 1) % COUNTERS))

    (drive,) = Lockstep([client]).exchange([sensed], BegunTick(1, ()))

    assert (drive.tick, client.frames.sent, client.frames.repeated) == (LEARNED % 256, sent + 1, 0)


def test_the_last_reports_are_taken_over_and_known_from_then_on():
    client = learned(MeddledLink())
    client.unsettled = LEARNED
    heartbeat = next_one(last_of(client, "HEARTBEAT"))

    take_last_reports(client, [GARBAGE, heartbeat])

    assert client.unsettled is None
    assert is_known(client, heartbeat)


def test_where_there_were_no_reports_nothing_is_settled():
    client = learned(MeddledLink())
    client.unsettled = LEARNED

    take_last_reports(client, [])

    assert client.unsettled == LEARNED


def test_reports_that_say_the_same_with_the_next_counters_are_known_from_then_on():
    client = learned(MeddledLink())
    memory = client.memory
    reports = [(kind, next_one(frame)) for kind, frame in routine_reports(client)]
    assert {kind for kind, _ in reports} == {
        *("FAULTS 0", "FAULTS 1", "HEALTH", "HEARTBEAT", "MEMORY 0", "MEMORY 1"),
    }

    take_routine_reports(client, reports)

    assert client.inbox.last == reports[-1][1]
    assert all(is_known(client, frame) for _, frame in reports)
    assert client.memory == memory != (0,) * 8


def test_the_second_half_of_a_memory_may_come_in_a_later_tick():
    client = learned(MeddledLink())
    first, second = ((kind, next_one(frame)) for kind, frame in routine_reports(client) if "MEMORY" in kind)

    take_routine_reports(client, [first])
    memories = client.reports.memories
    client.inbox.take(second[1])

    assert client.reports.memories == memories + 1


def test_what_would_be_looked_at_is_no_routine():
    client = learned(MeddledLink())
    client.reports.heartbeat = {**client.reports.heartbeat, "state": 0}
    client.inbox.take(next_one(next_one(last_of(client, "MEMORY"))))

    assert {kind.split()[0] for kind, _ in routine_reports(client)} == {"FAULTS", "HEALTH"}
