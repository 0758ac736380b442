"""One robot's body: it moves with its wheels, senses, and is pushed out of whatever it runs into."""

import math
from typing import Any

import pymunk

from host_sim.robot_io import Senses
from host_sim.world.body_faults import SOUND
from host_sim.world.cones import CONE_BEARINGS_DEG, cone_outline, cone_reach_mm
from host_sim.world.food import Food
from host_sim.world.geometry import Point, Pose
from host_sim.world.params import SimParams
from host_sim.world.shapes import CONES, DISC, OBSTACLE, cone_filter, disc_filter, sight_filter

_IN_THE_AIR_MM = -10_000.0
# A pushed-out body stays this deep in the obstacle, so that it goes on touching and does not bounce.
_TOUCH_MM = 0.01
_PUSHES = 8
_COUNTER_MASK = 4095
_COUNTS_PER_MM = 10


class Body:
    """A disc with two wheels, five proximity cones and a beam that sees food.

    Each tick is `sense`, optionally `eat`, then `move`. Chipmunk finds overlaps; the motion itself is computed here,
    exactly: the wheels roll the body along an arc, and a body pressed into an obstacle is pushed straight out of it,
    so it stops or slides. Another robot's disc is an obstacle like any other.

    Attributes:
        pose: Its position and heading.
        in_space: Itself in the space.
        disc: Its shape in the space.
        first_cone: Collision type of the cone of the lowest bit of feel; those of the others follow.
        sight: Filter of its line of sight.
        in_the_air: Where the space has it while it is lifted, mm.
        feel: One bit for each cone with something in it, as of the space's last step: right 1, front-right 2,
            front 4, front-left 8, left 16.
        collisions: Number of times that it has begun to touch something.
        touches: Number of things that it touches now.
        lifted: Whether a person holds it in the air.
        faults: What is wrong with it. Its odometers count accordingly; the other faults apply where senses and drives
            pass between body and robot.
    """

    def __init__(  # noqa: PLR0913, PLR0917 - its surroundings and its state
        self, space: pymunk.Space, food: Food, params: SimParams, index: int, start: Pose, odometer: Point
    ) -> None:
        """Adds the body to a space.

        Args:
            space: Holds the obstacles.
            food: The food in the arena.
            params: The dimensions of the world.
            index: 0, 1, ...; unique in the space.
            start: Its first pose.
            odometer: What the left and the right odometer have counted in earlier arenas, mm.
        """
        self.feel = self.collisions = self.touches = 0
        self.lifted, self.faults = False, SOUND
        self._space, self._food, self._params = space, food, params
        self.in_the_air = _IN_THE_AIR_MM, _IN_THE_AIR_MM * (index + 1)
        self.pose = start
        self._left_mm, self._right_mm = odometer
        self._depth_mm, self._normal = 0.0, (0.0, 0.0)
        self._seen_id, self._seen_mm = -1, 0
        self.in_space = pymunk.Body(body_type=pymunk.Body.KINEMATIC)
        self.sight = sight_filter(index + 1)
        self.disc = pymunk.Circle(self.in_space, params.body_radius_mm)
        self.disc.collision_type, self.disc.filter = DISC, disc_filter(index + 1)
        # Chipmunk must find the body where it starts.
        self.in_space.position, self.in_space.angle = start[:2], start.heading_rad
        space.add(self.in_space, self.disc)
        self._overlaps = dict.fromkeys(CONE_BEARINGS_DEG, 0)
        self.first_cone = CONES + index * len(CONE_BEARINGS_DEG)
        for number, bit in enumerate(CONE_BEARINGS_DEG, self.first_cone):
            self._add_cone(bit, number, cone_filter(index + 1))

    @property
    def odometer(self) -> Point:
        """Counted by the left and the right odometer since the first arena, mm, forward positive, with slip."""
        return self._left_mm, self._right_mm

    @property
    def state(self) -> tuple[float, ...]:
        """All that changes in it, as plain numbers in the order of `struct body` in `native/world.h`.

        Setting it to an earlier value leaves the shapes in the space where they are.
        """
        return (
            *self.pose,
            *(self._left_mm, self._right_mm),
            *(self._depth_mm, *self._normal),
            *(self._seen_id, self._seen_mm),
            *(self.touches, self.collisions, *self._overlaps.values()),
            *(self.feel, self.lifted),
        )

    @state.setter
    def state(self, state: tuple[Any, ...]) -> None:
        x, y, heading, self._left_mm, self._right_mm, self._depth_mm, normal_x, normal_y, *whole = state
        self.pose, self._normal = Pose(x, y, heading), (normal_x, normal_y)
        self._seen_id, self._seen_mm, self.touches, self.collisions, *overlaps, self.feel, self.lifted = whole
        self._overlaps = dict(zip(self._overlaps, overlaps, strict=True))

    def sense(self, tick: int) -> Senses:
        """What the robot senses where it stands. Food is seen in a corridor straight ahead if nothing hides it.

        Args:
            tick: Number of the control tick, as the robot is to be told it.
        """
        self._seen_id, beacon_mm = -1, 0
        if not self.lifted:
            x, y, heading = self.pose
            ahead_x, ahead_y, half = math.cos(heading), math.sin(heading), self._params.beam_width_mm / 2
            for food_id, food in self._food.uneaten.items():
                dx, dy = food[0] - x, food[1] - y
                if dx * ahead_x + dy * ahead_y <= 0.0 or abs(dy * ahead_x - dx * ahead_y) > half:
                    continue
                distance_mm = max(1, round(math.sqrt(dx * dx + dy * dy)))
                if (beacon_mm == 0 or distance_mm < beacon_mm) and not self._is_hidden(food):
                    self._seen_id, beacon_mm = food_id, distance_mm
        self._seen_mm = beacon_mm
        return Senses(
            tick=tick,
            feel=self.feel,
            bump=self.touches > 0,
            look=beacon_mm > 0,
            beacon_mm=beacon_mm,
            odometer_left=round(self._left_mm * _COUNTS_PER_MM) & _COUNTER_MASK,
            odometer_right=round(self._right_mm * _COUNTS_PER_MM) & _COUNTER_MASK,
        )

    def eat(self) -> bool:
        """Eats the food that was sensed straight ahead, if it is near enough and no other robot was quicker.

        Returns:
            True if food was eaten, False if none was seen or it is `eat_reach_mm` away or farther.
        """
        if self._seen_id not in self._food.uneaten or self._seen_mm >= self._params.eat_reach_mm:
            return False
        self._food.eat(self._seen_id)
        return True

    def move(self, left_mm_s: float, right_mm_s: float) -> None:
        """Lets the wheels roll for one control tick.

        Args:
            left_mm_s: Speed of the left wheel, mm/s, forward positive; limited to `SimParams.max_wheel_speed_mm_s`.
            right_mm_s: Speed of the right wheel, likewise.
        """
        limit, tick_s = self._params.max_wheel_speed_mm_s, self._params.tick_s
        left_mm = max(-limit, min(limit, left_mm_s)) * tick_s
        right_mm = max(-limit, min(limit, right_mm_s)) * tick_s
        counted = (left_mm, right_mm) if self.faults is SOUND else self.faults.counted(left_mm, right_mm)
        self._left_mm += counted[0]
        self._right_mm += counted[1]
        if self.lifted:
            return
        before = self.pose
        self.pose = rolled(before, left_mm, right_mm, self._params.wheel_track_mm)
        self.place()
        if self._depth_mm > _TOUCH_MM:
            self._push_out(before)

    def lift(self) -> None:
        """Lifts the body off the floor: its wheels still turn, but it does not move or sense anything."""
        self.lifted = True

    def put(self, pose: Pose) -> None:
        """Puts the body down. The caller makes sure that there is room for it."""
        self.lifted = False
        self.pose = pose

    def place(self) -> None:
        """Moves its shapes to its pose and finds what the body and its cones overlap there."""
        x, y, heading = self.pose
        self._depth_mm = 0.0
        self.in_space.position = self.in_the_air if self.lifted else (x, y)
        self.in_space.angle = heading
        self._space.step(self._params.tick_s)

    def press(self, depth_mm: float, normal: Point) -> None:
        """Records an overlap if it is the deepest of this step; the normal points from the body into the obstacle."""
        if depth_mm > self._depth_mm:
            self._depth_mm, self._normal = depth_mm, normal

    def _push_out(self, before: Pose) -> None:
        """Pushes the body out of its deepest overlap, repeatedly; a wedged body goes back to where it was."""
        for _ in range(_PUSHES):
            push_mm = self._depth_mm - _TOUCH_MM / 2
            x, y, heading = self.pose
            self.pose = Pose(x - push_mm * self._normal[0], y - push_mm * self._normal[1], heading)
            self.place()
            if self._depth_mm <= _TOUCH_MM:
                return
        self.pose = self.pose._replace(x_mm=before.x_mm, y_mm=before.y_mm)
        self.place()

    def _is_hidden(self, food: Point) -> bool:
        return self._space.segment_query_first(self.pose[:2], food, 0.0, self.sight) is not None

    def _add_cone(self, bit: int, collision_type: int, detects: pymunk.ShapeFilter) -> None:
        """Adds a cone. Chipmunk reports when it begins and ceases to overlap something: reading it costs nothing."""
        params, space = self._params, self._space
        cone = pymunk.Poly(self.in_space, cone_outline(CONE_BEARINGS_DEG[bit], cone_reach_mm(bit, params)))
        cone.sensor = True
        cone.collision_type, cone.filter = collision_type, detects
        space.add(cone)
        for other in (OBSTACLE, DISC):
            space.on_collision(collision_type, other, begin=self._begin, separate=self._separate, data=bit)

    def _begin(self, _arbiter: pymunk.Arbiter, _space: pymunk.Space, bit: int) -> None:
        self._overlaps[bit] += 1
        self.feel |= bit

    def _separate(self, _arbiter: pymunk.Arbiter, _space: pymunk.Space, bit: int) -> None:
        self._overlaps[bit] -= 1
        if not self._overlaps[bit]:
            self.feel &= ~bit


def rolled(pose: Pose, left_mm: float, right_mm: float, track_mm: float) -> Pose:
    """The pose after each wheel has rolled its distance at a constant speed: the body follows an arc.

    If the left wheel rolls farther than the right one, the body turns right, which is the positive direction.

    >>> rolled(Pose(0.0, 0.0, 0.0), left_mm=10.0, right_mm=-10.0, track_mm=160.0).heading_rad
    0.125
    """
    turn, way_mm = (left_mm - right_mm) / track_mm, (left_mm + right_mm) / 2
    half = turn / 2
    chord_mm = way_mm * math.sin(half) / half if half else way_mm
    x, y, heading = pose
    return Pose(
        x + chord_mm * math.cos(heading + half),
        y + chord_mm * math.sin(heading + half),
        math.remainder(heading + turn, math.tau),
    )
