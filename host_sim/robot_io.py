"""What travels between the body and the robot's mind at each control tick, in the wire's own whole numbers."""

from typing import NamedTuple


class Senses(NamedTuple):
    """What the body senses.

    Attributes:
        tick: 0..4095, wraps.
        feel: Proximity, one bit each: right 1, front-right 2, front 4, front-left 8, left 16.
        bump: Whether the body touches an obstacle or a wall.
        look: Whether food is seen straight ahead.
        beacon_mm: Distance from the middle of the body to that food, 1..8191; 0 if none is seen.
        odometer_left: Way of the left wheel in 0.1 mm, forward counts up, 0..4095, wraps.
        odometer_right: The same for the right wheel.
    """

    tick: int
    feel: int
    bump: bool
    look: bool
    beacon_mm: int
    odometer_left: int
    odometer_right: int


class Drive(NamedTuple):
    """What the wheels are to do until the next tick.

    Attributes:
        tick: That of the senses which this answers, 0..4095.
        left_mm_s: Speed of the left wheel, -2047..2047, forward positive.
        right_mm_s: Speed of the right wheel, the same.
        reason: 0 stop, 1 wander, 2 toward food, 3 look around, 4 remembered turn, 5 trial, 6 boredom, 7 eat.
        repeat_count: Remembered turns since the way was last clear, 0..255.
        action: One more for each new action, 0..127, wraps.
        eat: Whether to eat the food seen straight ahead.
    """

    tick: int
    left_mm_s: int
    right_mm_s: int
    reason: int
    repeat_count: int
    action: int
    eat: bool
