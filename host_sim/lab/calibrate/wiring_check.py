"""A guided test of the wiring of a robot on a Pico with the image octet-pico-check: what to do, and what is wrong."""

import re
from collections.abc import Callable, Iterator
from typing import NamedTuple, Protocol

from host_sim.base.errors import RobotError
from host_sim.transport.slcan_link import decode

PATIENCE = 400
"""Lines that a step waits for; one comes every 50 ms."""

REST, ORDERS = b".", {"left": b"l", "right": b"r"}
_UNREADABLE_MAX = 40
_SETTLE, _PUSH = 12, 10  # lines
_BY_HAND, _BY_MOTOR = 100, 50  # counts; a turn of a wheel has 1,440
_RISE, _SHADE, _FULL = 320, 150, 4000  # light, of 4095
_MV_PER_V, _LOW_V = 1500, 4.2  # the image scales a supply of 4.8 V to the motors' 7.2 V
_BURSTS = 3

_SENSORS = {"front-right": "GP26", "front": "GP27", "front-left": "GP28"}
_CONTACTS = {"left bumper": "GP14", "right bumper": "GP15", "button": "GP16"}
_ENCODERS = {"left": "C1 (GP6) and C2 (GP7)", "right": "C1 (GP8) and C2 (GP9)"}
_MOTORS = {"left": "AIN1 (GP2), AIN2 (GP3), AOUT1, AOUT2", "right": "BIN1 (GP4), BIN2 (GP5), BOUT1, BOUT2"}
_OTHER = {"left": "right", "right": "left"}

_LINE = re.compile(
    rb"left (\d+) right (\d+) mv (\d+) fault ([01]) bumper ([01]) button ([01]) bursts (\d+)"
    rb" dark (\d+) (\d+) (\d+) lit (\d+) (\d+) (\d+)"
)


class Line(Protocol):
    """The robot's serial line."""

    def read(self) -> bytes:
        """The next line; an empty one if none has come to its end for a while."""

    def write(self, text: bytes) -> None:
        """Sends text."""


class Reading(NamedTuple):
    """The readings of one line.

    Attributes:
        counts: Of each wheel's encoder; they wrap.
        mv: Supply, mV, scaled as `_MV_PER_V` says.
        fault: Whether the bridge has reported one.
        bumper: Whether a bumper is pressed.
        button: Whether the button is.
        bursts: Number of bursts that the receiver has seen; wraps.
        dark: Light at each sensor with the LEDs off, 0..4095.
        lit: Likewise with the LEDs on.
    """

    counts: dict[str, int]
    mv: int
    fault: int
    bumper: int
    button: int
    bursts: int
    dark: tuple[int, ...]
    lit: tuple[int, ...]

    def turned(self, since: "Reading") -> dict[str, int]:
        """Counts of each wheel since an earlier reading."""
        return {side: (self.counts[side] - since.counts[side] + 0x8000) % 0x10000 - 0x8000 for side in ORDERS}

    def risen(self, since: "Reading") -> list[int]:
        """How much more of the LEDs' light each sensor receives than in an earlier reading."""
        return [self.lit[i] - self.dark[i] - since.lit[i] + since.dark[i] for i in range(len(_SENSORS))]


def _reading(line: bytes) -> Reading | None:
    match = _LINE.fullmatch(line.strip())
    if match is None:
        return None
    left, right, mv, fault, bumper, button, bursts, *light = map(int, match.groups())
    counts = {"left": left, "right": right}
    return Reading(counts, mv, fault, bumper, button, bursts, tuple(light[:3]), tuple(light[3:]))


