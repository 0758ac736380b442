"""What overlaps in an arena, by pymunk: the reference physics. `PlainSpace` finds the same, bit for bit.

C code calls the functions of `native/space.h`, which are Python here, whenever it places a body. All else about the
world is in C.
"""

from typing import Any

import pymunk

from host_sim.world.geometry import Capsule, SimParams
from host_sim.world.native_world import CONE_BEARINGS_DEG, cone_outline, cone_reach_mm

_OBSTACLE, _DISC, _CONES = 1, 2, 100  # collision types; each cone has its own
_OBSTACLES, _DISCS, _SENSORS = 1, 2, 4  # categories
_IN_THE_AIR_MM = -10_000.0


class MunkSpace:
    """A pymunk space with the obstacles and bodies of an arena.

    Attributes:
        failures: Exceptions raised in Python during calls from C; the caller of the C code raises them again.
    """

    def __init__(self, ffi: Any, world: Any, bodies: Any, params: SimParams) -> None:
        """Becomes the space of a `struct world *`, whose bodies are where they start.

        Args:
            ffi: Has the declarations.
            world: The world.
            bodies: The owner of its bodies, whose overlaps Chipmunk still ends when the space is freed.
            params: Its dimensions.
        """
        self.failures = failures = list[BaseException]()
        self._space, self._obstacles = pymunk.Space(), dict[Capsule, list[pymunk.Shape]]()
        finder = _Finder(self._space, bodies, params)

        def note(_kind: object, failure: BaseException, _trace: object) -> None:
            failures.append(failure)

        asked = ffi.typeof("struct space").fields
        self._asked = {name: ffi.callback(field.type, getattr(finder, name), onerror=note) for name, field in asked}
        self._in_c = ffi.new("struct space *", self._asked)
        world.space = self._in_c

    def lay_out(self, obstacles: Any) -> None:
        """Takes these obstacles, a `struct capsule[]`; shapes of equal ones are kept, with their overlaps."""
        before, self._obstacles = self._obstacles, {}
        for thing in (Capsule((it.a.x, it.a.y), (it.b.x, it.b.y), it.radius_mm) for it in obstacles):
            shapes = before.get(thing)
            self._obstacles.setdefault(thing, []).append(shapes.pop(0) if shapes else self._add(thing))
        for shapes in before.values():
            self._space.remove(*shapes)

    def _add(self, thing: Capsule) -> pymunk.Shape:
        ground, (a, b, radius_mm) = self._space.static_body, thing
        shape = pymunk.Circle(ground, radius_mm, a) if a == b else pymunk.Segment(ground, a, b, radius_mm)
        shape.collision_type, shape.filter = _OBSTACLE, pymunk.ShapeFilter(categories=_OBSTACLES)
        self._space.add(shape)
        return shape


class _Finder:
    """Places the bodies in the space, and finds what is in their line of sight."""

    def __init__(self, space: pymunk.Space, bodies: Any, params: SimParams) -> None:
        self._space, self._bodies, self._tick_s = space, bodies, params.tick_s
        self._in_space = [_add_body(space, bodies, i, params) for i in range(len(bodies))]
        touches = _Touches(bodies, {shapes[0]: i for i, (_, shapes) in enumerate(self._in_space)})
        for other in (_OBSTACLE, _DISC):
            space.on_collision(_DISC, other, touches.begin, touches.press, separate=touches.end)

    def place(self, _world: Any, body: Any) -> None:
        """Finds what a body and its cones overlap at its pose. Chipmunk tells when an overlap begins and ends."""
        index = body - self._bodies
        in_space = self._in_space[index][0]
        in_the_air = _IN_THE_AIR_MM, _IN_THE_AIR_MM * (index + 1)
        in_space.position = in_the_air if body.lifted else (body.x_mm, body.y_mm)
        in_space.angle = body.heading_rad
        self._space.step(self._tick_s)

    def hides(self, _world: Any, body: Any, point: Any) -> bool:
        """Whether an obstacle or another body is between a body and a point."""
        looks_for = pymunk.ShapeFilter(group=1 + body - self._bodies, mask=_OBSTACLES | _DISCS)
        start, end = (body.x_mm, body.y_mm), (point.x, point.y)
        return self._space.segment_query_first(start, end, 0.0, looks_for) is not None


