"""`tools/octet check-wiring` and its image, which runs in rp2040js; a simulated builder follows its instructions."""

import os
import pty
import re
import select
import signal
import threading
import time
import tty
from collections import deque
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress

import pytest

from host_sim.base.errors import RobotError
from host_sim.base.paths import image_path
from host_sim.emulator.robot_on_pins import SENSORS, SIDES
from host_sim.lab.calibrate import wiring_check
from host_sim.lab.calibrate.wiring_check import WiringCheck
from host_sim.sim.pico import SteppedPico
from host_sim.sim.pico_pins import PicoParts
from tests.runs.support import start_octet

BEAT_US, SILENCE_BEATS, HOLDS_BEATS = 5100, 20, 40
FULL_SPEED = 37
"""Counts of a wheel in a beat at full duty."""
STEPS = 14


class Robot(PicoParts):
    """A new robot, as it is wired.

    Attributes:
        encoders: The wheel whose encoder is at each side's pins.
        motors: The wheel that each side's outputs turn, and its sign when it is to go forward.
        instead: The signal that is at the pin of another one.
        dead: Signals whose wires are missing.
        stuck: Contacts that are closed.
    """

    def __init__(self) -> None:
        super().__init__()
        self.encoders, self.motors = [0, 1], [(0, 1), (1, 1)]
        self.instead: dict[str, str] = {}
        self.dead: set[str] = set()
        self.stuck: set[str] = set()
        self.holds = 0
        self.battery_v = 7.2

    def _set(self, signal: str, *, high: bool) -> None:
        if signal not in self.dead:
            super()._set(signal, high=high and signal not in self.stuck)

    def _high(self, signal: str) -> bool:
        return super()._high(signal) and signal not in self.dead

    def _measure(self, samples: Mapping[str, int]) -> None:
        met = {name: samples[self.instead.get(name, name)] for name in samples}
        super()._measure({name: 40 if name in self.dead else sample for name, sample in met.items()})

    def roll(self, wheel: int, counts: int) -> None:
        """Turns a wheel."""
        pins = self.encoders.index(wheel)
        missing = self.dead & {f"{SIDES[pins]}_ENCODER_A", f"{SIDES[pins]}_ENCODER_B"}
        if not missing:
            self._turn(pins, self.counts_by[pins] * counts)
        elif counts and len(missing) == 1:
            self._turn(pins, 1)
            self._turn(pins, -1)
            self._turn(pins, 1)

    def beat(self) -> None:
        super().beat()
        self.holds -= 1
        if self.holds == 0:
            self.let_go()
        for side, (wheel, sign) in enumerate(self.motors):
            self.roll(wheel, sign * round(self._push(side) / 65536 * FULL_SPEED))

    def let_go(self) -> None:
        """Takes the hands away."""
        self.light, self.ambient = [0] * len(SENSORS), 300
        for contact in ("BUMPER_LEFT", "BUMPER_RIGHT", "BUTTON"):
            self._set(contact, high=True)

    def follow(self, text: str) -> None:
        """Does what a sentence tells its builder to."""
        self.holds = HOLDS_BEATS
        if match := re.match(r"Turn the (\w+) wheel", text):
            self.roll(SIDES.index(match[1].upper()), 700)
        elif match := re.match(r"Hold a white paper before the (\S+) sensor", text):
            at = SENSORS.index(f"PROXIMITY_{match[1].upper().replace('-', '_')}")
            self.light[at], self.ambient = 900, 100
        elif text.startswith("Point") and "BEACON" not in self.dead:
            self.receive_bursts(9)
        elif match := re.match(r"Press the (\w+) ?(\w*)", text):
            self._set("BUTTON" if match[1] == "button" else f"BUMPER_{match[1].upper()}", high=False)


