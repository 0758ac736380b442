"""What can be wrong with a body: in its sensors, its motors, or the wires between them and the robot."""

import re
from collections.abc import Callable
from dataclasses import asdict, dataclass, replace
from functools import cached_property
from typing import Any

from host_sim.base.near_word import near_word
from host_sim.protocol.generated import Ranges, Senses
from host_sim.world.cones import CONE_BEARINGS_DEG
from host_sim.world.world_library import world_library

_BITS = tuple(CONE_BEARINGS_DEG)
SENSORS = {name.replace("_", "-"): bit for name, bit in zip(Ranges._fields, _BITS, strict=True)}
"""The bit of each sensor in feel, by the name that a change calls it."""

_FULL_PERCENT = 100
_BEACON_MAX_MM = 8191
_NOISE_OF_MAX = 1_000_000
_MASK_64 = (1 << 64) - 1


@dataclass(frozen=True)
class BodyFaults:
    """What is wrong with a body.

    Attributes:
        mirrored: Whether the ring of sensors is mounted the other way round.
        noise: Number of ticks, out of `noise_of`, in which each sensor is wrong; 0 for none.
        noise_of: See `noise`, 1..1,000,000.
        noise_key: Decides, with the number of the tick, which ticks these are; see the function `noise_key`.
        stuck_on: Sensors that always see something, as bits of feel.
        stuck_off: Sensors that never see anything.
        swapped: Whether each motor, with its odometer, has the other one's plug.
        left_lost_percent: Speed that the left motor lacks, percent of what it is told.
        right_lost_percent: That of the right one.
        odometers_swapped: Whether each wheel is counted by the other one's odometer.
        left_miscounted_percent: What the left odometer counts beyond the way of its wheel, percent of that way: -100
            if it is stuck, -200 if it counts backward.
        right_miscounted_percent: That of the right one.
        false_beacon_mm: Distance to the food that is seen where there is none; 0 for no such food.
    """

    mirrored: bool = False
    noise: int = 0
    noise_of: int = 1
    noise_key: int = 0
    stuck_on: int = 0
    stuck_off: int = 0
    swapped: bool = False
    left_lost_percent: int = 0
    right_lost_percent: int = 0
    odometers_swapped: bool = False
    left_miscounted_percent: int = 0
    right_miscounted_percent: int = 0
    false_beacon_mm: int = 0

    def sensed(self, senses: Senses, tick: int) -> Senses:
        """What the robot is told of what its body senses.

        Args:
            senses: What a sound body senses there.
            tick: Number of the tick in the run.
        """
        ffi, library = world_library()
        told: Any = ffi.new("struct senses *", senses._asdict())
        library.body_faults_sense(self._in_c, tick, told)
        return Senses._make(getattr(told, name) for name in Senses._fields)

    def measured(self, ranges: Ranges) -> Ranges:
        """What the robot is told of the distances; noise does not change them."""
        ffi, library = world_library()
        none = library.RANGE_NONE
        told = ffi.new("uint8_t[]", [none if distance is None else distance for distance in ranges])
        library.body_faults_measure(self._in_c, told)
        return Ranges._make(None if distance == none else distance for distance in told)

    def driven(self, left_mm_s: int, right_mm_s: int) -> tuple[int, int]:
        """The speeds at which the left and the right wheel turn when the robot tells them these."""
        ffi, library = world_library()
        drive: Any = ffi.new("struct drive *", {"left_mm_s": left_mm_s, "right_mm_s": right_mm_s})
        library.body_faults_drive(self._in_c, drive)
        return drive.left_mm_s, drive.right_mm_s

    def counted(self, left_mm: float, right_mm: float) -> tuple[float, float]:
        """The ways that the left and the right odometer count when the left and the right wheel roll these."""
        ffi, library = world_library()
        counted: Any = ffi.new("double[]", [left_mm, right_mm])
        library.body_faults_count(self._in_c, counted, counted + 1)
        return counted[0], counted[1]

    @cached_property
    def _in_c(self) -> Any:
        """The same as a `struct body_faults *`."""
        return world_library()[0].new("struct body_faults *", asdict(self))


SOUND = BodyFaults()
"""Nothing is wrong."""

Fault = Callable[[BodyFaults, tuple[str, ...]], BodyFaults]


def noise_key(seed: int, robot: int) -> int:
    """Where a robot's noise begins among all random numbers."""
    return _mixed(seed * 10_000 + robot)


