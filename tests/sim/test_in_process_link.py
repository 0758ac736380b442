"""A robot in this process answers at once; robots without a bus hear each other's memories.

One tick in Python: a short way through few files, so that a reader can follow it; told as a number that wraps.
"""

import sys
from collections import deque
from pathlib import Path
from types import FrameType

import pytest

import host_sim
from host_sim.base.errors import OctetError
from host_sim.protocol.codec import Frame, Protocol
from host_sim.protocol.generated import TICK_SPAN, Opcode, Senses
from host_sim.recording.run_recorder import RunRecorder
from host_sim.sim.in_process_link import InProcessLink, Program, Relay, RelayedLink
from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig
from host_sim.sim.simulation import Simulation

KNOWS = (0, 1, 0, 0, 2, 0, 0, 0)


def names(protocol: Protocol, frames: list[Frame]) -> list[str]:
    return [decoded.name for frame in frames if (decoded := protocol.decode(frame))]


def stop(link: InProcessLink, protocol: Protocol) -> None:
    """Has the robot report all that there is to be known of it."""
    link.send(protocol.encode("COMMAND", {"counter": 1, "opcode": 1, "owner": 1}))


def test_drive_answers_the_senses_and_no_other_frame_follows():
    link, protocol = InProcessLink(), Protocol()

    link.send(protocol.encode_senses(Senses(0, 0, False, False, 0, 0, 0), 0))

    frame = link.receive(0.0)
    assert frame is not None
    assert protocol.decode_drive(frame) is not None
    assert link.receive(0.0) is None


def test_frames_put_back_come_before_those_waiting_in_c():
    link, protocol = InProcessLink(memory=KNOWS), Protocol()
    stop(link, protocol)
    said = link.taken()

    link.put_back(said[:1], len(said))

    assert link.taken() == [said[0], *said]
    assert names(protocol, said)[:3] == ["ANSWER", "HEARTBEAT", "BOOT"]
    assert link.taken() == []


@pytest.mark.parametrize("wake", [InProcessLink, Program("a.bas", b"while true\nrTurn 5\nrForward 1\nwend\n").robot])
def test_robot_that_goes_back_to_a_state_does_the_same_again(wake):
    link, protocol = wake(), Protocol()
    start = {"counter": 1, "opcode": Opcode.START, "owner": 1, "profile": 0, "seed": 7, "lockstep": 1}
    link.send(protocol.encode("COMMAND", start))
    before, done = link.state, []
    for _ in range(2):
        link.go_back_to(before)
        link.taken()
        for tick in range(50):
            link.send(protocol.encode_senses(Senses(tick, 0, False, False, 0, 0, 0), tick % 15))
        done.append(link.taken())

    assert done[0] == done[1]
    assert len(set(done[0])) > 10


def test_closed_robot_sends_nothing_more():
    link, protocol = InProcessLink(), Protocol()
    stop(link, protocol)

    link.close()

    assert link.receive(0.0) is None


def test_robots_without_a_bus_hear_the_memories_of_each_other():
    relay = Relay([1, 2])
    links = {node: InProcessLink(node, KNOWS, relay=relay) for node in (1, 2)}
    stop(links[1], Protocol(1))
    others = [frame for frame in links[1].taken() if frame.id == Protocol(1).id_of("MEMORY")]
    assert len(others) == 2

    links[2].hear_others()

    assert relay.take(2) == []


def test_c_code_reaches_each_robot_by_pointers_of_its_own():
    links = InProcessLink(1), InProcessLink(2)

    first, second = (link.pointers for link in links)

    assert all(first)
    assert first.octet != second.octet
    assert first[1:] == second[1:]


def test_robot_that_is_alone_hears_nobody():
    link = InProcessLink()

    link.hear_others()

    assert link.taken() == []


def test_missing_library_is_named_with_what_builds_it():
    with pytest.raises(OctetError, match=r"cannot load the firmware: .*/nowhere\.so.*tools/setup"):
        InProcessLink(library=Path("/nowhere.so"))


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


def test_robot_hears_the_others_in_order_before_its_own_next_frame():
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


def test_relay_passes_only_memories_to_other_robots():
    other = [Frame(Protocol(1).id_of(name), bytes(8)) for name in ("DRIVE", "HEARTBEAT", "ANSWER")]
    relay = Relay([1, 2])

    for frame in other:
        relay.hear(1, frame)

    assert relay.take(2) == []


def test_closing_a_relayed_link_closes_the_robot_s_link():
    robot = Robot()

    RelayedLink(robot, Relay([1]), 1).close()

    assert robot.closed


class RobotBehindSocket(Robot):
    """As such, with a socket, for which the link itself stands."""

    def frame_socket(self) -> "RobotBehindSocket":
        return self


def test_relayed_memories_are_sent_before_the_socket_is_lent():
    relay, robot = Relay([1, 2]), RobotBehindSocket()
    link = RelayedLink(robot, relay, 1)
    relay.hear(2, memory_of(2))

    assert link.frame_socket() is robot
    assert robot.heard == [memory_of(2)]
    assert RelayedLink(Robot(), relay, 1).frame_socket() is None


PACKAGE = str(Path(host_sim.__file__).parent)
CALLS_MAX, FILES_MAX = 25, 10
ORDINARY_TICK = 21
"""In the middle of a turn: no action begins, and no report is due."""


@pytest.fixture
def simulation():
    with make(RunConfig(environments=1)) as made:
        made.native = False
        RunRecorder.of(made, boredom_limit=10)
        made.enter(1)
        while made.tick < ORDINARY_TICK:
            made.step()
        yield made


def calls_of_a_step(simulation: Simulation) -> list[str]:
    """The file of each function of ours that is called in a step."""
    files: list[str] = []

    def note(frame: FrameType, event: str, _: object) -> None:
        if event == "call" and frame.f_code.co_filename.startswith(PACKAGE):
            files.append(frame.f_code.co_filename)

    sys.setprofile(note)
    simulation.step()
    sys.setprofile(None)
    return files


def test_tick_in_python_takes_few_calls_and_files(simulation):
    before = simulation.drives[0].action

    files = calls_of_a_step(simulation)

    assert simulation.drives[0].action == before, "this is no ordinary tick"
    assert 10 < len(files) <= CALLS_MAX
    assert len(set(files)) <= FILES_MAX


def test_tick_number_in_senses_wraps_at_the_span_of_the_wire(simulation):
    told = []
    for _ in range(TICK_SPAN):
        simulation.step()
        told.append(simulation.senses[0].tick)

    first = ORDINARY_TICK
    assert told == [*range(first, TICK_SPAN), *range(first)]
