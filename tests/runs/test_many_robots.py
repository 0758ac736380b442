"""Many robots on one bus: on vcan, and behind one slcan adapter."""

import socket
import threading
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass

import can
import pytest

from host_sim.client.robot_reports import REPORTS
from host_sim.protocol.codec import Frame, node_of
from host_sim.protocol.every_node import hear
from host_sim.recording.log_reader import read_log
from host_sim.report.protocol_page import robot_bits_a_second, worst_bits
from tests.report.bits_sent import bits_sent
from tests.runs.slcan_adapter import Adapter
from tests.runs.support import Run, assert_healthy, octet, robot_at

MANY = 28
BIT_RATE = 500_000
WORDS = ("--environments", "1", "--seed", "4")
LAST = can.Message(arbitration_id=0x7FF, is_extended_id=False)
"""A frame that is no robot's: nothing of the run comes after it."""
RCVBUFFORCE = 33
"""SO_RCVBUFFORCE of Linux: room for the frames of a run, for when others have the processor."""


@contextmanager
def robots_at(links: dict[int, str]) -> Iterator[None]:
    """Robots that are there already, by node, each with its link."""
    with ExitStack() as stack:
        for node, link in links.items():
            stack.enter_context(robot_at(link, node))
        yield


@pytest.fixture
def adapter() -> Iterator[Callable[..., Adapter]]:
    """Plugs in an adapter with robots of these nodes behind it."""
    with ExitStack() as stack:

        def plug(*nodes: int) -> Adapter:
            plugged = Adapter(*nodes, node_of=node_of)
            stack.callback(plugged.close)
            stack.enter_context(robots_at({node: f"slcan:{tty}" for node, tty in plugged.robots.items()}))
            return plugged

        yield plug


def external(plugged: Adapter, *words: str) -> tuple[str, ...]:
    return ("--bus", f"slcan:{plugged.host}", "--robot", "external", *words)


def test_robots_behind_one_adapter_leave_the_same_log_as_in_process(run, adapter):
    words = (*WORDS, "--limit-s", "5", "--robots", "3", "--node", "4")

    behind = run(*words, *external(adapter(4, 5, 6)), "--owner", "1")

    within = run(*words, "--bus", "none")
    assert (behind.code, behind.errors) == (0, "")
    assert behind.log == within.log
    assert [robot["node"] for robot in behind.summary["robots"]] == [4, 5, 6]


def test_robot_missing_behind_the_adapter_is_named(run, adapter, monkeypatch):
    monkeypatch.setattr("host_sim.sim.connect._EXTERNAL_S", 0.5)

    done = run(*WORDS, "--robots", "3", *external(adapter(1, 2)))

    assert done.code == 1
    assert "no robot answered as node 3" in done.errors


@pytest.mark.parametrize(
    ("words", "order"),
    [
        ((), b"S6"),
        (("--bitrate", "125000"), b"S4"),
        (("--bitrate", "250000"), b"S5"),
        (("--bitrate", "1000000"), b"S8"),
    ],
)
def test_adapter_is_told_the_bit_rate(run, adapter, words, order):
    plugged = adapter(1)

    done = run(*WORDS, "--limit-s", "1", *external(plugged, *words))

    assert done.code == 0
    assert plugged.orders == [b"C", b"Z0", order, b"O"]


@pytest.mark.vcan
def test_robots_already_on_vcan_leave_the_same_log_as_in_process(run):
    words = (*WORDS, "--limit-s", "5", "--robots", "3", "--node", "4")

    with robots_at(dict.fromkeys((4, 5, 6), "socketcan:vcan0")):
        there = run(*words, "--bus", "socketcan:vcan0", "--robot", "external", "--owner", "1")

    assert (there.code, there.errors) == (0, "")
    assert there.log == run(*words, "--bus", "none").log


@dataclass
class Crowd:
    """A run with as many robots as a bus has room for, and what another reader heard of it."""

    run: Run
    heard: list[can.Message]


def on_vcan() -> can.BusABC:
    return can.Bus(interface="socketcan", channel="vcan0")


@contextmanager
def listener() -> Iterator[list[can.Message]]:
    """What python-can hears on vcan0, in a thread of its own."""
    heard: list[can.Message] = []
    with on_vcan() as bus, on_vcan() as end:
        bus.socket.setsockopt(socket.SOL_SOCKET, RCVBUFFORCE, 8_000_000)

        def listen() -> None:
            while (message := bus.recv()).arbitration_id != LAST.arbitration_id:
                heard.append(message)

        thread = threading.Thread(target=listen)
        thread.start()
        try:
            yield heard
        finally:
            end.send(LAST)
            thread.join()


@pytest.fixture(scope="module")
def crowd(tmp_path_factory) -> Crowd:
    out = tmp_path_factory.mktemp("crowd")
    with listener() as heard:
        done = octet("run", "--out", out, *WORDS, "--limit-s", "3", "--robots", str(MANY), "--bus", "socketcan:vcan0")
    return Crowd(Run(done.returncode, done.stdout, done.stderr, out), heard)


@pytest.mark.vcan
def test_robots_on_a_full_bus_lose_no_frame(crowd):
    summary = crowd.run.summary

    assert (crowd.run.code, crowd.run.errors) == (0, "")
    assert [robot["node"] for robot in summary["robots"]] == list(range(1, 1 + MANY))
    assert_healthy(summary)
    ticks = summary["environments"][0]["ticks"]
    assert all(min(it["frames"]["sent"], it["frames"]["received"]) > ticks for it in summary["robots"])


@pytest.mark.vcan
def test_other_reader_of_a_full_bus_sees_the_frames_of_the_log(crowd):
    logged = {it.frame for it in read_log(crowd.run.out / "run.log")}
    on_the_bus = {Frame(it.arbitration_id, bytes(it.data)) for it in crowd.heard}

    assert logged <= on_the_bus
    # What a robot says only because it waits, or when all is over, is left out of the log.
    assert {hear(frame).name for frame in on_the_bus - logged} <= {"DRIVE", *REPORTS}


@pytest.mark.vcan
def test_load_of_a_full_bus_is_as_computed(crowd):
    log = [it for it in read_log(crowd.run.out / "run.log") if it.time_us]  # the start takes no time in a log
    available = (log[-1].time_us - log[0].time_us) / 1e6 * BIT_RATE

    at_worst = sum(worst_bits(len(it.frame.data)) for it in log) / available
    assert {node_of(it.frame.id) for it in log} == set(range(1, 1 + MANY))
    assert at_worst == pytest.approx(MANY * robot_bits_a_second() / BIT_RATE, rel=0.03)
    assert 0.8 * at_worst < sum(len(bits_sent(it.frame)) for it in log) / available < at_worst


def test_owner_of_an_external_robot_depends_on_the_seed_alone(run, adapter):
    words = (*WORDS, "--limit-s", "1")
    runs = [run(*words, "--seed", seed, *external(adapter(1))) for seed in ("1", "1", "2")]

    owners = [{line.split(b"#")[1][4:6] for line in done.log.splitlines() if b" 021#" in line} for done in runs]
    assert owners[0] == owners[1] != owners[2]
    assert [len(each) for each in owners] == [1, 1, 1]
