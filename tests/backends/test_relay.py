"""Robots without a bus hear each other's memories, and nothing else."""

from collections import deque

from host_sim.backends.relay import Relay, RelayedLink
from host_sim.protocol.codec import Frame, Protocol

CELLS = {f"cell_{i}": 1 for i in range(4)}


def memory_of(node: int, counter: int = 0) -> Frame:
    return Protocol(node).encode("MEMORY", {"counter": counter, "half": 0, **CELLS})


class Robot:
    """A link to a robot that says what it is told to."""

    def __init__(self, *says: Frame) -> None:
        self.says, self.heard, self.closed = deque(says), [], False

    def send(self, frame: Frame) -> None:
        self.heard.append(frame)

    def receive(self, timeout_s: float) -> Frame | None:
        del timeout_s
        return self.says.popleft() if self.says else None

    def close(self) -> None:
        self.closed = True


def test_each_robot_hears_the_others_in_order_before_the_next_frame_for_itself():
    said = [memory_of(1, 3), memory_of(1, 4)]
    robots, relay = {1: Robot(*said), 2: Robot(memory_of(2))}, Relay([1, 2])
    links = {node: RelayedLink(robot, relay, node) for node, robot in robots.items()}
    for link in links.values():
        while link.receive(0.0) is not None:
            pass
    senses = [Frame(Protocol(node).id_of("SENSES"), bytes(8)) for node in (1, 2)]

    for link, frame in zip(links.values(), senses, strict=True):
        link.send(frame)
        link.send(frame)

    assert robots[1].heard == [memory_of(2), senses[0], senses[0]]
    assert robots[2].heard == [*said, senses[1], senses[1]]


def test_what_is_no_memory_stays_with_the_simulator():
    other = [Frame(Protocol(1).id_of(name), bytes(8)) for name in ("DRIVE", "HEARTBEAT", "ANSWER")]
    relay = Relay([1, 2])

    for frame in other:
        relay.hear(1, frame)

    assert relay.take(2) == []


def test_closing_closes_the_line():
    robot = Robot()

    RelayedLink(robot, Relay([1]), 1).close()

    assert robot.closed


class RobotBehindSocket(Robot):
    """As such, with a socket, for which the link itself stands."""

    def frame_socket(self) -> "RobotBehindSocket":
        return self


def test_a_robot_has_heard_all_before_its_socket_is_lent():
    relay, robot = Relay([1, 2]), RobotBehindSocket()
    link = RelayedLink(robot, relay, 1)
    relay.hear(2, memory_of(2))

    assert link.frame_socket() is robot
    assert robot.heard == [memory_of(2)]
    assert RelayedLink(Robot(), relay, 1).frame_socket() is None