class EmulatedLine:
    """The serial line of the emulated robot, whose time passes while it is read."""

    def __init__(self, robot: Robot) -> None:
        self.robot = robot
        self.pico = SteppedPico(image_path("pico", "check").with_suffix(".bin"))
        for contact in robot.stuck:
            robot._set(contact, high=False)
        self.heard: deque[bytes] = deque()

    def read(self) -> bytes:
        for _ in range(1000):
            if self.heard:
                return self.heard.popleft()
            self.beat()
        return b""

    def beat(self) -> None:
        orders, self.robot.orders = [*self.robot.orders, f"beat {BEAT_US}"], []
        self.robot.shares = [float(share) for share in self.pico.order(*orders)[-1].split()[1:]]
        self.robot.beat()
        self.heard += self.pico.text
        self.pico.text.clear()

    def write(self, text: bytes) -> None:
        self.pico.write(text)


@pytest.fixture
def check(monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[..., list[str]]]:
    """Checks a robot and returns the sentences about what is wrong."""
    lines: list[EmulatedLine] = []
    monkeypatch.setattr(wiring_check, "PATIENCE", 20)

    def checked(robot: Robot) -> list[str]:
        lines.append(EmulatedLine(robot))
        told: list[str] = []

        def tell(text: str) -> None:
            told.append(text)
            if not text.startswith(" "):
                robot.follow(text)

        right = WiringCheck(lines[-1], tell).run()
        wrong = [text.removeprefix("  WRONG: ") for text in told if "WRONG" in text]
        assert right == (not wrong), told
        assert len([text for text in told if text.startswith("  ")]) == STEPS, told
        return wrong

    yield checked
    for line in lines:
        line.pico.close()


def changed(change: Callable[[Robot], object]) -> Robot:
    robot = Robot()
    change(robot)
    return robot


def test_correctly_wired_robot_passes(check):
    assert check(Robot()) == []


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (lambda r: setattr(r, "counts_by", [-1, 1]), "it counts backward: exchange C1 (GP6) and C2 (GP7)"),
        (lambda r: setattr(r, "encoders", [1, 0]), "exchange the encoders of both motors"),
        (lambda r: r.dead.update({"LEFT_ENCODER_A", "LEFT_ENCODER_B"}), "the left encoder: it does not count"),
        (lambda r: r.dead.add("RIGHT_ENCODER_A"), "the right encoder: only one of its channels arrives"),
        (lambda r: setattr(r, "motors", [(1, 1), (0, 1)]), "exchange the wires of both motors at AOUT and BOUT"),
        (lambda r: setattr(r, "motors", [(0, 1), (1, -1)]), "exchange M1 and M2 of the right motor"),
        (lambda r: r.dead.add("BRIDGE_AWAKE"), "the left wheel did not turn"),
        (
            lambda r: r.dead.add("PROXIMITY_FRONT"),
            "the front sensor does not change: look at its emitter's wire to GP27",
        ),
        (
            lambda r: r.instead.update(
                PROXIMITY_FRONT="PROXIMITY_FRONT_LEFT", PROXIMITY_FRONT_LEFT="PROXIMITY_FRONT"
            ),
            "the front-left sensor answers: exchange the wires at GP27 and GP28",
        ),
        (lambda r: r.dead.add("INFRARED"), "the front sensor sees the room's light, not its LED"),
        (lambda r: r.dead.add("BEACON"), "the receiver sees nothing: look at OUT (GP13)"),
        (lambda r: r.dead.add("BUMPER_LEFT"), "the left bumper does not read as pressed: look at its wires to GP14"),
        (lambda r: r.stuck.add("BUMPER_RIGHT"), "the bumper reads as pressed"),
        (lambda r: r.dead.add("BUTTON"), "the left motor was not tried"),
        (lambda r: r.stuck.add("BRIDGE_FAULT"), "the bridge reports a fault"),
        (lambda r: setattr(r, "battery_v", 5.4), "VSYS has 3.6 V"),
    ],
)
def test_wrong_wire_is_named(check, change, sentence):
    wrong = check(changed(change))
    assert any(sentence in text for text in wrong), wrong


