"""An arena: walls, obstacles and food, and the bodies of the robots among them, one control tick at a time."""

from collections.abc import Sequence

import pymunk

from host_sim.world.body import Body
from host_sim.world.food import Food
from host_sim.world.geometry import Point
from host_sim.world.layouts import Layout
from host_sim.world.obstacles import Obstacles
from host_sim.world.params import SimParams
from host_sim.world.shapes import DISC, OBSTACLE


class Arena:
    """One layout with its robots in it. Equal layouts and drives give equal senses, bit for bit.

    >>> from host_sim.world.layouts import generate
    >>> arena = Arena(generate(seed=1, number=1, params=SimParams()), SimParams())
    >>> arena.body.sense(tick=0).feel
    0

    Attributes:
        bodies: The robots' bodies, in the order of the layout's starts.
        food: What there is to eat, shared by all.
        obstacles: The bars by their ids, at first 0, 1, ... as in the layout; `settle` after a change.
    """

    def __init__(self, layout: Layout, params: SimParams, odometers: Sequence[Point] = ()) -> None:
        """Builds the space and senses once, so that the first `sense` is right.

        Args:
            layout: Obstacles, food and starts: there is a robot at each start.
            params: The measures.
            odometers: For each robot the way of its left and its right wheel so far, mm, where it comes from another
                arena; none for robots that have not moved yet.
        """
        self._starts = layout.starts
        self._space = pymunk.Space()
        self.food = Food(layout.food)
        self.obstacles = Obstacles(self._space, layout.bars, params)
        self.bodies = [
            Body(self._space, self.food, params, index, start, odometers[index] if odometers else (0.0, 0.0))
            for index, start in enumerate(self._starts)
        ]
        self._by_disc = {body.disc: body for body in self.bodies}
        touching = {"begin": self._begin, "pre_solve": self._press, "separate": self._separate}
        self._space.on_collision(DISC, OBSTACLE, **touching)
        self._space.on_collision(DISC, DISC, **touching)
        self.settle()

    @property
    def body(self) -> Body:
        """The first robot's, for where there is one."""
        return self.bodies[0]

    @property
    def layout(self) -> Layout:
        """The layout as it is now, with its first starts."""
        return Layout(tuple(self.obstacles.bars.values()), tuple(self.food.at), self._starts[0], self._starts[1:])

    def settle(self) -> None:
        """Senses anew after a change of the obstacles or of where a body is."""
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
        """Tells the bodies how deep they overlap: the normal leads from the first shape into the second."""
        contact = arbiter.contact_point_set
        depth_mm, normal = -contact.points[0].distance, contact.normal
        for body, way in zip(self._touched(arbiter), (1.0, -1.0), strict=False):
            body.press(depth_mm, (way * normal[0], way * normal[1]))