class _Touches:
    """What the bodies' discs touch, and how deep."""

    def __init__(self, bodies: Any, by_disc: dict[pymunk.Shape, int]) -> None:
        self._bodies, self._by_disc = bodies, by_disc

    def _touched(self, arbiter: pymunk.Arbiter) -> list[Any]:
        return [self._bodies[self._by_disc[shape]] for shape in arbiter.shapes if shape in self._by_disc]

    def begin(self, arbiter: pymunk.Arbiter, _space: pymunk.Space, _data: None) -> None:
        """A disc begins to touch something."""
        for body in self._touched(arbiter):
            body.touches += 1
            body.collisions += 1

    def press(self, arbiter: pymunk.Arbiter, _space: pymunk.Space, _data: None) -> None:
        """A disc overlaps something; the deepest counts. The normal points from the first shape into the second."""
        contact = arbiter.contact_point_set
        depth_mm, normal = -contact.points[0].distance, contact.normal
        for body, way in zip(self._touched(arbiter), (1.0, -1.0), strict=False):
            if depth_mm > body.depth_mm:
                body.depth_mm, body.normal = depth_mm, (way * normal[0], way * normal[1])

    def end(self, arbiter: pymunk.Arbiter, _space: pymunk.Space, _data: None) -> None:
        """A disc ceases to touch something."""
        for body in self._touched(arbiter):
            body.touches -= 1


def _add_body(
    space: pymunk.Space, bodies: Any, index: int, params: SimParams
) -> tuple[pymunk.Body, list[pymunk.Shape]]:
    """A body and its shapes: the disc, then the cones. Shapes of one body do not collide."""
    group, body = index + 1, bodies[index]
    in_space = pymunk.Body(body_type=pymunk.Body.KINEMATIC)
    in_space.position, in_space.angle = (body.x_mm, body.y_mm), body.heading_rad  # where Chipmunk finds it first
    disc = pymunk.Circle(in_space, params.body_radius_mm)
    disc.collision_type, disc.filter = _DISC, pymunk.ShapeFilter(group=group, categories=_DISCS)
    shapes: list[pymunk.Shape] = [disc]
    for number, (bit, bearing_deg) in enumerate(CONE_BEARINGS_DEG.items()):
        cone = pymunk.Poly(in_space, cone_outline(bearing_deg, cone_reach_mm(bit, params)))
        cone.sensor, cone.collision_type = True, _CONES + index * len(CONE_BEARINGS_DEG) + number
        cone.filter = pymunk.ShapeFilter(group=group, categories=_SENSORS, mask=_OBSTACLES | _DISCS)
        for other in (_OBSTACLE, _DISC):
            space.on_collision(
                cone.collision_type, other, begin=_feel, separate=_feel_no_more, data=(bodies, index, number)
            )
        shapes.append(cone)
    space.add(in_space, *shapes)
    return in_space, shapes


def _feel(_arbiter: pymunk.Arbiter, _space: pymunk.Space, data: tuple[Any, int, int]) -> None:
    """A cone begins to overlap something."""
    bodies, index, number = data
    body = bodies[index]
    body.overlaps[number] += 1
    body.feel |= 1 << number


def _feel_no_more(_arbiter: pymunk.Arbiter, _space: pymunk.Space, data: tuple[Any, int, int]) -> None:
    """A cone ceases to overlap something."""
    bodies, index, number = data
    body = bodies[index]
    body.overlaps[number] -= 1
    if not body.overlaps[number]:
        body.feel &= ~(1 << number)
