"""A robot that starts anew, has a twin or a second commander, or is spoken for by others: noticed, and named."""

import time
from collections import deque
from collections.abc import Callable

import pytest

from host_sim.client.commands import freeze, start, stop
from host_sim.client.handshake import handshake
from host_sim.client.pacing import RealTime
from host_sim.client.robot_client import RobotClient
from host_sim.client.supervision import settle
from host_sim.errors import FirmwareError, RivalError, RobotError, TwinError
from host_sim.protocol.codec import Frame, counter_of, crc8
from host_sim.protocol.generated import Opcode
from host_sim.transport.in_process_link import InProcessLink
from tests.client.support import PROTOCOL, connected, drive_for, drives_in, run, senses

LEARNED = 300
"""A tick by which the robot has learned something."""


class MeddledLink:
    """A robot, and somebody who meddles with it."""

    def __init__(self) -> None:
        self.robot = InProcessLink()
        self.sent: list[Frame] = []
        self.waiting: deque[Frame] = deque()
        self.change: Callable[[Frame], list[Frame]] = lambda frame: [frame]

    def send(self, frame: Frame) -> None:
        self.sent.append(frame)
        self.put(frame)

    def put(self, frame: Frame) -> None:
        """Somebody sends the robot a frame; its answers are on the bus for all to hear."""
        self.robot.send(frame)
        while (answer := self.robot.receive(0.0)) is not None:
            self.waiting.extend(self.change(answer))

    def reboot(self, memory: tuple[int, ...] = (0,) * 8) -> None:
        """The robot loses its power and comes back with a memory."""
        self.robot = InProcessLink(memory=memory)

    def receive(self, timeout_s: float) -> Frame | None:
        if self.waiting:
            return self.waiting.popleft()
        time.sleep(timeout_s)
        return None

    def close(self) -> None:
        self.robot.close()


def learned(link: MeddledLink, ticks: int = LEARNED, **options) -> RobotClient:
    """A client whose robot has been running for some time."""
    with connected(link, **options) as client:
        handshake(client, client.deadline_s)
        start(client, 1, 0, {"turn_deg": 20}, None)
        drive_for(client, ticks)
    return client


def command(opcode: Opcode, owner: int, **signals: int) -> Frame:
    return PROTOCOL.encode("COMMAND", {"counter": 9, "opcode": opcode, "owner": owner, **signals})


def is_stopped(link: MeddledLink) -> bool:
    """Whether the last thing that the robot was told is to stop."""
    last = PROTOCOL.decode(link.sent[-1])
    return last is not None and last.name == "COMMAND" and last.signals["opcode"] == Opcode.STOP


def test_a_robot_that_restarts_gets_its_memory_back_and_goes_on():
    link = MeddledLink()
    client = learned(link)
    before = client.memory
    assert before != (0,) * 8

    link.reboot()
    drives = drive_for(client, 20, LEARNED)

    assert [drive.tick for drive in drives] == [(LEARNED + tick) % 256 for tick in range(20)]
    assert any(drive.left_mm_s for drive in drives)
    assert client.memory == before
    (incident,) = client.incidents
    assert str(incident).startswith(
        f"at tick {LEARNED} (node 1) the robot restarted (power_on) with its memory restored"
    )


def test_a_robot_that_restarts_with_its_memory_keeps_it():
    link = MeddledLink()
    client = learned(link)

    link.reboot(client.memory)
    drive_for(client, 20, LEARNED)

    assert "memory kept" in str(client.incidents)


def test_a_frozen_robot_that_restarts_is_frozen_again():
    link = MeddledLink()
    client = learned(link)
    freeze(client, True)

    link.reboot()
    drive_for(client, 60, LEARNED)

    assert client.reports.heartbeat["frozen"] == 1


@pytest.mark.parametrize("tick", [0, 1, 2, 49, 50, 51])
def test_a_robot_that_restarts_early_is_noticed_within_a_tick(tick):
    link = MeddledLink()
    client = learned(link, tick)

    link.reboot()
    drive_for(client, 1, tick)

    assert [incident.tick for incident in client.incidents] == [tick]


def test_a_robot_that_restarts_on_a_bad_bus_is_noticed_too():
    link = MeddledLink()
    client = learned(link, faults=("drop:30%", "delay:0-100ms"))
    before = client.memory

    link.reboot()
    drive_for(client, 20, LEARNED)

    assert client.memory == before
    assert "restarted" in str(client.incidents)


def test_a_robot_that_restarts_at_the_end_of_an_environment_is_noticed():
    link = MeddledLink()
    client = learned(link, faults=("drop@40-42",))

    link.reboot()
    settle(client)
    stop(client)

    assert "restarted" in str(client.incidents)


def test_a_robot_that_comes_back_with_another_firmware_ends_the_run():
    link = MeddledLink()
    client = learned(link)

    def newer(frame: Frame) -> list[Frame]:
        if frame.id != PROTOCOL.id_of("BOOT"):
            return [frame]
        data = frame.data[:4] + bytes([frame.data[4] ^ 1]) + frame.data[5:]
        return [Frame(frame.id, bytes([crc8(frame.id, data)]) + data[1:])]

    link.change = newer
    link.reboot()

    with pytest.raises(FirmwareError, match=f"another firmware at tick {LEARNED}: commit"):
        drive_for(client, 1, LEARNED)