class WiringCheck:
    """The test, step by step. Each reading is answered with an order; without one, the wheels rest."""

    def __init__(self, line: Line, tell: Callable[[str], None]) -> None:
        """Prepares the test, which `run` starts.

        Args:
            line: The robot's serial line.
            tell: Shows a sentence.
        """
        self._line, self._tell = line, tell
        self._steps = self._wrong = 0

    def run(self) -> bool:
        """Guides through all steps; returns whether everything is right.

        Raises:
            RobotError: At the far end of the line is no robot that runs this image.
        """
        self._tell("The wheels rest, nothing is pressed, nothing is within 30 cm in front of the sensors.")
        self._free = [self._next() for _ in range(_SETTLE)][-1]
        self._rest(self._free)
        turns = [side for side in ORDERS if self._turn_by_hand(side)]
        for index in range(len(_SENSORS)):
            self._cover(index)
        self._shine()
        starts = [self._press(contact) for contact in _CONTACTS][-1]
        for side in ORDERS:
            if starts and side in turns:
                self._turn_by_motor(side)
            else:
                self._judge(f"the {side} motor was not tried: first mend its encoder and the button")
        self._tell(
            f"{self._wrong} of {self._steps} are wrong: mend them, and check again" if self._wrong else
            f"all {self._steps} are right: now flash tools/flash pico pins, and calibrate"
        )  # fmt: skip
        return not self._wrong

    def _judge(self, wrong: str, right: str = "") -> bool:
        """Tells the result of a step: what is wrong, unless that is empty."""
        self._steps += 1
        self._wrong += bool(wrong)
        self._tell(f"  WRONG: {wrong}" if wrong else f"  right: {right}")
        return not wrong

    def _next(self, order: bytes = REST) -> Reading:
        for _ in range(_UNREADABLE_MAX):
            line = self._line.read()
            reading = _reading(line)
            if reading is not None:
                self._line.write(order)
                return reading
            if decode(line.strip()) is not None:
                raise RobotError("this robot runs another image, which drives: first call tools/flash pico check")
        raise RobotError("no readings: join GP0 to the adapter's RX, GP1 to its TX, and call tools/flash pico check")

    def _wait(self) -> Iterator[Reading]:
        for _ in range(PATIENCE):
            yield self._next()

    def _still(self) -> Reading:
        """A reading once no wheel has turned for a while."""
        last, quiet = self._next(), 0
        for reading in self._wait():
            quiet = 0 if any(reading.turned(last).values()) else quiet + 1
            last = reading
            if quiet == _SETTLE:
                break
        return last

    def _rest(self, reading: Reading) -> None:
        volts = reading.mv / _MV_PER_V
        low = f"VSYS has {volts:.1f} V: switch the battery on, or charge it"
        self._judge(low if volts < _LOW_V else "", f"VSYS has {volts:.1f} V")
        fault = "the bridge reports a fault (FLT, GP11, is low): it has no supply, or a short circuit at a motor"
        self._judge(fault if reading.fault else "", "the bridge reports no fault")
        closed = [name for name, is_closed in (("bumper", reading.bumper), ("button", reading.button)) if is_closed]
        pressed = f"the {' and the '.join(closed)} reads as pressed: look for a joint to GND, and at its contact"
        self._judge(pressed if closed else "", "nothing is pressed")

    def _turn_by_hand(self, side: str) -> bool:
        begun, most = self._still(), 0
        self._tell(f"Turn the {side} wheel by hand, forward, half a turn.")
        wrong, counts = "", 0
        for reading in self._wait():
            turned = reading.turned(begun)
            counts, most = turned[side], max(most, abs(turned[side]))
            if abs(turned[_OTHER[side]]) >= _BY_HAND:
                wrong = f"the {_OTHER[side]} encoder counts: exchange the encoders of both motors, C1 and C2 each"
                break
            if abs(counts) >= _BY_HAND:
                wrong = f"it counts backward: exchange {_ENCODERS[side]} of the {side} motor" if counts < 0 else ""
                break
        else:
            missing = "only one of its channels arrives" if most else "it does not count"
            wrong = f"the {side} encoder: {missing}: look at {_ENCODERS[side]}, at its VCC and GND"
        return self._judge(wrong, f"{side} wheel: counts {counts}, direction forward")

    def _cover(self, index: int) -> None:
        names = list(_SENSORS)
        name, pin = names[index], _SENSORS[names[index]]
        any(max(reading.risen(self._free)) < _RISE // 2 for reading in self._wait())
        self._tell(f"Hold a white paper before the {name} sensor only, 60 mm away, until the next line.")
        wrong, risen, shaded = "", 0, False
        for reading in self._wait():
            rises = reading.risen(self._free)
            risen, brightest = rises[index], names[rises.index(max(rises))]
            shaded = shaded or abs(reading.dark[index] - self._free.dark[index]) > _SHADE
            if max(rises) >= _RISE:
                if brightest != name:
                    wrong = f"the {brightest} sensor answers: exchange the wires at {pin} and {_SENSORS[brightest]}"
                break
        else:
            wrong = f"the {name} sensor does not change: look at its emitter's wire to {pin}, and its resistor to GND"
            if shaded:
                wrong = f"the {name} sensor sees the room's light, not its LED: look at the LED, its transistor, GP12"
            elif self._free.dark[index] >= _FULL:
                wrong = f"the {name} sensor reads {self._free.dark[index]} in the dark: look at its resistor to GND"
        self._judge(wrong, f"{name} sensor: {risen} more than free")

    def _shine(self) -> None:
        begun = self._next()
        self._tell("Point the food, or any remote control, at the receiver, and press one of its keys.")
        if any((reading.bursts - begun.bursts) % 0x10000 >= _BURSTS for reading in self._wait()):
            self._judge("", "the receiver sees it")
        else:
            self._judge("the receiver sees nothing: look at OUT (GP13), VS and GND")

    def _press(self, contact: str) -> bool:
        def pressed(reading: Reading) -> int:
            return reading.button if contact == "button" else reading.bumper

        pins = f"look at its wires to {_CONTACTS[contact]} and GND"
        if pressed(self._next()):
            return self._judge(f"the {contact} reads as pressed before it is: {pins}")
        motors = ", with the robot on a box, its wheels in the air: the motors come next"
        self._tell(f"Press the {contact} and let go{motors if contact == 'button' else ''}.")
        found = any(pressed(reading) for reading in self._wait())
        if found:
            any(not pressed(reading) for reading in self._wait())
        return self._judge(
            "" if found else f"the {contact} does not read as pressed: {pins}", f"the {contact} is seen"
        )

    def _turn_by_motor(self, side: str) -> None:
        begun = self._still()
        self._tell(f"The {side} motor gets 20 % for half a second.")
        for _ in range(_PUSH):
            self._next(ORDERS[side])
        turned = [self._next() for _ in range(_SETTLE)][-1].turned(begun)
        counts, other = turned[side], turned[_OTHER[side]]
        wrong = ""
        if abs(other) >= _BY_MOTOR:
            wrong = f"the {_OTHER[side]} wheel turned: exchange the wires of both motors at AOUT and BOUT"
        elif counts <= -_BY_MOTOR:
            wrong = f"it turned backward: exchange M1 and M2 of the {side} motor"
        elif counts < _BY_MOTOR:
            wrong = f"the {side} wheel did not turn: look at {_MOTORS[side]}, and at SLP (GP10) and VIN of the bridge"
        self._judge(wrong, f"{side} wheel: {counts} counts, forward")
