"""Robots in Python that live in a time of their own: seconds of it pass at once."""

import importlib.util
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from host_sim.lab.check.checking import Robots, wake
from host_sim.lab.check.talk import Talk
from host_sim.transport.link import Frame

ROOT = Path(__file__).resolve().parents[3]
EXAMPLE = ROOT / "examples" / "robot" / "robot.py"
_spec = importlib.util.spec_from_file_location("example_robot", EXAMPLE)
assert _spec is not None
assert _spec.loader is not None
example = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(example)


class VirtualRobot:
    """A link to a robot, and the clock that both live by."""

    def __init__(self, robot) -> None:
        self.robot, self.now_ms, self.hung_until_ms = robot, 1000, 0
        self.queue: list[tuple[int, bytes]] = []
        self.said: deque[Frame] = deque(Frame(*frame) for frame in robot.power_up(1000))

    def send(self, frame: Frame) -> None:
        self.queue.append((frame.id, frame.data))
        self.let_it_look()

    def let_it_look(self) -> None:
        if self.now_ms >= self.hung_until_ms:
            queue, self.queue = self.queue, []
            self.said.extend(Frame(*frame) for frame in self.robot.step(queue, self.now_ms))

    def hang(self, span_ms: int) -> None:
        self.hung_until_ms = self.now_ms + span_ms

    def now(self) -> float:
        return self.now_ms / 1000

    def receive(self, _link: "VirtualRobot", timeout_s: float) -> Frame | None:
        end_ms = self.now_ms + round(1000 * timeout_s)
        while not self.said and self.now_ms < end_ms:
            self.now_ms += 1
            self.let_it_look()
        return self.said.popleft() if self.said else None


def one_for_all(robot: object) -> Robots:
    """One robot for all checks, as on a bus where it is already."""
    there = VirtualRobot(robot)

    @contextmanager
    def opened() -> Iterator[Talk]:
        there.said.clear()
        talk = Talk(there, there)
        wake(talk)
        yield talk

    return opened


def virtual(make: Callable[[], object]) -> Robots:
    """Robots that are made anew for each check."""

    @contextmanager
    def opened() -> Iterator[Talk]:
        robot = VirtualRobot(make())
        talk = Talk(robot, robot, hang=robot.hang)
        wake(talk)
        yield talk

    return opened
