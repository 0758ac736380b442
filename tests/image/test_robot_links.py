"""What every link to a robot does, whatever carries the frames: in process, a socket pair, QEMU, emulated boards.

The bridge's mean voltages, compared with its truth table and with the motor's current computed step by step.
"""

import itertools
import time
from contextlib import ExitStack

import pytest

from host_sim.emulator.robot_on_pins import PWM_S, Winding, voltage
from host_sim.protocol.codec import COUNTERS as COUNTER_SPAN
from host_sim.protocol.codec import Frame, Protocol
from host_sim.protocol.generated import Reason, Senses
from host_sim.sim.access import Access
from host_sim.sim.connect import Connector

PROTOCOL = Protocol()
COUNTERS = itertools.cycle(range(COUNTER_SPAN))  # the robots live longer than a test, and remember the last one
PATIENCE_S = 5.0
KINDS = ("stale", "damaged", "foreign", "refused")
ROBOTS = {
    "in process": ("none", "spawn", "feather_stm32f405"),
    "socket pair": ("fd", "spawn", "feather_stm32f405"),
    "qemu": ("fd", "qemu", "feather_stm32f405"),
    "emulated feather_stm32f405": ("fd", "emulated", "feather_stm32f405"),
    "emulated blue_pill": ("fd", "emulated", "blue_pill"),
    "emulated nucleo_g431rb": ("fd", "emulated", "nucleo_g431rb"),
}


@pytest.fixture(scope="module", params=ROBOTS)
def connection(request):
    bus, robot, board = ROBOTS[request.param]
    with ExitStack() as stack:
        yield Connector(stack, Access(bus, robot, board=board)).connection(1)


@pytest.fixture
def link(connection):
    """With nothing left over, and a robot that takes any tick and counts on the sender's clock."""
    ask(connection.link)
    return connection.link


def order():
    return PROTOCOL.encode("COMMAND", {"counter": next(COUNTERS), "opcode": 1, "owner": 1})


def senses(tick):
    return PROTOCOL.encode_senses(Senses(tick, 0, False, False, 0, 0, 0), tick % COUNTER_SPAN)


def receive(link, timeout_s):
    """The next message, but for what the robot says unasked: of faults, and while it hears nothing."""
    give_up = time.monotonic() + timeout_s
    while (frame := link.receive(max(give_up - time.monotonic(), 0.0))) is not None:
        said = PROTOCOL.decode(frame)
        assert said is not None, frame
        if (
            said.name not in ("BOOT", "EMERGENCY")
            and not said.signals.get("silent")
            and said.signals.get("reason") != Reason.SILENCE
        ):
            return said
    return None


def hear_until(link, name):
    said = []
    while not said or said[-1].name != name:
        said.append(receive(link, PATIENCE_S))
        assert said[-1] is not None, f"no {name}, only {said}"
    return said


def ask(link):
    """Stops the robot; returns what it answers."""
    link.send(order())
    said = hear_until(link, "ANSWER")
    return said + hear_until(link, "DRIVE")


def faults(link):
    report = {}
    for said in ask(link):
        report |= said.signals if said.name == "FAULTS" else {}
    return report


def test_command_is_answered_once_and_in_full(link):
    names = [said.name for said in ask(link)]

    assert names == ["ANSWER", "HEARTBEAT", "MEMORY", "MEMORY", "FAULTS", "FAULTS", "HEALTH", "DRIVE"]
    assert receive(link, 0.05) is None


def test_frames_keep_their_order(link):
    for tick in range(8):
        link.send(senses(tick))

    ticks = [hear_until(link, "DRIVE")[-1].signals["tick"]]
    while ticks[-1] != 7:  # a robot that this host has held up answers only the newest of what waits
        ticks.append(hear_until(link, "DRIVE")[-1].signals["tick"])

    assert ticks == sorted(set(ticks))


def test_receive_returns_none_after_its_timeout(link):
    assert receive(link, 0.0) is None
    began = time.monotonic()
    assert receive(link, 0.1) is None

    assert time.monotonic() - began >= 0.1


@pytest.mark.parametrize("damage", ["length", "crc"])
def test_damaged_frame_gets_no_answer_and_is_counted(link, damage):
    before = faults(link)
    good = order()
    link.send(good)
    hear_until(link, "DRIVE")
    bad = {
        "length": Frame(good.id, good.data[:5]),
        "crc": Frame(good.id, bytes((good.data[0] ^ 1,)) + good.data[1:]),
    }[damage]

    link.send(bad)

    assert receive(link, 0.05) is None
    assert faults(link)["damaged"] == before["damaged"] + 1


def test_repeated_command_is_answered_again_and_not_executed(link):
    before = faults(link)
    command = order()
    link.send(command)
    (answer, *_) = hear_until(link, "DRIVE")

    link.send(command)

    assert receive(link, PATIENCE_S) == answer
    assert receive(link, 0.05) is None
    assert {name: faults(link)[name] for name in KINDS} == {name: before[name] for name in KINDS}


def test_frames_for_other_nodes_get_no_answer(link):
    for frame_id in (0x000, 0x022, 0x102, 0x181, 0x7FF):
        link.send(Frame(frame_id, bytes(8)))

    assert receive(link, 0.05) is None
    assert ask(link)[0].name == "ANSWER"


STEPS, PERIODS = 2000, 30


def stepped(in_1: float, in_2: float, emf: float, winding: Winding) -> float:
    """The mean voltage of the last of many periods, from the differential equation of the winding."""
    current, total = 0.0, 0.0
    for _ in range(PERIODS):
        total = 0.0
        for step in range(STEPS):
            high = [step < duty * STEPS for duty in (in_1, in_2)]
            if any(high):
                applied = float(high[0] - high[1])
            elif current != 0:
                applied = -1.0 if current > 0 else 1.0
            else:
                applied = emf
            after = current + (applied - emf - current * winding.ohm) * PWM_S / STEPS / winding.henry
            current = 0.0 if not any(high) and after * current <= 0 else after
            total += applied
    return total / STEPS


@pytest.mark.parametrize("henry", [0.3e-3, 1e-3, 2e-3])
@pytest.mark.parametrize("emf", [0.0, 0.3, -0.1])
@pytest.mark.parametrize("inputs", [(0.4, 0.0), (0.8, 0.0), (0.0, 0.3), (1.0, 0.6), (0.6, 1.0), (1.0, 1.0)])
def test_mean_motor_voltage_matches_the_stepped_winding_model(inputs, emf, henry):
    winding = Winding(henry=henry)

    assert voltage(*inputs, emf, winding) == pytest.approx(stepped(*inputs, emf, winding), abs=0.01)


@pytest.mark.parametrize(("inputs", "wanted"), [((1, 0), 1), ((0, 1), -1), ((1, 1), 0), ((0, 0), 0.3)])
def test_steady_inputs_follow_the_truth_table(inputs, wanted):
    assert voltage(*inputs, 0.3, Winding()) == pytest.approx(wanted)
