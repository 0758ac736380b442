"""An arena: walls, obstacles and food, and the bodies of the robots among them, one control tick at a time."""

from collections.abc import Sequence

import pymunk

from host_sim.robot_io import Ranges
from host_sim.world.body import Body
from host_sim.world.body_faults import SOUND
from host_sim.world.food import Food
from host_sim.world.geometry import Capsule
from host_sim.world.layouts import Layout
from host_sim.world.obstacles import Obstacles
from host_sim.world.params import SimParams
from host_sim.world.ranges import ranges_of
from host_sim.world.shapes import DISC, OBSTACLE


class Arena:
    """One layout with its robots in it. Equal layouts and drives give equal senses, bit for bit.

    >>> from host_sim.world.layouts import generate
    >>> arena = Arena(generate(seed=1, number=1, params=SimParams()), SimParams())
    >>> arena.body.sense(tick=0).feel
    0

    Attributes:
        space: The pymunk space that they are in.
        bodies: The robots' bodies, in the order of the layout's starts.
        food: The food, shared by all robots.
        obstacles: Walls and bars, the bars by id: at first 0, 1, ... as in the layout. Call `settle` after a change.
    """

    def __init__(self, layout: Layout, params: SimParams, before: Sequence[Body] = ()) -> None:
        """Builds the space and runs the sensors once, so that the first `sense` is right.

        Args:
            layout: Obstacles, food and start poses; a robot is placed at each start.
            params: The dimensions of the world.
            before: For each robot that comes from another arena its body there, whose odometer and faults go on;
                empty for robots that have not moved yet.
        """
        self._starts, self._params = layout.starts, params
        self.space = pymunk.Space()
        self.food = Food(layout.food)
        self.obstacles = Obstacles(self.space, layout.bars, params)
        self.bodies = [
            Body(self.space, self.food, params, index, start, before[index].odometer if before else (0.0, 0.0))
            for index, start in enumerate(self._starts)
        ]
        for body, earlier in zip(self.bodies, before, strict=False):
            body.faults = earlier.faults
        self._by_disc = {body.disc: body for body in self.bodies}
        touching = {"begin": self._begin, "pre_solve": self._press, "separate": self._separate}
        self.space.on_collision(DISC, OBSTACLE, **touching)
        self.space.on_collision(DISC, DISC, **touching)
        self.settle()

    @property
    def body(self) -> Body:
        """The first robot's body, for runs with one robot."""
        return self.bodies[0]

    @property
    def layout(self) -> Layout:
        """The layout as it is now, with the original start poses."""
        return Layout(tuple(self.obstacles.bars.values()), tuple(self.food.at), self._starts[0], self._starts[1:])

    def ranges(self, index: int) -> Ranges:
        """What a robot's sensors measure where it stands: walls, bars and other robots."""
        body, radius_mm = self.bodies[index], self._params.body_radius_mm
        if body.lifted:
            return ranges_of(body.pose, (), self._params)
        others = [other.pose[:2] for other in self.bodies if other is not body and not other.lifted]
        discs = [Capsule(middle, middle, radius_mm) for middle in others]
        return ranges_of(body.pose, [*self.obstacles.capsules, *discs], self._params)

    def repair(self) -> None:
        """Makes all bodies sound."""
        for body in self.bodies:
            body.faults = SOUND

    def settle(self) -> None:
        """Updates the sensors after an obstacle or a body was moved."""
        for body in self.bodies:
            body.place()

    def _touched(self, arbiter: pymunk.Arbiter) -> list[Body]:
        return [self._by_disc[shape] for shape in arbiter.shapes if shape in self._by_disc]

    def _begin(self, arbiter: pymunk.Arbiter, _space: pymunk.Space, _data: None) -> None:
        for body in self._touched(arbiter):
            body.touches += 1
            body.collisions += 1

    def _separate(self, arbiter: pymunk.Arbiter, _space: pymunk.Space, _data: None) -> None:
        for body in self._touched(arbiter):
            body.touches -= 1

    def _press(self, arbiter: pymunk.Arbiter, _space: pymunk.Space, _data: None) -> None:
        """Passes the depth of an overlap to its bodies; the normal points from the first shape into the second."""
        contact = arbiter.contact_point_set
        depth_mm, normal = -contact.points[0].distance, contact.normal
        for body, way in zip(self._touched(arbiter), (1.0, -1.0), strict=False):
            body.press(depth_mm, (way * normal[0], way * normal[1]))
