"""An arena: walls, obstacles and food, and the bodies of the robots among them, one control tick at a time."""

from collections.abc import Sequence

from host_sim.robot_io import Ranges
from host_sim.world.body import Body
from host_sim.world.body_faults import SOUND
from host_sim.world.food import Food
from host_sim.world.layouts import Layout
from host_sim.world.native_world import NativeWorld
from host_sim.world.obstacles import Obstacles
from host_sim.world.params import SimParams
from host_sim.world.physics_names import FAST


class Arena:
    """One layout with its robots in it. Equal layouts and drives give equal senses, bit for bit.

    >>> from host_sim.world.layouts import generate
    >>> arena = Arena(generate(seed=1, number=1, params=SimParams()), SimParams())
    >>> arena.body.sense(tick=0).feel
    0

    Attributes:
        params: The dimensions of the world.
        inside: All of it in C, of which the others are views.
        bodies: The robots' bodies, in the order of the layout's starts.
        food: The food, shared by all robots.
        obstacles: Walls and bars, the bars by id: at first 0, 1, ... as in the layout.
    """

    def __init__(self, layout: Layout, params: SimParams, before: Sequence[Body] = (), physics: str = FAST) -> None:
        """Puts everything where it begins.

        Args:
            layout: Obstacles, food and start poses; a robot is placed at each start.
            params: The dimensions of the world.
            before: For each robot that comes from another arena its body there, whose odometer and faults go on;
                empty for robots that have not moved yet.
            physics: One of `PHYSICS`; both have the same results.
        """
        self._starts, self.params = layout.starts, params
        self.inside = NativeWorld(self._starts, layout.food, params, physics)
        self.food = Food(self.inside)
        self.bodies = [
            Body(self.inside, index, before[index].odometer if before else (0.0, 0.0))
            for index in range(len(self._starts))
        ]
        for body, earlier in zip(self.bodies, before, strict=False):
            body.faults = earlier.faults
        self.obstacles = Obstacles(self.inside, layout.bars, params)

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
        none = self.inside.library.RANGE_NONE
        return Ranges._make(None if range_mm == none else range_mm for range_mm in self.inside.measure(index))

    def repair(self) -> None:
        """Makes all bodies sound."""
        for body in self.bodies:
            body.faults = SOUND
