"""A robot that starts anew or is gone: noticed, named, and given its memory back."""

import pytest

from host_sim.base.errors import FirmwareError, RefusedError, RobotError, SessionLostError
from host_sim.client.commands import freeze, stop
from host_sim.client.pacing import Lockstep, RealTime
from host_sim.client.supervision import settle
from tests.client.support import LEARNED, MeddledLink, altered, begun, drive_for, learned, senses


def test_restarted_robot_gets_its_memory_back_and_continues(link, client):
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


def test_restarted_robot_with_its_memory_keeps_it(link, client):
    link.reboot(client.memory)
    drive_for(client, 20, LEARNED)

    assert "memory kept" in str(client.incidents)


def test_restarted_frozen_robot_is_frozen_again(link, client):
    freeze(client, True)

    link.reboot()
    drive_for(client, 60, LEARNED)

    assert client.reports.heartbeat["frozen"] == 1


@pytest.mark.parametrize("tick", [0, 1, 2, 49, 50, 51])
def test_early_restart_is_detected_within_a_tick(link, tick):
    client = learned(link, tick)

    link.reboot()
    drive_for(client, 1, tick)

    assert [incident.tick for incident in client.incidents] == [tick]


def test_robot_halted_by_its_wheels_is_left_stopped():
    client = learned(MeddledLink(), 10)
    pace = Lockstep([client])

    drives = [pace.exchange([senses(tick)])[0] for tick in range(10, 600)]

    assert (drives[-1].left_mm_s, drives[-1].right_mm_s) == (0, 0)
    assert client.inbox.session is not None
    assert client.inbox.session.halted
    assert "the wheels did not do what they were told, and the robot has stopped" in str(client.incidents)


def test_memory_lost_at_the_end_makes_the_result_doubtful(client):
    client.settle()
    client.reports.gap = 1

    client.check_settled()

    (incident,) = client.incidents
    assert "its last memory may have been lost on the way" in str(incident)


def test_robot_that_restarts_five_times_is_given_up(link, client, monkeypatch):
    def lose() -> None:
        link.reboot()
        raise SessionLostError("it started anew", booted=True)

    monkeypatch.setattr(client, "await_drive", lose)

    with pytest.raises(SessionLostError, match="started anew"):
        drive_for(client, 1, LEARNED)
    assert str(client.incidents).count("restarted") == 5


def test_restart_on_a_faulty_bus_is_detected(link):
    client = learned(link, faults=("drop:30%", "delay:0-100ms"))
    before = client.memory

    link.reboot()
    drive_for(client, 20, LEARNED)

    assert client.memory == before
    assert "restarted" in str(client.incidents)


def test_restart_at_the_end_of_an_environment_is_detected(link):
    client = learned(link, faults=("drop@40-42",))

    link.reboot()
    settle(client)
    stop(client)

    assert "restarted" in str(client.incidents)


def test_restart_with_another_firmware_ends_the_run(link, client):
    link.change = altered("BOOT", lambda it: {"commit": it["commit"] ^ 1})
    link.reboot()

    with pytest.raises(FirmwareError, match=f"another firmware at tick {LEARNED}: commit"):
        drive_for(client, 1, LEARNED)

    assert "another firmware" in str(client.incidents)


def test_failed_restart_makes_the_result_doubtful(link, client):
    link.change = altered("MEMORY", lambda it: {} if it["half"] else {"cell_3": 2 - it["cell_3"] // 2})
    link.reboot()

    with pytest.raises(RobotError, match="does not hold the memory that was just written"):
        drive_for(client, 20, LEARNED)

    assert "does not hold the memory that was just written" in str(client.incidents)


def test_failed_restart_after_a_halt_makes_the_result_doubtful(monkeypatch):
    client = learned(MeddledLink(), 10)
    client.frames.lost += 1000  # which explains why its wheels do not follow
    pace = Lockstep([client])

    def refuse(*_: object) -> None:
        raise RefusedError("it refuses")

    monkeypatch.setattr("host_sim.client.supervision.start", refuse)
    with pytest.raises(RefusedError):
        [pace.exchange([senses(tick)]) for tick in range(10, 600)]

    assert "it refuses" in str(client.incidents)


def test_real_time_restart_is_detected_and_the_robot_continues(link):
    client = begun(link, lockstep=False)
    pace = RealTime([client], 0.002)
    for tick in range(10):
        pace.exchange([senses(tick)])

    link.reboot()
    drives = [pace.exchange([senses(tick)])[0] for tick in range(10, 30)]

    assert "restarted" in str(client.incidents)
    assert client.incidents[0].tick <= 12
    assert drives[-1].left_mm_s or drives[-1].right_mm_s


def test_real_time_gap_of_a_second_makes_the_result_doubtful(link):
    client = begun(link, lockstep=False)
    pace = RealTime([client], 0.002)
    pace.exchange([senses(0)])
    link.change = lambda _: []
    for tick in range(1, 510):
        pace.exchange([senses(tick)])

    (incident,) = client.incidents
    assert "did not answer for 1 s" in str(incident)
    assert incident.tick == 500


def test_real_time_robot_without_answers_ends_the_run(link):
    client = learned(link, 0, lockstep=False, deadline_s=0.2)
    pace = RealTime([client], 0.02)
    link.change = lambda _: []
    for tick in range(10):
        pace.exchange([senses(tick)])

    with pytest.raises(RobotError, match=r"did not answer tick 10 within 0.2 s"):
        pace.exchange([senses(10)])
