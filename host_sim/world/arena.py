"""The robot's body among walls, obstacles and food, one control tick at a time."""

import math
from collections.abc import Sequence

import pymunk

from host_sim.robot_io import Senses
from host_sim.world.geometry import Point, Pose, turned
from host_sim.world.layouts import Layout
from host_sim.world.obstacles import Obstacles
from host_sim.world.params import SimParams
from host_sim.world.sensors import OBSTACLE, ROBOT, Perimeter, Sighting, look

_IN_THE_AIR = -10_000.0, -10_000.0
# A pushed-out body stays this deep in the obstacle, so that it goes on touching and does not bounce.
_TOUCH_MM = 0.01
_PUSHES = 8
_COUNTER_MASK = 4095
_COUNTS_PER_MM = 10


class Arena:
    """One environment with one robot in it.

    Each tick is `sense`, perhaps `eat`, then `move`. Equal environments and drives give equal senses, bit for bit.

    Chipmunk finds overlaps; the motion itself is worked out here, exactly: the wheels roll the body along an arc,
    and a body pressed into an obstacle is pushed straight out of it, so it stops or slides.
    """

    def __init__(self, layout: Layout, params: SimParams, odometer: Point = (0.0, 0.0)) -> None:
        """Builds the space and senses once, so that the first `sense` is right.

        Args:
            layout: The layout.
            params: The measures.
            odometer: Way of the left and the right wheel so far, mm, where the robot comes from another arena.
        """
        self._params = params
        self._x, self._y, self._heading = layout.start
        self._left_mm, self._right_mm = odometer
        self._start = layout.start
        self._food, self._uneaten = list(layout.food), dict(enumerate(layout.food))
        self._lifted = False
        self._collisions, self._touches = 0, 0
        self._depth_mm, self._normal = 0.0, (0.0, 0.0)
        self._space = pymunk.Space()
        self._obstacles = Obstacles(self._space, layout.bars, params)
        self._body = self._add_body()
        self._perimeter = Perimeter(self._space, self._body, params)
        self._place()

    @property
    def pose(self) -> Pose:
        """Where the robot is and looks."""
        return Pose(self._x, self._y, self._heading)

    @property
    def odometer(self) -> Point:
        """Way of the left and the right wheel since the first arena, mm, forward positive; slip counts as way."""
        return self._left_mm, self._right_mm

    @property
    def eaten(self) -> list[bool]:
        """For each piece of the environment's food, whether it has been eaten."""
        return [food_id not in self._uneaten for food_id in range(len(self._food))]

    @property
    def food_left(self) -> int:
        """Number of pieces of food not eaten yet."""
        return len(self._uneaten)

    @property
    def obstacles(self) -> Obstacles:
        """The bars by their ids, at first 0, 1, ... as in the environment; `settle` after a change."""
        return self._obstacles

    @property
    def food(self) -> Sequence[Point]:
        """Where each piece of food is, or was before it was eaten."""
        return self._food

    @property
    def layout(self) -> Layout:
        """The environment as it is now, with its first start."""
        return Layout(tuple(self._obstacles.bars.values()), tuple(self._food), self._start)

    @property
    def lifted(self) -> bool:
        """Whether someone holds the robot in the air."""
        return self._lifted

    @property
    def collisions(self) -> int:
        """How often the body has begun to touch an obstacle or a wall."""
        return self._collisions

    @property
    def touching(self) -> bool:
        """Whether the body touches an obstacle or a wall now."""
        return self._touches > 0

    def sense(self, tick: int) -> Senses:
        """What the robot senses where it stands.

        Args:
            tick: Number of the control tick; it is wrapped to 0..4095.
        """
        sighting = self._look()
        return Senses(
            tick & _COUNTER_MASK,
            self._perimeter.feel,
            self._touches > 0,
            sighting is not None,
            sighting.distance_mm if sighting else 0,
            round(self._left_mm * _COUNTS_PER_MM) & _COUNTER_MASK,
            round(self._right_mm * _COUNTS_PER_MM) & _COUNTER_MASK,
        )

    def eat(self) -> bool:
        """Eats the food that is seen straight ahead, if it is near enough.

        Returns:
            True if food was eaten, False if none is seen or it is `eat_reach_mm` away or farther.
        """
        sighting = self._look()
        if sighting is None or sighting.distance_mm >= self._params.eat_reach_mm:
            return False
        del self._uneaten[next(food_id for food_id, food in self._uneaten.items() if food == sighting.food)]
        return True

    def move(self, left_mm_s: float, right_mm_s: float) -> None:
        """Lets the wheels roll for one control tick.

        Args:
            left_mm_s: Speed of the left wheel, forward positive; cut to the world's greatest.
            right_mm_s: Speed of the right wheel, the same.
        """
        limit, tick_s = self._params.max_wheel_speed_mm_s, self._params.tick_s
        left_mm = max(-limit, min(limit, left_mm_s)) * tick_s
        right_mm = max(-limit, min(limit, right_mm_s)) * tick_s
        self._left_mm += left_mm
        self._right_mm += right_mm
        if not self._lifted:
            turn = turned(left_mm, right_mm, self._params.wheel_track_mm)
            self._advance((left_mm + right_mm) / 2, turn)

    def move_food(self, food_id: int, at: Point) -> None:
        """Lays a piece of food elsewhere; one that was eaten stays eaten."""
        self._food[food_id] = at
        if food_id in self._uneaten:
            self._uneaten[food_id] = at

    def lift(self) -> None:
        """Takes the robot off the floor: its wheels turn, it senses nothing and goes nowhere."""
        self._lifted = True
        self.settle()

    def put(self, pose: Pose) -> None:
        """Puts the lifted robot down where there is room for it."""
        self._lifted = False
        self._x, self._y, self._heading = pose
        self.settle()

    def settle(self) -> None:
        """Senses anew after a change of the obstacles."""
        self._place()
        if self._lifted:
            self._body.position = _IN_THE_AIR
            self._space.step(self._params.tick_s)

    def _advance(self, way_mm: float, turn_rad: float) -> None:
        """Moves the body's middle along an arc, as far as obstacles let it."""
        half = turn_rad / 2
        chord_mm = way_mm * math.sin(half) / half if half else way_mm
        before = self._x, self._y
        self._x += chord_mm * math.cos(self._heading + half)
        self._y += chord_mm * math.sin(self._heading + half)
        self._heading = math.remainder(self._heading + turn_rad, math.tau)
        self._place()
        if self._depth_mm > _TOUCH_MM:
            self._push_out(before)

    def _push_out(self, before: Point) -> None:
        """Frees the body from the deepest overlap, again and again; if wedged, back to where it was."""
        for _ in range(_PUSHES):
            push_mm = self._depth_mm - _TOUCH_MM / 2
            self._x -= push_mm * self._normal[0]
            self._y -= push_mm * self._normal[1]
            self._place()
            if self._depth_mm <= _TOUCH_MM:
                return
        self._x, self._y = before
        self._place()

    def _place(self) -> None:
        """Puts the body where it has come to and finds what it and its cones overlap there."""
        self._depth_mm = 0.0
        self._body.position = self._x, self._y
        self._body.angle = self._heading
        self._space.step(self._params.tick_s)

    def _look(self) -> Sighting | None:
        if self._lifted:
            return None
        return look(self._space, self.pose, self._uneaten.values(), self._params.beam_width_mm)

    def _add_body(self) -> pymunk.Body:
        body = pymunk.Body(body_type=pymunk.Body.KINEMATIC)
        disc = pymunk.Circle(body, self._params.body_radius_mm)
        disc.collision_type = ROBOT
        disc.filter = pymunk.ShapeFilter(categories=ROBOT)
        self._space.add(body, disc)
        self._space.on_collision(ROBOT, OBSTACLE, begin=self._begin, pre_solve=self._press, separate=self._separate)
        return body

    def _begin(self, _arbiter: pymunk.Arbiter, _space: pymunk.Space, _data: None) -> None:
        self._touches += 1
        self._collisions += 1

    def _separate(self, _arbiter: pymunk.Arbiter, _space: pymunk.Space, _data: None) -> None:
        self._touches -= 1

    def _press(self, arbiter: pymunk.Arbiter, _space: pymunk.Space, _data: None) -> None:
        """Remembers the deepest overlap of this step, with its normal from the body into the obstacle."""
        contact = arbiter.contact_point_set
        depth_mm = -contact.points[0].distance
        if depth_mm > self._depth_mm:
            self._depth_mm, self._normal = depth_mm, contact.normal
