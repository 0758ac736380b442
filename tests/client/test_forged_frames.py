"""Commands and senses that somebody else sends: the result is doubtful within a second."""

from collections.abc import Callable

import pytest

from host_sim.base.errors import RivalError
from host_sim.client.commands import freeze, stop, write_cells
from host_sim.client.robot_client import RobotClient
from host_sim.protocol.codec import Frame
from tests.client.support import OBEYED, PROTOCOL, Listener, altered, begun, run_for, senses

AT, SECOND = 120, 50
REPORT = 6
"""Ticks over which the parts of a report are spread."""

PACES = pytest.mark.parametrize("lockstep", [True, False], ids=["lockstep", "real time"])


@pytest.fixture
def link() -> Listener:
    return Listener()


@pytest.fixture
def lockstep() -> bool:
    """The pace of a test that is not tried at both."""
    return True


@pytest.fixture
def client(link, lockstep) -> RobotClient:
    """A client whose robot has run for `AT` ticks."""
    client = begun(link, lockstep=lockstep)
    run_for(client, link, range(AT))
    return client


def forged(link: Listener, tick: int, counter: int) -> Frame:
    return PROTOCOL.encode_senses(senses(tick, link.odometer)._replace(feel=21), counter % 15)


def assert_doubtful(client: RobotClient, link: Listener) -> None:
    run_for(client, link, range(AT, AT + SECOND + 1))
    assert "somebody else commands" in str(client.incidents)
    assert client.incidents[0].tick <= AT + SECOND


def on_the_bus(link: Listener, frame: Frame) -> None:
    link.waiting.append(frame)
    link.put(frame)


WAYS: dict[str, Callable[[Listener, Frame], None]] = {
    "on a bus": on_the_bus,
    "in between": Listener.put,
    "in between, and keeping the answer": Listener.put_unheard,
}


@pytest.mark.parametrize("name", OBEYED)
@pytest.mark.parametrize("way", WAYS)
@PACES
def test_forged_command_is_detected_within_a_second(link, client, name, way, lockstep):
    WAYS[way](link, link.forged(name, lockstep=lockstep))

    assert_doubtful(client, link)


@PACES
def test_forged_stop_ends_the_run(link, client, lockstep):
    link.put(link.forged("stop", lockstep=lockstep))

    with pytest.raises(RivalError, match="somebody else stopped node 1"):
        run_for(client, link, range(AT, AT + SECOND))


@pytest.mark.parametrize("name", OBEYED)
def test_forged_command_before_the_end_is_detected_at_the_end(link, client, name):
    link.put_unheard(link.forged(name, lockstep=True))
    stop(client)

    assert "does not hold what it was told here" in str(client.incidents)


