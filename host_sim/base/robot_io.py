"""What a body and its robot exchange at each control tick, in the integer units of the bus.

The observation, field by field:

| field          | meaning                                                             | min | max  | unit   |
| -------------- | ------------------------------------------------------------------- | --- | ---- | ------ |
| tick           | number of the control tick, wraps                                   | 0   | 255  | ticks  |
| feel           | proximity: right 1, front-right 2, front 4, front-left 8, left 16   | 0   | 31   | bits   |
| bump           | the body touches something                                          | 0   | 1    |        |
| look           | food is seen straight ahead                                         | 0   | 1    |        |
| beacon_mm      | distance from the centre of the body to that food; 0: none          | 0   | 8191 | mm     |
| odometer_left  | distance rolled by the left wheel, forward counts up, wraps         | 0   | 4095 | 0.1 mm |
| odometer_right | distance rolled by the right wheel, forward counts up, wraps        | 0   | 4095 | 0.1 mm |

The distances, for a robot that asks for them: for each proximity sensor in the order of feel's bits, whole mm from
the body's rim to the nearest thing in its cone, None where nothing is within its reach.

The action, field by field:

| field        | meaning                                                | min   | max  | unit  |
| ------------ | ------------------------------------------------------ | ----- | ---- | ----- |
| tick         | tick of the senses that this answers                   | 0     | 255  | ticks |
| left_mm_s    | speed of the left wheel, forward positive              | -2047 | 2047 | mm/s  |
| right_mm_s   | speed of the right wheel, forward positive             | -2047 | 2047 | mm/s  |
| reason       | why, a `Reason` of octet.dbc                           | 0     | 8    |       |
| repeat_count | remembered turns since the way was last clear          | 0     | 255  | turns |
| action       | number of the action, one more for each new one, wraps | 0     | 127  |       |
| eat          | eat the food that is seen straight ahead               | 0     | 1    |       |
"""

from typing import NamedTuple


class Senses(NamedTuple):
    """What the body senses at one tick; the table above has the ranges."""

    tick: int
    feel: int
    bump: bool
    look: bool
    beacon_mm: int
    odometer_left: int
    odometer_right: int


class Ranges(NamedTuple):
    """How far away what is near is; see above."""

    right: int | None = None
    front_right: int | None = None
    front: int | None = None
    front_left: int | None = None
    left: int | None = None


class Drive(NamedTuple):
    """What the wheels are to do until the next tick; the table above has the ranges."""

    tick: int
    left_mm_s: int
    right_mm_s: int
    reason: int
    repeat_count: int
    action: int
    eat: bool


NOTHING_NEAR = Ranges()
"""The distances of a body with nothing within reach."""

NOTHING_SENSED = Senses(tick=0, feel=0, bump=False, look=False, beacon_mm=0, odometer_left=0, odometer_right=0)
"""The senses of a body that has not sensed anything yet."""

REST = Drive(tick=0, left_mm_s=0, right_mm_s=0, reason=0, repeat_count=0, action=0, eat=False)
"""Wheels at rest."""
