"""Crates: bars that robots push, with pymunk, since plain geometry has neither mass nor friction.

An arena holds its bars where they are, and robots are pushed out of them. After each tick this module says where the
robots have pushed them: as edits, so that a log is repeated, and its page drawn, without pymunk.
"""

import math
from collections.abc import Iterator, Sequence

import pymunk

from host_sim.protocol.generated import Drive
from host_sim.world.arena import Arena
from host_sim.world.body import Body
from host_sim.world.edits import Edit
from host_sim.world.geometry import Bar, Plant, Point, SimParams
from host_sim.world.layouts import CrateKind

_CRATES, _ROBOTS, _FIXED = 1, 2, 4  # categories
_GRAVITY_MM_S2 = 9810.0
_ROBOT_KG = 1.0
_MARGIN_MM = 1.0
"""Maximum distance of a blocked robot from what blocks it."""
_WALL_MM = 100.0
_IN_THE_AIR_MM = -10_000.0


class Crates:
    """The crates of an arena in pymunk, among fixed walls and plants, and robots that push them."""

    def __init__(self, arena: Arena, kind: CrateKind) -> None:
        """Starts with the crates where they are.

        Args:
            arena: All of its bars are crates.
            kind: Their properties.
        """
        self._arena, self._params, self._kind = arena, arena.params, kind
        self._space = pymunk.Space()
        self._crates: dict[int, _Crate] = {}
        self._plants: dict[int, Plant] = {}
        self._planted: list[pymunk.Shape] = []
        self._robots = [_add_robot(self._space, self._params.body_radius_mm) for _ in arena.bodies]
        width, height, out = self._params.width_mm, self._params.height_mm, _WALL_MM
        corners = [(-out, -out), (width + out, -out), (width + out, height + out), (-out, height + out)]
        for a, b in zip(corners, [*corners[1:], corners[0]], strict=True):
            self._add_fixed(pymunk.Segment(self._space.static_body, a, b, _WALL_MM))

    def push(self, drives: Sequence[Drive]) -> Iterator[Edit]:
        """Lets the robots push for one tick, at their poses after it, with their commanded speeds.

        Args:
            drives: Each robot's drive.

        Yields:
            A `push_bar` for each crate that has moved, to be made before the next tick.
        """
        self._look()
        for robot, body, drive in zip(self._robots, self._arena.bodies, drives, strict=True):
            _press(robot, body, drive, self._params)
        self._space.step(self._params.tick_s)
        for bar_id, crate in self._crates.items():
            bar = crate.now
            if bar != _whole(crate.bar):
                crate.bar = bar
                yield Edit("push_bar", bar_id, a=bar.a, b=bar.b)

    def _look(self) -> None:
        """Takes over what a person or a schedule has changed."""
        bars, plants = self._arena.obstacles.bars, self._arena.obstacles.plants
        for bar_id in [bar_id for bar_id, crate in self._crates.items() if bars.get(bar_id) != crate.bar]:
            self._crates.pop(bar_id).leave(self._space)
        for bar_id in bars.keys() - self._crates.keys():
            self._crates[bar_id] = _Crate(self._space, bars[bar_id], self._params.bar_thickness_mm / 2, self._kind)
        if plants != self._plants:
            self._plants = plants
            self._space.remove(*self._planted)
            ground = self._space.static_body
            self._planted = [pymunk.Circle(ground, plant.radius_mm, plant.at) for plant in plants.values()]
            for shape in self._planted:
                self._add_fixed(shape)

    def _add_fixed(self, shape: pymunk.Shape) -> None:
        shape.filter = pymunk.ShapeFilter(categories=_FIXED, mask=_CRATES)
        self._space.add(shape)


class _Crate:
    """A crate on the floor, whose friction holds it and stops it.

    Attributes:
        bar: The bar that stands for it in the arena.
    """

    def __init__(self, space: pymunk.Space, bar: Bar, radius_mm: float, kind: CrateKind) -> None:
        self.bar = bar
        self._half_mm = math.dist(bar.a, bar.b) / 2
        mass_kg = kind.kg_per_m2 * 1e-6 * radius_mm * (4 * self._half_mm + math.pi * radius_mm)
        ends = (-self._half_mm, 0.0), (self._half_mm, 0.0)
        self._body = pymunk.Body(mass_kg, pymunk.moment_for_segment(mass_kg, *ends, radius_mm))
        self._body.position = (bar.a[0] + bar.b[0]) / 2, (bar.a[1] + bar.b[1]) / 2
        self._body.angle = math.atan2(bar.b[1] - bar.a[1], bar.b[0] - bar.a[0])
        shape = pymunk.Segment(self._body, *ends, radius_mm)
        shape.friction = kind.friction
        shape.filter = pymunk.ShapeFilter(categories=_CRATES)
        # Seen from above: joints that do not pull, and hold it with at most the force and torque of friction.
        slide = pymunk.PivotJoint(space.static_body, self._body, (0.0, 0.0), (0.0, 0.0))
        twist = pymunk.GearJoint(space.static_body, self._body, 0.0, 1.0)
        slide.max_bias = twist.max_bias = 0.0
        slide.max_force = kind.friction * mass_kg * _GRAVITY_MM_S2
        twist.max_force = slide.max_force * (self._half_mm + radius_mm) / 2
        self._parts = (self._body, shape, slide, twist)
        space.add(*self._parts)

    def leave(self, space: pymunk.Space) -> None:
        """Removes it from its space."""
        space.remove(*self._parts)

    @property
    def now(self) -> Bar:
        """The bar where pymunk has it, in whole mm, as edits have it."""
        a, b = (self._body.local_to_world((end, 0.0)) for end in (-self._half_mm, self._half_mm))
        return _whole(Bar((a.x, a.y), (b.x, b.y)))


def _whole(bar: Bar) -> Bar:
    return Bar(*((float(round(x)), float(round(y))) for x, y in bar))


def _add_robot(space: pymunk.Space, radius_mm: float) -> pymunk.Body:
    robot = pymunk.Body(_ROBOT_KG, math.inf)
    disc = pymunk.Circle(robot, radius_mm + _MARGIN_MM)
    disc.filter = pymunk.ShapeFilter(categories=_ROBOTS, mask=_CRATES)
    space.add(robot, disc)
    return robot


def _press(robot: pymunk.Body, body: Body, drive: Drive, params: SimParams) -> None:
    """Puts a robot where its body is, with its commanded speed."""
    pose, most = body.pose, params.max_wheel_speed_mm_s
    left, right = (max(-most, min(most, speed)) for speed in (drive.left_mm_s, drive.right_mm_s))
    ahead: Point = (math.cos(pose.heading_rad), math.sin(pose.heading_rad))
    robot.position = (_IN_THE_AIR_MM, _IN_THE_AIR_MM) if body.lifted else (pose.x_mm, pose.y_mm)
    robot.velocity = ahead[0] * (left + right) / 2, ahead[1] * (left + right) / 2