def test_altered_memory_is_detected_at_the_end(link, client):
    link.change = altered("MEMORY", lambda it: {"cell_7": 2 - it["cell_7"] // 2} if it["half"] else {})
    stop(client)

    assert "does not hold what it was told here" in str(client.incidents)


def of_tick(tick: int) -> Callable[[Frame], bool]:
    return lambda frame: frame.id == PROTOCOL.id_of("SENSES") and PROTOCOL.decode(frame).signals["tick"] == tick


@pytest.mark.parametrize("at", [0, AT])
def test_altered_senses_are_detected_within_a_second(at):
    link, is_theirs = Listener(), of_tick(at)
    link.swap = lambda frame: forged(link, at, at + 1) if is_theirs(frame) else frame
    client = begun(link, lockstep=True)

    run_for(client, link, range(at + SECOND + REPORT))

    assert "does not hold what it was told here" in str(client.incidents)


@pytest.mark.parametrize("at", [0, AT])
def test_altered_drive_is_detected_within_a_second(link, at):
    client = begun(link, lockstep=True)
    change = altered("DRIVE", lambda it: {"left": it["left"] - 1} if it["tick"] == at else {})
    link.change = lambda frame: link.obey(frame) and change(frame)

    run_for(client, link, range(at + SECOND + REPORT))

    assert "does not hold what it was told here" in str(client.incidents)


def test_altered_last_senses_are_detected_at_the_end():
    link, is_theirs = Listener(), of_tick(AT - 1)
    link.swap = lambda frame: forged(link, AT - 1, AT) if is_theirs(frame) else frame
    client = begun(link, lockstep=True)
    run_for(client, link, range(AT))
    before = list(client.incidents)

    stop(client)

    assert before == []
    assert "does not hold what it was told here" in str(client.incidents)


@pytest.mark.parametrize(
    ("lost", "altered"), [("HEALTH", True), ("DRIVE", True), ("HEALTH", False), ("DRIVE", False)]
)
def test_altered_senses_are_detected_if_the_final_report_is_lost(lost, altered):
    link, is_theirs, ending = Listener(), of_tick(AT - 1), list[Frame]()
    link.swap = lambda frame: forged(link, AT - 1, AT) if altered and is_theirs(frame) else frame
    client = begun(link, lockstep=True)
    run_for(client, link, range(AT))

    def lose_one(frame: Frame) -> list[Frame]:
        is_lost = frame.id == PROTOCOL.id_of(lost) and not ending
        ending.extend([frame] * is_lost)
        return [] if is_lost else [frame]

    link.change = lose_one
    stop(client)

    assert ending
    assert ("does not hold what it was told here" in str(client.incidents)) == altered


def test_late_health_causes_no_incident(link):
    client = begun(link, lockstep=True)
    held_up: list[Frame] = []

    def hold_up(frame: Frame) -> list[Frame]:
        is_health = frame.id == PROTOCOL.id_of("HEALTH")
        held_up.extend([frame] * is_health)
        return [] if is_health else link.obey(frame)

    link.change = hold_up
    run_for(client, link, range(AT))
    link.change = link.obey
    link.waiting.extend(held_up)
    run_for(client, link, range(AT, AT + SECOND))
    stop(client)

    assert len(held_up) > 1
    assert client.incidents == []


def test_last_senses_without_a_received_answer_cause_no_incident(link, client):
    client.send_senses(senses(AT, link.odometer))  # and the run is ended before the answer is taken
    stop(client)

    assert client.incidents == []


@PACES
def test_own_commands_cause_no_incident(link, lockstep):
    client = begun(link, lockstep=lockstep)

    run_for(client, link, range(60))
    write_cells(client, {1: 1, 6: 2})
    run_for(client, link, range(60, 115))
    freeze(client, True)
    run_for(client, link, range(115, 180))
    stop(client)

    assert client.incidents == []


def test_stop_clears_the_check_value_of_an_earlier_owner(link):
    begun(link, lockstep=True)
    client = begun(link, lockstep=True)

    run_for(client, link, range(AT))
    stop(client)

    assert client.incidents == []


@PACES
@pytest.mark.parametrize("ahead", [1, 2, 14])
def test_single_forged_senses_on_the_bus_are_detected(link, client, ahead):
    link.waiting.append(forged(link, AT - 1 + ahead, AT + ahead))

    assert_doubtful(client, link)
    assert client.incidents[0].tick < AT + 2


def test_forged_ranges_on_the_bus_are_detected(link, client):
    link.waiting.append(PROTOCOL.encode_ranges(client.ranges, AT % 256, (AT + 1) % 15))

    assert_doubtful(client, link)


@PACES
def test_senses_seen_only_by_the_robot_are_detected_by_check_value(link, client):
    link.put_unheard(forged(link, AT, AT + 1))

    assert_doubtful(client, link)


@PACES
@pytest.mark.parametrize(("tick", "counter"), [(AT, AT), (AT - 2, AT - 1), (AT + 100, AT + 101)])
def test_forged_senses_that_the_robot_refuses_cause_no_incident(link, client, tick, counter):
    link.waiting.append(forged(link, tick, counter))
    run_for(client, link, range(AT, AT + SECOND + 1))

    assert client.incidents == []