def test_a_robot_that_somebody_else_stops_ends_the_run():
    link = MeddledLink()
    client = learned(link)

    link.put(command(Opcode.STOP, owner=2))

    with pytest.raises(RivalError, match="somebody else stopped node 1"):
        drive_for(client, 1, LEARNED)


def test_a_robot_that_somebody_else_starts_ends_the_run():
    link = MeddledLink()
    client = learned(link)

    link.put(command(Opcode.STOP, owner=7))
    link.put(command(Opcode.START, owner=7, profile=0, lockstep=1, seed=9))

    with pytest.raises(RivalError, match=f"node 1 obeys another simulator .tick {LEARNED}"):
        drive_for(client, 1, LEARNED)


@pytest.mark.parametrize("rival", [PROTOCOL.encode_senses(senses(7), 3), command(Opcode.FREEZE, owner=3, freeze=1)])
def test_another_simulator_that_is_heard_ends_the_run_and_the_wheels_rest(rival):
    link = MeddledLink()
    client = learned(link)

    link.waiting.extend([rival, rival])

    with pytest.raises(RivalError, match=f"another simulator commands node 1, heard at tick {LEARNED}"):
        drive_for(client, 1, LEARNED)
    assert is_stopped(link)


def test_a_single_frame_of_another_simulator_may_be_noise():
    link = MeddledLink()
    client = learned(link)

    link.waiting.append(command(Opcode.STOP, owner=3))
    drive_for(client, 1, LEARNED)

    assert client.frames.refused == 1


def test_a_robot_that_another_simulator_drives_is_left_alone():
    link = MeddledLink()
    link.waiting.extend([PROTOCOL.encode_senses(senses(tick), tick) for tick in (1, 2)])

    with connected(link) as client, pytest.raises(RivalError, match="node 1 is driven by another simulator"):
        handshake(client, 1.0, shared=True)

    assert link.sent == []


def test_a_twin_ends_the_run():
    link = MeddledLink()
    client = learned(link)
    said_by_twin = drives_in(client.log.frames)[-1]

    for _ in range(3):
        link.put(said_by_twin)

    with pytest.raises(TwinError, match="two robots are node 1"):
        drive_for(client, 1, LEARNED)


def test_two_different_drives_for_one_tick_make_the_result_doubtful():
    link = MeddledLink()
    client = learned(link)
    (said,) = drives_in(client.log.frames)[-1:]
    data = said.data[:3] + bytes([said.data[3] ^ 1]) + said.data[4:]

    link.waiting.append(Frame(said.id, bytes([crc8(said.id, data)]) + data[1:]))
    drive_for(client, 5, LEARNED)

    assert "in the robot's name" in str(client.incidents)


@pytest.mark.parametrize("ahead", range(1, 8))
def test_a_forged_memory_does_not_last(ahead):
    clean, link = learned(MeddledLink()), MeddledLink()
    client = learned(link)
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


def test_a_false_alarm_changes_nothing():
    quiet, alarmed = MeddledLink(), MeddledLink()
    clients = [learned(quiet), learned(alarmed)]
    stray = PROTOCOL.encode("ANSWER", {"counter": 14, "opcode": Opcode.GET, "result": 0, "which": 0, "value": 0})

    alarmed.waiting.append(stray)
    drives = [drive_for(client, 100, LEARNED) for client in clients]

    assert drives[0] == drives[1]
    assert clients[1].incidents == []


def test_in_real_time_a_robot_that_restarts_is_noticed_and_goes_on():
    link = MeddledLink()
    with connected(link, lockstep=False) as client:
        handshake(client, client.deadline_s)
        start(client, 1, 0, {}, None)
        pace = RealTime([client], 0.002)
        for tick in range(10):
            pace.exchange([senses(tick)])

        link.reboot()
        drives = [pace.exchange([senses(tick)])[0] for tick in range(10, 30)]

    assert "restarted" in str(client.incidents)
    assert client.incidents[0].tick <= 12
    assert drives[-1].left_mm_s or drives[-1].right_mm_s


def test_in_real_time_a_robot_that_is_missing_for_a_second_makes_the_result_doubtful():
    link = MeddledLink()
    with connected(link, lockstep=False) as client:
        handshake(client, client.deadline_s)
        start(client, 1, 0, {}, None)
        pace = RealTime([client], 0.002)
        pace.exchange([senses(0)])
        link.change = lambda _: []
        for tick in range(1, 510):
            pace.exchange([senses(tick)])

    (incident,) = client.incidents
    assert "did not answer for 1 s" in str(incident)
    assert incident.tick == 500


def test_a_robot_in_real_time_that_is_gone_ends_the_run():
    link = MeddledLink()
    client = learned(link, 0, lockstep=False)
    client.deadline_s = 0.2
    pace = RealTime([client], 0.02)
    link.change = lambda _: []
    for tick in range(10):
        pace.exchange([senses(tick)])

    with pytest.raises(RobotError, match=r"did not answer tick 10 within 0.2 s"):
        pace.exchange([senses(10)])


def test_a_run_that_nobody_meddles_with_has_no_incidents():
    with connected(MeddledLink()) as client:
        run(client, 50)

    assert client.incidents == []


def test_a_report_that_was_on_its_way_is_not_taken_for_the_one_that_was_asked_for():
    link = MeddledLink()
    client = learned(link)

    link.put(command(Opcode.REPORT, owner=1))
    link.waiting.popleft()
    drives = drive_for(client, 5, LEARNED)

    assert [drive.tick for drive in drives] == [(LEARNED + tick) % 256 for tick in range(5)]
    assert client.incidents == []
