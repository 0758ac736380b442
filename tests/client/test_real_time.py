"""Real time with many robots: the world's clock goes as the wall's, or the run says how much slower it was."""

import math
from collections import deque

import pytest

from host_sim.client.commands import handshake, start, stop
from host_sim.client.connection import Connection
from host_sim.client.deadlines import Limits
from host_sim.client.pacing import RealTime
from host_sim.client.robot_client import RobotClient
from host_sim.client.session import Session
from host_sim.protocol.codec import Frame, Protocol
from host_sim.sim.in_process_link import InProcessLink
from tests.client.support import Diary, senses

TICK_S = 0.02
TICKS = 100
ROBOTS = 28


class Host:
    """A clock that passes while somebody waits, or while the host is busy."""

    def __init__(self) -> None:
        self.now_s = 0.0

    def now(self) -> float:
        return self.now_s


class SocketOnHost:
    """A robot behind a socket that is waited for as the kernel does: in whole milliseconds, rounded up."""

    def __init__(self, host: Host, node: int) -> None:
        self.host, self.robot, self.deaf = host, InProcessLink(node), False
        self.answers: deque[Frame] = deque()

    def send(self, frame: Frame) -> None:
        self.robot.send(frame)
        answers = self.robot.taken()
        self.answers += [] if self.deaf else answers

    def receive(self, timeout_s: float) -> Frame | None:
        if self.answers:
            return self.answers.popleft()
        self.host.now_s += math.ceil(timeout_s * 1000) / 1000
        return None

    def close(self) -> None:
        self.robot.close()


@pytest.fixture
def host() -> Host:
    return Host()


@pytest.fixture
def clients(host) -> list[RobotClient]:
    found = []
    for node in range(1, 1 + ROBOTS):
        connection = Connection(SocketOnHost(host, node), now=host.now)
        client = RobotClient(connection, Protocol(node), Diary(), lockstep=False)
        client.deadlines.limits = Limits(behind_percent=5.0)
        handshake(client, 1.0)
        start(client, Session(1))
        found.append(client)
    return found


def run(clients: list[RobotClient], host: Host, busy_s: float = 0.0) -> float:
    """How many seconds the host's clock goes while the world's goes `TICKS` ticks, each with some work."""
    pace, began_s = RealTime(clients, TICK_S), host.now_s
    for tick in range(TICKS):
        host.now_s += busy_s
        pace.exchange([senses(tick)] * len(clients))
    return host.now_s - began_s


@pytest.mark.parametrize("deaf", [0, 1, ROBOTS])
def test_full_bus_of_robots_takes_no_longer_than_a_single_robot(clients, host, deaf):
    for client in clients[:deaf]:
        client.connection.link.deaf = True

    assert run(clients, host) == pytest.approx(TICKS * TICK_S, abs=2 * TICK_S)
    assert {client.deadlines.late for client in clients} == {0}
    assert [client.deadlines.unanswered for client in clients] == [TICKS] * deaf + [0] * (ROBOTS - deaf)


def test_occasionally_late_host_catches_up(clients, host):
    pace, began_s = RealTime(clients[:1], TICK_S), host.now_s
    for tick in range(TICKS):
        host.now_s += 0.9 * TICK_S if tick % 10 else 1.9 * TICK_S
        pace.exchange([senses(tick)])

    assert host.now_s - began_s == pytest.approx(TICKS * TICK_S, abs=2 * TICK_S)
    assert clients[0].deadlines.speed == 1.0


@pytest.mark.parametrize(("of_a_tick", "speed"), [(1.04, 0.96), (1.1, 0.91), (1.66, 0.6), (3.0, 0.33)])
def test_slow_host_reports_its_clock_speed(clients, host, of_a_tick, speed):
    client = clients[0]
    took_s = run([client], host, of_a_tick * TICK_S)
    stop(client)

    told = client.deadlines.summary()
    assert told is not None
    assert told["speed"] == pytest.approx(TICKS * TICK_S / took_s, abs=0.02) == pytest.approx(speed, abs=0.02)
    said = f"this host was too slow for real time: {client.deadlines.speed:.3f} x; the limit is 0.95 x"
    assert any(said in str(incident) for incident in client.incidents) == (speed < 0.95)


def test_pace_rest_does_not_count_as_late(clients, host):
    pace = RealTime(clients, TICK_S)
    for tick in range(TICKS):
        if tick % 10 == 0:
            host.now_s += 3.0
            pace.rest()
        pace.exchange([senses(tick)] * ROBOTS)

    assert clients[0].deadlines.speed == 1.0
    assert clients[0].deadlines.late == 0
