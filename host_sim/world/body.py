"""One robot's body: it moves with its wheels, senses, and is pushed out of whatever it runs into."""

from functools import cache
from struct import Struct
from typing import Any

from host_sim.protocol.generated import Senses
from host_sim.world.body_kinds import add_fault
from host_sim.world.geometry import Point, Pose
from host_sim.world.native_world import NativeWorld
from host_sim.world.world_library import members, world_library

_POSE, _ODOMETER = ("x_mm", "y_mm", "heading_rad"), ("left_mm", "right_mm")


class Body:
    """A disc with two wheels, five proximity cones and a beam that sees food: a view of a `struct body`.

    Each tick is `sense`, optionally `eat`, then `move`, each affected by its faults. The wheels roll the body along
    an arc. A body pressed into an obstacle, such as another robot, is pushed straight out of it, so it stops or
    slides.

    Attributes:
        lifted: Whether a person holds it in the air: its wheels turn, but it does not move or sense anything.
        faults: Its faults, a `struct body_faults`.
        kit: Its own traits, a `struct kit *`.
    """

    def __init__(self, inside: NativeWorld, index: int, before: "Body | None" = None) -> None:
        """Creates a view of a body of a world.

        Args:
            inside: The world.
            index: Its number there, from 0.
            before: The robot's body in an earlier arena, whose odometers and faults continue.
        """
        self.lifted, self._index = False, index
        self._inside, self._library, self._world = inside, inside.library, inside.world
        self._ffi = inside.ffi
        self._body: Any = inside.bodies + index
        self._pose, self._odometer, self._senses = _readers()
        self._bytes = inside.ffi.buffer(self._body, inside.ffi.sizeof("struct body"))
        self._sensed: Any = inside.ffi.new("struct senses *")
        self._sensed_bytes = inside.ffi.buffer(self._sensed)
        self.faults: Any = self._body.faults
        if before is not None:
            self._body.faults = before.faults
            self._body.left_mm, self._body.right_mm = before.odometer
        self.become(inside.ffi.new("struct kit *") if before is None else before.kit)

    def become(self, kit: Any) -> None:
        """Makes it a body of a kind: a `struct kit *`."""
        self.kit = self._body.kit = kit
        kit.ranges = self._inside.kit_ranges

    @property
    def pose(self) -> Pose:
        """Its position and heading."""
        return Pose._make(self._pose.unpack_from(self._bytes))

    @property
    def odometer(self) -> Point:
        """Counts of the left and right odometers since the first arena, mm, forward positive, slip included."""
        left_mm, right_mm = self._odometer.unpack_from(self._bytes)
        return left_mm, right_mm

    @property
    def collisions(self) -> int:
        """Number of times that it has begun to touch something."""
        return int(self._body.collisions)

    @property
    def touches(self) -> int:
        """Number of things that it touches now."""
        return int(self._body.touches)

    def sense(self, tick: int) -> Senses:
        """The senses that the robot is told at its pose.

        Food is seen in a corridor straight ahead if nothing hides it.

        Args:
            tick: Number of the control tick in the run.
        """
        self._library.world_sense(self._world, self._body, tick, self._sensed)
        return Senses._make(self._senses.unpack_from(self._sensed_bytes))

    def measure_light(self, tick: int, light: Any) -> None:
        """Measures the light of their own LEDs that the infrared sensors of a kit receive.

        Args:
            tick: Number of the control tick in the run.
            light: The result, a `uint16_t[]`, 0..4095 each, in the order of feel's bits.
        """
        self._library.kit_light(self.kit, self._world, self._body, tick, light)

    def eat(self) -> bool:
        """Eats the food that was sensed straight ahead, if it is near enough and no other robot was quicker.

        Returns:
            True if food was eaten, False if none was seen or it is `eat_reach_mm` away or farther.
        """
        return bool(self._library.world_eat(self._world, self._body))

    def move(self, left_mm_s: float, right_mm_s: float) -> None:
        """Lets the wheels roll for one control tick.

        Args:
            left_mm_s: Speed of the left wheel, mm/s, forward positive; limited to `SimParams.max_wheel_speed_mm_s`.
            right_mm_s: Speed of the right wheel, likewise.
        """
        self._library.world_move(self._world, self._body, left_mm_s, right_mm_s)
        if self._inside.space.failures:
            self._inside.check()

    def add_fault(self, what: str, seed: int = 0) -> None:
        """Adds or repairs a fault, as `add_fault`.

        Raises:
            ValueError: There is no such fault.
        """
        add_fault(self._ffi.addressof(self.faults), what, seed, self._index)
        self._library.kit_suffer(self.kit, self._ffi.addressof(self.faults))


@cache
def _readers() -> tuple[Struct, Struct, Struct]:
    """The formats of a pose, the odometers, and the senses in memory."""
    ffi, _ = world_library()
    body, senses = "struct body", "struct senses"
    return members(ffi, body, _POSE), members(ffi, body, _ODOMETER), members(ffi, senses, Senses._fields)


def rolled(pose: Pose, left_mm: float, right_mm: float, track_mm: float) -> Pose:
    """The pose after each wheel has rolled its distance at a constant speed: the body follows an arc.

    If the left wheel rolls farther than the right one, the body turns right, which is the positive direction.

    >>> rolled(Pose(0.0, 0.0, 0.0), left_mm=10.0, right_mm=-10.0, track_mm=160.0).heading_rad
    0.125
    """
    ffi, library = world_library()
    body = ffi.new("struct body *", pose)
    library.body_face(body)
    library.body_roll(body, left_mm, right_mm, track_mm)
    return Pose(body.x_mm, body.y_mm, body.heading_rad)
