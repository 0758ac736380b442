"""Commands: what they change, and what becomes of one that is not answered or not taken."""

import pytest

from host_sim.base.errors import RefusedError, RobotError
from host_sim.client.commands import erase_memory, freeze, handshake, start, stop, write_cells
from host_sim.client.robot_client import INCIDENTS_MAX
from host_sim.client.session import Session, Told
from host_sim.protocol.codec import Frame, counter_of
from host_sim.protocol.generated import Opcode, Result
from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig
from tests.client.meddled_link import MeddledLink, learned
from tests.client.support import PROTOCOL, connected, drive_for

NOTHING = (0,) * 8


def test_turns_are_written_and_erased():
    client = learned(MeddledLink(), 10)

    write_cells(client, {1: 2, 6: 1})
    assert client.memory == (0, 2, 0, 0, 0, 0, 1, 0)
    write_cells(client, {3: 1})
    assert client.memory == (0, 2, 0, 1, 0, 0, 1, 0)

    erase_memory(client)
    assert client.memory == NOTHING


def test_a_memory_of_nothing_leaves_no_half_of_another_one():
    link = MeddledLink()
    link.reboot((0, 1, 0, 0, 2, 0, 0, 0))
    with connected(link) as client:
        handshake(client, 1.0)
        start(client, Session(1), NOTHING)

    assert client.memory == NOTHING


def test_a_robot_that_was_not_started_yet_can_be_frozen():
    with connected(MeddledLink()) as client:
        handshake(client, 1.0, shared=True)
        freeze(client, on=True)

    assert client.inbox.session is None


def test_a_command_that_is_not_answered_is_named():
    link = MeddledLink()
    client = learned(link, 10, deadline_s=0.1)
    link.change = lambda _: []

    with pytest.raises(RobotError, match=r"the robot did not answer freeze within 0.1 s; last frame from it: "):
        freeze(client, on=True)


def test_a_command_that_is_out_of_sequence_again_and_again_is_refused():
    link = MeddledLink()
    client = learned(link, 10)

    def refuse(frame: Frame) -> list[Frame]:
        decoded = PROTOCOL.decode(frame)
        if decoded is None or decoded.name != "ANSWER":
            return [frame]
        result = {"opcode": Opcode.FREEZE, "result": Result.OUT_OF_SEQUENCE, "which": 0, "value": 0}
        return [PROTOCOL.encode("ANSWER", {"counter": counter_of(frame), **result})]

    link.change = refuse

    with pytest.raises(RefusedError, match="out_of_sequence"):
        freeze(client, on=True)


@pytest.mark.parametrize("message", ["MEMORY", "HEALTH", "DRIVE"])
def test_a_robot_that_never_reports_all_is_given_up_soon_and_told_what_is_missing(message):
    link = MeddledLink()
    client = learned(link, 10)
    link.change = lambda frame: [] if frame.id == PROTOCOL.id_of(message) else [frame]
    began_s = client.connection.now()

    with pytest.raises(RobotError, match=f"after stop, the robot did not send .*{message}"):
        stop(client)

    assert client.connection.now() - began_s < 60


def test_a_robot_that_restarts_between_the_halves_of_its_memory_is_not_started_with_half_of_it():
    link = MeddledLink()
    half = PROTOCOL.id_of("MEMORY")

    def restart(frame: Frame) -> list[Frame]:
        if frame.id == half and frame.data[1] >> 4 == 1:
            link.reboot()
            link.change = lambda frame: [frame]
        return [frame]

    with connected(link) as client:
        handshake(client, client.connection.deadline_s)
        link.change = restart
        with pytest.raises(RobotError, match="node 1 does not hold the memory that was just written to it"):
            start(client, Session(1), (0, 1, 0, 1, 2, 0, 2, 0))


def test_the_distances_go_before_the_senses_and_are_repeated_with_them():
    with connected(faults=("drop:30%",)) as client:
        handshake(client, client.connection.deadline_s)
        start(client, Session(1, PROTOCOL.choices("COMMAND", "profile")["distance"]))
        drive_for(client, 50)

    sent = [name for frame in client.log.frames if (name := PROTOCOL.decode(frame).name) in ("RANGES", "SENSES")]
    assert sent == ["RANGES", "SENSES"] * 50
    assert client.frames.repeated > 0


def test_of_many_incidents_the_later_ones_are_only_counted():
    client = learned(MeddledLink(), 1)

    for _ in range(INCIDENTS_MAX + 2):
        client.distrust("it rattles")

    assert (len(client.incidents), client.unlisted) == (INCIDENTS_MAX, 2)


def test_the_log_has_the_reports_of_the_handshake_even_if_the_first_answer_is_lost():
    link, lost = MeddledLink(), []

    def lose_first_answer(frame: Frame) -> list[Frame]:
        lost.append(frame.id == PROTOCOL.id_of("ANSWER") and True not in lost)
        return [] if lost[-1] else [frame]

    link.change = lose_first_answer
    with connected(link) as client:
        handshake(client, client.connection.deadline_s)

    names = [decoded.name for frame in client.log.frames if (decoded := PROTOCOL.decode(frame)) is not None]
    assert True in lost
    assert names[:2] == ["COMMAND", "ANSWER"]
    assert {"HEARTBEAT", "BOOT", "MEMORY", "FAULTS", "HEALTH"} <= set(names)


def test_a_memory_that_a_person_changes_after_an_environment_is_not_one_lost_on_the_way():
    with make(RunConfig(environments=1, limit_s=1.0)) as simulation:
        list(simulation.run())
        (client,) = simulation.clients
        write_cells(client, {1: 1})
        stop(client)

    assert client.incidents == []


@pytest.mark.parametrize(("lockstep", "takes_senses"), [(True, True), (False, True), (True, False)])
def test_only_senses_asked_in_lockstep_of_a_robot_that_takes_them_are_held(lockstep, takes_senses):
    told, asked = Told(takes_senses=takes_senses), Frame(0x101, bytes(range(8)))

    told.ask(asked if lockstep else None)
    told.take_drive(Frame(0x201, bytes(8)))

    assert (told.heard != 0) == (lockstep and takes_senses)
