"""A robot that takes its time for each frame, as in an emulator on a busy machine: the client must not swamp it."""

from collections import deque
from collections.abc import Iterator

import pytest

from host_sim.base.errors import RobotError
from host_sim.client.commands import handshake, start, stop
from host_sim.client.connection import Connection
from host_sim.client.robot_client import RobotClient
from host_sim.client.session import Session
from host_sim.client.supervision import settle
from host_sim.protocol.codec import Frame
from host_sim.sim.in_process_link import InProcessLink
from tests.client.support import PROTOCOL, Diary, drive_for

FRAME_S = 0.065
"""What the robot needs for a frame: more than the time after which the client repeats one."""
PROMPT_S = 0.001
HELD_UP_S = 4.0
TICKS = 60


class SlowRobot:
    """A link in a virtual time, to a robot that answers frames one after another."""

    def __init__(self) -> None:
        self.frame_s = PROMPT_S
        self.now_s = self.free_s = 0.0
        self.waiting: deque[tuple[float, Frame]] = deque()
        self.robot = InProcessLink()
        self.answers: deque[Frame] = deque()
        self.last = Frame(-1, b"")
        self.stuck = False
        self.rest_s = 0.0  # how late the DRIVE comes that says that it has stopped

    def now(self) -> float:
        return self.now_s

    def hold_up(self, seconds: float) -> None:
        self.free_s = self.now_s + seconds

    def send(self, frame: Frame) -> None:
        self.free_s = max(self.free_s, self.now_s) + self.frame_s
        self.waiting.append((self.free_s, frame))

    def receive(self, timeout_s: float) -> Frame | None:
        give_up_s = self.now_s + timeout_s
        while not self.answers:
            if not self.waiting or self.waiting[0][0] > give_up_s:
                self.now_s = give_up_s
                return None
            done_s, frame = self.waiting.popleft()
            self.now_s = max(self.now_s, done_s)
            self.answers += self.answers_to(frame)
        if self.rest_s and self.answers[0].id == PROTOCOL.id_of("DRIVE"):
            waited_s = min(self.rest_s, give_up_s - self.now_s)
            self.now_s, self.rest_s = self.now_s + waited_s, self.rest_s - waited_s
            if self.rest_s:
                return None
        self.last = self.answers.popleft()
        return self.last

    def answers_to(self, frame: Frame) -> Iterator[Frame]:
        """The robot's, or again and again its last one."""
        if self.stuck:
            yield self.last
            return
        self.robot.send(frame)
        while (answer := self.robot.receive(0.0)) is not None:
            yield answer

    def close(self) -> None:
        self.robot.close()


def running(robot: SlowRobot) -> RobotClient:
    """The client of a robot that was prompt so far, and is slow from now on."""
    client = RobotClient(Connection(robot, now=robot.now), PROTOCOL, Diary())
    handshake(client, client.connection.deadline_s)
    start(client, Session(1, settings={"turn_deg": 20}))
    drive_for(client, TICKS)
    robot.frame_s = FRAME_S
    return client


def test_a_robot_that_was_held_up_catches_up():
    robot = SlowRobot()
    client = running(robot)
    robot.hold_up(HELD_UP_S)

    drive_for(client, TICKS, first=TICKS)

    assert client.incidents == []
    assert robot.now_s < 2 * (HELD_UP_S + TICKS * FRAME_S)


def test_the_end_of_an_environment_waits_for_what_the_robot_still_answers():
    robot = SlowRobot()
    client = running(robot)
    robot.hold_up(1.0)
    drive_for(client, 1, first=TICKS)
    repeated = client.frames.repeated

    settle(client)

    assert client.frames.duplicate == repeated > 0
    assert client.incidents == []


def test_commands_wait_for_a_robot_that_was_held_up():
    robot = SlowRobot()
    robot.frame_s = FRAME_S
    robot.hold_up(HELD_UP_S)
    client = RobotClient(Connection(robot, now=robot.now), PROTOCOL, Diary())

    handshake(client, client.connection.deadline_s)
    start(client, Session(1, settings={"turn_deg": 20}), (0, 1, 2, 1, 2, 0, 2, 1))

    assert robot.now_s < 3 * (HELD_UP_S + client.frames.sent * FRAME_S)


def test_a_robot_that_only_says_what_it_has_said_before_is_given_up():
    robot = SlowRobot()
    client = running(robot)
    robot.stuck = True

    with pytest.raises(RobotError, match=f"did not answer tick {TICKS}"):
        drive_for(client, TICKS, first=TICKS)

    assert robot.now_s < 60


def test_a_robot_that_rests_late_is_not_told_to_stop_twice():
    robot = SlowRobot()
    client = running(robot)
    robot.rest_s = 0.8
    client.log.frames.clear()
    stop(client)

    assert [frame.id for frame in client.log.frames].count(PROTOCOL.id_of("COMMAND")) == 1
    assert robot.rest_s == 0.0
