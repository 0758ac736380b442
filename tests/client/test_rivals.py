"""A robot that has a twin or a second commander, or is spoken for by others: noticed, and named."""

import pytest

from host_sim.base.errors import RivalError, SessionLostError, TwinError
from host_sim.client.commands import handshake, stop
from host_sim.client.supervision import settle
from host_sim.protocol.codec import Frame, counter_of
from host_sim.protocol.generated import Opcode, Reason, Result
from tests.client.support import (
    LEARNED,
    PROTOCOL,
    MeddledLink,
    altered,
    command,
    connected,
    drive_for,
    drives_in,
    is_stopped,
    learned,
    run,
    senses,
)


def test_stop_by_another_owner_ends_the_run(link, client):
    link.put(command(Opcode.STOP, owner=2))

    with pytest.raises(RivalError, match="somebody else stopped node 1"):
        drive_for(client, 1, LEARNED)
    assert "somebody else stopped node 1" in str(client.incidents)


def test_start_by_another_owner_ends_the_run(link, client):
    link.put(command(Opcode.STOP, owner=7))
    link.put(command(Opcode.START, owner=7, profile=0, lockstep=1, seed=9))

    with pytest.raises(RivalError, match=f"node 1 obeys another simulator .tick {LEARNED}"):
        drive_for(client, 1, LEARNED)


@pytest.mark.parametrize("rival", [PROTOCOL.encode_senses(senses(7), 3), command(Opcode.FREEZE, owner=3, freeze=1)])
def test_frames_of_another_simulator_end_the_run_and_stop_the_robot(link, client, rival):
    link.waiting.extend([rival, rival])

    with pytest.raises(RivalError, match=f"another simulator commands node 1, heard at tick {LEARNED}"):
        drive_for(client, 1, LEARNED)
    assert is_stopped(link)


def test_single_frame_of_another_simulator_causes_no_incident(link, client):
    link.waiting.append(command(Opcode.STOP, owner=3))
    drive_for(client, 1, LEARNED)

    assert client.frames.refused == 1
    assert client.incidents == []


def stray_answer(result: Result) -> Frame:
    """An answer to what this simulator never asked."""
    signals = {"counter": 14, "opcode": Opcode.GET, "which": 0, "value": 0}
    return PROTOCOL.encode("ANSWER", {**signals, "result": result})


@pytest.mark.parametrize(
    ("frame", "told"),
    [
        (command(Opcode.FREEZE, owner=1, freeze=1), "it was told COMMAND"),
        (stray_answer(Result.DONE), "it answered what was not asked here"),
    ],
)
def test_single_forged_command_or_answer_is_an_incident(link, client, frame, told):
    link.waiting.append(frame)
    drive_for(client, 1, LEARNED)

    assert f"somebody else commands the robot: {told}" in str(client.incidents)


def test_echo_of_an_own_command_causes_no_incident(link, client):
    link.waiting.append([frame for frame in link.sent if frame.id == PROTOCOL.id_of("COMMAND")][-1])
    drive_for(client, 1, LEARNED)

    assert client.incidents == []


def test_robot_driven_by_another_simulator_is_left_alone():
    link = MeddledLink()
    link.waiting.extend([PROTOCOL.encode_senses(senses(tick), tick) for tick in (1, 2)])

    with connected(link) as client, pytest.raises(RivalError, match="node 1 is driven by another simulator"):
        handshake(client, 1.0, shared=True)

    assert link.sent == []


@pytest.mark.parametrize("heard_first", ["the first", "the second"])
def test_twin_ends_the_run(link, client, heard_first):
    said_by_twin = drives_in(client.log.frames)[-1]

    if heard_first == "the second":  # whose reports look like those of a robot that has started anew
        link.reboot()
    for _ in range(3):
        link.put(said_by_twin)

    with pytest.raises(TwinError, match="two robots are node 1"):
        drive_for(client, 1, LEARNED)


def heartbeat(**signals: int) -> Frame:
    said = {"counter": 0, "state": 1, "frozen": 0, "lockstep": 1, "silent": 0, "profile": 0, "owner": 1, "uptime": 9}
    return PROTOCOL.encode("HEARTBEAT", {**said, "layout": PROTOCOL.layout, **signals})


@pytest.mark.parametrize(
    ("said", "lost"), [({"state": 0}, "reports that it is stopped"), ({"owner": 9}, "obeys simulator 9")]
)
@pytest.mark.parametrize("silent", [0, 1])
def test_heartbeat_of_a_lost_session_is_believed_even_in_silence(said, lost, silent):
    client = learned(MeddledLink(), 10)
    last = [frame for frame in client.log.frames if frame.id == PROTOCOL.id_of("HEARTBEAT")][-1]

    with pytest.raises(SessionLostError, match=lost):
        client.inbox.take(heartbeat(counter=(counter_of(last) + 1) % 15, silent=silent, **said))


@pytest.mark.parametrize("lockstep", [True, False])
def test_silence_drive_is_accepted_only_in_real_time(lockstep):
    client = learned(MeddledLink(), 10 * lockstep, lockstep=lockstep)
    signals = {"counter": 0, "tick": 9, "left": 0, "right": 0, "repeat_count": 0, "eat": 0, "action": 0}

    drive = client.inbox.take(PROTOCOL.encode("DRIVE", {**signals, "reason": Reason.SILENCE}))
    client.inbox.take(heartbeat(silent=1))

    assert (drive is None) == lockstep
    assert client.inbox.silent


def test_robot_taken_over_by_another_simulator_is_stopped(link, client):
    link.change = altered("HEARTBEAT", lambda _: {"owner": 9})

    with pytest.raises(RivalError, match=r"simulator 9 has taken over node 1 at tick \d+"):
        drive_for(client, 60, LEARNED)
    assert is_stopped(link)


def test_different_drives_for_one_tick_make_the_result_doubtful(link, client):
    (said,) = drives_in(client.log.frames)[-1:]

    link.waiting += altered("DRIVE", lambda it: {"left": it["left"] ^ 1})(said)
    drive_for(client, 5, LEARNED)

    assert "in the robot's name" in str(client.incidents)


@pytest.mark.parametrize("ahead", range(1, 8))
def test_forged_memory_does_not_change_the_result(link, client, ahead):
    clean = learned(MeddledLink())
    last = [frame for frame in client.log.frames if frame.id == PROTOCOL.id_of("MEMORY")][-1]
    counter = (counter_of(last) + ahead) % 15
    for half in range(2):
        cells = {f"cell_{4 * half + cell}": 0 for cell in range(4)}
        link.waiting.append(PROTOCOL.encode("MEMORY", {"counter": counter, "half": half, **cells}))

    for each in (clean, client):
        drive_for(each, 100, LEARNED)
        settle(each)
        stop(each)

    assert client.memory == clean.memory != (0,) * 8


def test_refused_command_of_another_sender_changes_no_result(link, client):
    link.waiting.append(stray_answer(Result.OWNED))

    assert drive_for(client, 100, LEARNED) == drive_for(learned(MeddledLink()), 100, LEARNED)
    assert client.incidents == []


def test_undisturbed_run_has_no_incidents():
    with connected(MeddledLink()) as client:
        run(client, 50)

    assert client.incidents == []


def test_late_report_is_not_taken_for_the_requested_one(link, client):
    link.put(command(Opcode.REPORT, owner=1))
    link.waiting.popleft()
    drives = drive_for(client, 5, LEARNED)

    assert [drive.tick for drive in drives] == [(LEARNED + tick) % 256 for tick in range(5)]
    assert client.incidents == []