def test_wheels_stop_soon_after_the_orders_end():
    line = EmulatedLine(Robot())
    try:
        for _ in range(3):
            line.read()
            line.write(b"l")
        line.beat()
        line.beat()
        assert line.robot.figures()["duty"] == [20, 0]
        for _ in range(SILENCE_BEATS + 1):
            line.beat()
        assert line.robot.figures()["duty"] == [0, 0]
        assert line.robot.shares[10] < 0.5
    finally:
        line.pico.close()


def test_silent_serial_line_is_reported():
    class Silence:
        def read(self) -> bytes:
            return b""

        def write(self, text: bytes) -> None:
            """Nobody hears it."""

    with pytest.raises(RobotError, match="no readings"):
        WiringCheck(Silence(), lambda _: None).run()


class Terminal:
    """A pseudo-terminal with the robot at its far end, which waits for the answer to each of its lines."""

    def __init__(self) -> None:
        self._ours, theirs = pty.openpty()
        tty.setraw(theirs)
        self.name = os.ttyname(theirs)
        self.line = EmulatedLine(Robot())
        self.told: deque[str] = deque()
        self._theirs = theirs
        self._thread = threading.Thread(target=self._run)
        self._thread.start()

    def _run(self) -> None:
        answered = False
        with suppress(OSError):
            while True:
                text = self.line.read()
                while self.told:
                    self.line.robot.follow(self.told.popleft())
                os.write(self._ours, text.strip() + b"\r\n")
                while not answered and not select.select([self._ours], [], [], 0.2)[0]:
                    os.write(self._ours, text.strip() + b"\r\n")  # what arrived before the port was opened is lost
                answered = True
                order = os.read(self._ours, 1)
                if order == b"!":
                    return
                self.line.write(order)

    def close(self) -> None:
        os.write(self._theirs, b"!")
        self._thread.join()
        self.line.pico.close()
        os.close(self._ours)
        os.close(self._theirs)


@pytest.fixture
def terminal() -> Iterator[Terminal]:
    made = Terminal()
    yield made
    made.close()


def test_check_wiring_guides_through_all_steps(terminal):
    with start_octet("check-wiring", terminal.name) as command:
        assert command.stdout is not None
        told = []
        for text in command.stdout:
            told.append(text.rstrip())
            if not text.startswith(" "):
                terminal.told.append(text)
    assert command.returncode == 0, [text for text in told if "WRONG" in text]
    assert told[-1].startswith(f"all {STEPS} are right"), told


def test_ctrl_c_ends_check_wiring(terminal):
    with start_octet("check-wiring", terminal.name) as command:
        assert command.stdout is not None
        assert command.stdout.readline()
        command.send_signal(signal.SIGINT)
        _, errors = command.communicate()
    assert (command.returncode, errors) == (130, "octet: interrupted\n")


def test_robot_with_another_image_is_reported():
    ours, theirs = pty.openpty()
    tty.setraw(theirs)
    with start_octet("check-wiring", os.ttyname(theirs)) as command:
        while command.poll() is None:
            os.write(ours, b"t0812AABB\r")
            time.sleep(0.02)
        _, errors = command.communicate()
    os.close(ours)
    os.close(theirs)
    assert (command.returncode, errors.partition(":")[2][:33]) == (1, " this robot runs another image, w")


def test_missing_port_is_reported(tmp_path):
    with start_octet("check-wiring", tmp_path / "none") as command:
        _, errors = command.communicate()
    assert command.returncode == 2
    assert errors.startswith(f"octet: cannot open {tmp_path}/none: ")


def test_lost_port_is_reported():
    ours, theirs = pty.openpty()
    with start_octet("check-wiring", os.ttyname(theirs)) as command:
        assert command.stdout is not None
        assert command.stdout.readline()
        os.close(ours)
        os.close(theirs)
        _, errors = command.communicate()
    assert command.returncode == 1
    assert errors.startswith("octet: the serial port is gone: ")
