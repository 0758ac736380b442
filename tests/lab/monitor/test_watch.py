"""What the monitor makes of the frames that it hears."""

import can
import pytest

from host_sim.lab.monitor.bus_watch import BusWatch
from host_sim.lab.monitor.table import lines_of
from host_sim.protocol.codec import Frame, Protocol
from host_sim.protocol.generated import LAYOUT_HASH, MESSAGES
from host_sim.recording.log_reader import Recorded, read_log
from tests.recording.support import record_run

P = Protocol()


def message(frame: Frame, **fields: object) -> can.Message:
    return can.Message(arbitration_id=frame.id, data=frame.data, **{"is_extended_id": False, **fields})


def listen(log: list[Recorded], bus: BusWatch | None = None) -> tuple[BusWatch, float]:
    """A monitor that has heard a log, and the time when it had."""
    bus = bus or BusWatch(500_000)
    for time_us, frame in log:
        bus.accept(message(frame), time_us / 1e6)
    return bus, log[-1].time_us / 1e6


@pytest.fixture(scope="module")
def log(tmp_path_factory) -> list[Recorded]:
    return list(read_log(record_run(tmp_path_factory.mktemp("run"), seed=333, limit_s=6.0).log))


def places(log: list[Recorded], name: str) -> list[int]:
    return [i for i, it in enumerate(log) if it.frame.id == P.id_of(name)]


def test_nothing_looks_wrong_in_a_good_run(log):
    bus, now_s = listen(log)

    assert bus.wrong(now_s) == []
    robot = bus.robots[1]
    assert [robot.total(count) for count in ("lost", "repeated", "damaged")] == [0, 0, 0]
    assert robot.messages["SENSES"].rate(now_s) == pytest.approx(50, abs=1)
    assert robot.messages["HEARTBEAT"].rate(now_s) == pytest.approx(1, abs=0.5)
    assert 0.02 < bus.load(now_s) < 0.03


def test_a_lost_frame_is_noticed_by_its_counter(log):
    gone = [places(log, "DRIVE")[100], places(log, "SENSES")[50], places(log, "SENSES")[51]]

    bus, now_s = listen([it for i, it in enumerate(log) if i not in gone])

    assert (bus.robots[1].messages["DRIVE"].lost, bus.robots[1].messages["SENSES"].lost) == (1, 2)
    assert bus.wrong(now_s) == ["node 1: lost DRIVE frames", "node 1: lost SENSES frames"]


def test_a_repeated_frame_is_counted_and_is_not_wrong(log):
    again = places(log, "SENSES")[60]

    bus, now_s = listen([*log[: again + 1], log[again], *log[again + 1 :]])

    assert bus.robots[1].messages["SENSES"].repeated == 1
    assert bus.wrong(now_s) == []


def test_a_second_run_begins_with_counters_of_its_own(log):
    bus, now_s = listen(log)

    later = [Recorded(it.time_us + round(now_s * 1e6), it.frame) for it in log]
    bus, now_s = listen([it for it in later if it.frame.id != P.id_of("BOOT")], bus)

    assert bus.robots[1].messages["SENSES"].lost == 0


def test_a_damaged_frame_is_counted_with_its_message(log):
    place = places(log, "DRIVE")[10]
    frame = log[place].frame
    damaged = frame._replace(data=frame.data[:-1] + bytes([frame.data[-1] ^ 1]))

    bus, now_s = listen([*log[:place], Recorded(log[place].time_us, damaged), *log[place:]])

    assert bus.robots[1].messages["DRIVE"].damaged == 1
    assert bus.wrong(now_s) == ["node 1: damaged DRIVE frames"]


def test_a_robot_that_does_not_answer_is_named(log):
    place = places(log, "SENSES")[100]
    senses = [it for it in log[place:] if it.frame.id == P.id_of("SENSES")]

    bus, now_s = listen([*log[:place], *senses[:40]])

    assert "node 1: does not answer its SENSES" in bus.wrong(now_s)


def test_a_pause_after_the_last_answer_is_not_wrong(log):
    bus, now_s = listen(log[: places(log, "SENSES")[100]])

    assert bus.wrong(now_s + 1.0) == []