def with_fault(faults: BodyFaults, what: str, key: int = 0) -> BodyFaults:
    """The faults of a body after one more.

    >>> with_fault(SOUND, "weak-motor:left:60%").driven(100, 100)
    (60, 100)

    Args:
        faults: What was wrong before.
        what: The fault, such as "stuck-on:front"; docs/worlds.md has all.
        key: The robot's `noise_key`.

    Raises:
        ValueError: There is no such fault; the message says what was meant.
    """
    name = what.partition(":")[0]
    if name not in _FAULTS:
        near = near_word(name, _FAULTS)
        raise ValueError(f"did you mean {near!r}?" if near else f"choose from {', '.join(_FAULTS)}")
    pattern, make, form = _FAULTS[name]
    match = re.fullmatch(pattern, what.removeprefix(name))
    if match is None:
        raise ValueError(f"write {form}")
    return make(replace(faults, noise_key=key) if name == "noise" else faults, match.groups())


def _mirror(faults: BodyFaults, _: tuple[str, ...]) -> BodyFaults:
    return replace(faults, mirrored=not faults.mirrored)


def _make_noise(faults: BodyFaults, words: tuple[str, ...]) -> BodyFaults:
    noise, noise_of = int(words[0]), int(words[1])
    if not noise <= noise_of <= _NOISE_OF_MAX or not noise_of:
        raise ValueError(f"{noise} of {noise_of} ticks cannot be; at most all of {_NOISE_OF_MAX}")
    return replace(faults, noise=noise, noise_of=noise_of)


def _stick_on(faults: BodyFaults, words: tuple[str, ...]) -> BodyFaults:
    bit = SENSORS[words[0]]
    return replace(faults, stuck_on=faults.stuck_on | bit, stuck_off=faults.stuck_off & ~bit)


def _stick_off(faults: BodyFaults, words: tuple[str, ...]) -> BodyFaults:
    bit = SENSORS[words[0]]
    return replace(faults, stuck_off=faults.stuck_off | bit, stuck_on=faults.stuck_on & ~bit)


def _swap_motors(faults: BodyFaults, _: tuple[str, ...]) -> BodyFaults:
    return replace(faults, swapped=not faults.swapped)


def _weaken(faults: BodyFaults, words: tuple[str, ...]) -> BodyFaults:
    side, lost_percent = words[0], _FULL_PERCENT - int(words[1])
    if lost_percent < 0:
        raise ValueError(f"a motor has at most {_FULL_PERCENT}%")
    if side == "left":
        return replace(faults, left_lost_percent=lost_percent)
    return replace(faults, right_lost_percent=lost_percent)


def _swap_odometers(faults: BodyFaults, _: tuple[str, ...]) -> BodyFaults:
    return replace(faults, odometers_swapped=not faults.odometers_swapped)


def _miscount(faults: BodyFaults, words: tuple[str, ...]) -> BodyFaults:
    side, miscounted_percent = words[0], int(words[1]) - _FULL_PERCENT
    if side == "left":
        return replace(faults, left_miscounted_percent=miscounted_percent)
    return replace(faults, right_miscounted_percent=miscounted_percent)


def _show_food(faults: BodyFaults, words: tuple[str, ...]) -> BodyFaults:
    if int(words[0]) > _BEACON_MAX_MM:
        raise ValueError(f"food is seen up to {_BEACON_MAX_MM} mm away")
    return replace(faults, false_beacon_mm=int(words[0]))


def _repair(_faults: BodyFaults, _: tuple[str, ...]) -> BodyFaults:
    return SOUND


_SENSOR = f":({'|'.join(SENSORS)})"
_SENSOR_FORM = f"with SENSOR one of {', '.join(SENSORS)}"
_FAULTS: dict[str, tuple[str, Fault, str]] = {
    "swap-motors": ("", _swap_motors, "swap-motors"),
    "mirror": ("", _mirror, "mirror"),
    "stuck-on": (_SENSOR, _stick_on, f"stuck-on:SENSOR, {_SENSOR_FORM}"),
    "stuck-off": (_SENSOR, _stick_off, f"stuck-off:SENSOR, {_SENSOR_FORM}"),
    "noise": (r":(\d{1,7})/(\d{1,7})", _make_noise, "noise:N/TICKS, such as noise:10/1000"),
    "weak-motor": (r":(left|right):(\d{1,3})%", _weaken, "weak-motor:left:60% or weak-motor:right:60%"),
    "swap-odometers": ("", _swap_odometers, "swap-odometers"),
    "odometer": (r":(left|right):(-?\d{1,3})%", _miscount, "odometer:left:0% or odometer:right:-100%"),
    "false-beacon": (r":(\d{1,4})", _show_food, "false-beacon:MM, such as false-beacon:100"),
    "repair": ("", _repair, "repair"),
}

FAULT_NAMES = tuple(_FAULTS)
"""What a fault begins with."""


def _mixed(number: int) -> int:
    """The SplitMix64 generator's number after this one."""
    mixed = (number + 0x9E3779B97F4A7C15) & _MASK_64
    mixed = ((mixed ^ mixed >> 30) * 0xBF58476D1CE4E5B9) & _MASK_64
    mixed = ((mixed ^ mixed >> 27) * 0x94D049BB133111EB) & _MASK_64
    return mixed ^ mixed >> 31
