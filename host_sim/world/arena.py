"""An arena: walls, obstacles and food, and the bodies of the robots among them, one control tick at a time."""

from collections.abc import Sequence
from typing import Any

from host_sim.protocol.generated import Ranges
from host_sim.world.body import Body
from host_sim.world.body_kinds import BodyKind, draw_body
from host_sim.world.edits import Edit, EditError, edit_in_c
from host_sim.world.geometry import Bar, Plant, Point, SimParams
from host_sim.world.layouts import Layout
from host_sim.world.names import FAST
from host_sim.world.native_world import NativeWorld


class Obstacles:
    """The obstacles of an arena: a view of a `struct furniture`."""

    def __init__(self, furniture: Any) -> None:
        """Shows the obstacles."""
        self._in_c = furniture

    @property
    def bars(self) -> dict[int, Bar]:
        """The bars by id: 0, 1, ... in the order in which they were added. Ids are never reused."""
        there = self._in_c
        bars = (Bar((bar.a.x, bar.a.y), (bar.b.x, bar.b.y)) for bar in there.bars[0 : there.bar_count])
        return dict(zip(there.bar_ids, bars, strict=False))

    @property
    def plants(self) -> dict[int, Plant]:
        """The plants by id, likewise."""
        there = self._in_c
        plants = (Plant((plant.at.x, plant.at.y), plant.radius_mm) for plant in there.plants[0 : there.plant_count])
        return dict(zip(there.plant_ids, plants, strict=False))


class Food:
    """Pieces of food by id: 0, 1, ... as in the layout; a view of those in C."""

    def __init__(self, inside: NativeWorld) -> None:
        """Creates a view of the food of a world."""
        self._inside, self._pieces = inside, inside.food

    @property
    def at(self) -> list[Point]:
        """Position of each piece, eaten or not."""
        return [(piece.x_mm, piece.y_mm) for piece in self._pieces]

    @property
    def eaten(self) -> list[bool]:
        """For each piece, whether it has been eaten."""
        return [piece.eaten for piece in self._pieces]

    @property
    def uneaten(self) -> dict[int, Point]:
        """Positions of the pieces that are left, by id."""
        return {food_id: (piece.x_mm, piece.y_mm) for food_id, piece in enumerate(self._pieces) if not piece.eaten}

    @property
    def left(self) -> int:
        """Number of pieces that are left."""
        return int(self._inside.library.world_food_left(self._inside.world))


class Arena:
    """One layout with its robots in it. Equal layouts and drives give equal senses, bit for bit.

    >>> from host_sim.world.layouts import generate
    >>> arena = Arena(generate(seed=1, number=1, params=SimParams()), SimParams())
    >>> arena.body.sense(tick=0).feel
    0

    Attributes:
        params: The dimensions of the world.
        inside: The arena in C, of which the other attributes are views.
        bodies: The robots' bodies, in the order of the layout's starts.
        food: The food, shared by all robots.
        obstacles: The obstacles; the bars' ids are at first 0, 1, ... as in the layout.
    """

    def __init__(
        self,
        layout: Layout,
        params: SimParams,
        before: Sequence[Body] = (),
        physics: str = FAST,
        kind: BodyKind | None = None,
    ) -> None:
        """Puts everything in its initial place.

        Args:
            layout: Obstacles, food and start poses; a robot is placed at each start.
            params: The dimensions of the world.
            before: For each robot that comes from another arena, its body there, whose odometer and faults are
                kept; empty for robots that have not moved yet.
            physics: One of `PHYSICS`; both have the same results.
            kind: Properties of the bodies; None: ideal. Bodies not from another arena are ideal until `draw`.
        """
        self._starts, self.params = layout.starts, params
        self._kind = kind
        self.inside = NativeWorld(layout, params, physics, kind)
        self.food = Food(self.inside)
        self.bodies = [
            Body(self.inside, index, before[index] if before else None) for index in range(len(self._starts))
        ]
        self.obstacles = Obstacles(self.inside.furniture)

    @property
    def body(self) -> Body:
        """The first robot's body, for runs with one robot."""
        return self.bodies[0]

    @property
    def layout(self) -> Layout:
        """The layout as it is now, with the original start poses."""
        return Layout(tuple(self.obstacles.bars.values()), tuple(self.food.at), self._starts[0], self._starts[1:])

    def ranges(self, index: int, tick: int = 0) -> Ranges:
        """The distances that a robot is told in that tick: to walls, bars and other robots."""
        none = self.inside.library.RANGE_NONE
        return Ranges._make(None if range_mm == none else range_mm for range_mm in self.inside.measure(index, tick))

    def edit(self, edit: Edit) -> None:
        """Makes one edit, between two ticks; bodies feel it at once. Equal edits at equal ticks give equal runs.

        Raises:
            EditError: The edit cannot be made; nothing was changed.
        """
        inside = self.inside
        if why := inside.library.edit_make(inside.furniture, inside.world, edit_in_c(edit)):
            raise EditError(inside.ffi.string(why).decode())
        inside.lay_out()
        for body, in_c in zip(self.bodies, inside.bodies, strict=True):
            body.lifted = bool(in_c.lifted)

    def begin(self, seed: int) -> None:
        """Removes all faults, and draws each body's own traits from a seed."""
        for index, body in enumerate(self.bodies):
            body.add_fault("repair")
            body.become(draw_body(self._kind, seed, index))