def test_a_robot_without_heartbeats_is_named(log):
    bus, now_s = listen(log)

    assert bus.wrong(now_s + 2.0) == []
    assert bus.wrong(now_s + 3.5) == ["node 1: no heartbeat"]


def heartbeat(**signals: int) -> Frame:
    usual = {"counter": 0, "state": 1, "frozen": 0, "lockstep": 0, "silent": 0, "profile": 0, "owner": 1, "uptime": 5}
    return P.encode("HEARTBEAT", {**usual, "layout": LAYOUT_HASH, **signals})


def report(name: str, **signals: int) -> Frame:
    """A message whose other signals are 0."""
    others = {signal.name: 0 for signal in MESSAGES[name].signals}
    return P.encode(name, {**others, **signals})


WRONG = {
    "another octet.dbc (layout 1234)": [heartbeat(layout=0x1234)],
    "runs, and hears no senses": [heartbeat(silent=1)],
    "commands of 7, but its owner is 1": [heartbeat(), report("COMMAND", opcode=1, owner=7)],
    "restarted": [report("BOOT"), heartbeat()],
    "its CAN controller is passive": [report("HEALTH", bus_state=1, clock=1), heartbeat()],
    "its clock is inexact": [report("HEALTH", clock=0), heartbeat()],
    "has crashed since power-up": [report("CRASH"), heartbeat()],
    "counts faults: twins": [report("FAULTS", page=1, twins=2), heartbeat()],
    "counts faults: stale": [report("FAULTS", page=0, stale=1), heartbeat()],
}


@pytest.mark.parametrize(("what", "frames"), WRONG.items(), ids=WRONG)
def test_what_a_robot_says_of_itself_is_named(what, frames):
    bus, now_s = listen([Recorded(0, frame) for frame in frames])

    assert bus.wrong(now_s) == [f"node 1: {what}"]


def test_a_boot_report_that_was_asked_for_is_no_new_start():
    bus, now_s = listen([Recorded(0, frame) for frame in (report("ANSWER", opcode=9), report("BOOT"), heartbeat())])

    assert bus.wrong(now_s) == []


def test_what_else_is_on_the_bus_is_counted():
    bus = BusWatch(500_000)
    for other in (
        message(Frame(0x7FF, b"\x01")),
        message(Frame(P.id_of("DRIVE"), b""), is_extended_id=True),
        message(Frame(P.id_of("DRIVE"), b""), is_remote_frame=True),
        message(Frame(P.id_of("DRIVE"), bytes(12)), is_fd=True),
        can.Message(is_error_frame=True),
    ):
        assert bus.accept(other, 1.0) is None

    assert (bus.robots, bus.frames, bus.foreign, bus.errors) == ({}, 5, 4, 1)
    assert bus.wrong(1.0) == ["bus: error frames"]


def test_a_full_bus_is_named(log):
    bus, now_s = listen(log, BusWatch(15_000))

    assert bus.wrong(now_s) == ["bus: load above 70%"]


def test_what_the_monitor_itself_missed_is_no_fault_of_the_bus():
    bus = BusWatch(500_000)
    bus.dropped = 3

    assert bus.wrong(1.0) == ["monitor: frames came faster than they could be shown, and some are missing here"]
    assert lines_of(bus, "socketcan:can0", 1.0)[0].endswith("missing here 3")


def test_the_table_has_a_line_for_each_robot(log):
    other = Protocol(12)
    bus, now_s = listen(log[: places(log, "COMMAND")[-1]])
    bus.accept(message(Frame(other.id_of("HEARTBEAT"), b"\x00\x00")), now_s)

    lines = lines_of(bus, "socketcan:can0", now_s)

    assert lines[0].startswith("socketcan:can0   6 s   ")
    head, first, second = lines[2:5]
    assert dict(zip(head.split(), first.split(), strict=False)).items() >= {
        "node": "1", "state": "running", "clock": "lockstep", "profile": "article", "owner": "1", "lost": "0",
    }.items()  # fmt: skip
    assert second.split()[:2] == ["12", "?"]
    assert lines[-1] == "! node 12: damaged HEARTBEAT frames"


def test_a_bus_without_robots_is_said_to_have_none():
    assert lines_of(BusWatch(500_000), "x:y", 3.0)[-1] == "no robot is heard"
