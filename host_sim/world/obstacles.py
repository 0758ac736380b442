"""The walls, bars and plants of an arena in a pymunk space. Bars and plants can be added, moved and removed."""

import pymunk

from host_sim.world.geometry import Bar, Capsule, Plant, Point
from host_sim.world.params import SimParams
from host_sim.world.shapes import OBSTACLE, OBSTACLE_FILTER

_WALL_MM = 100.0


class Obstacles:
    """The obstacles of an arena.

    Attributes:
        bars: The bars by id: 0, 1, ... in the order in which they were added. Ids are never reused.
        plants: The plants by id, likewise.
        walls: The four walls; their inside faces are the arena's edge.
    """

    def __init__(self, space: pymunk.Space, bars: tuple[Bar, ...], params: SimParams) -> None:
        """Adds bars and walls to a space."""
        self.bars: dict[int, Bar] = {}
        self._space, self._radius_mm = space, params.bar_thickness_mm / 2
        self._shapes: dict[int, pymunk.Segment] = {}
        self._next_id = 0
        self.plants: dict[int, Plant] = {}
        self._plant_shapes: dict[int, pymunk.Circle] = {}
        self._next_plant_id = 0
        for bar in bars:
            self.add(bar)
        self.walls = _walls(params)
        for wall in self.walls:
            self._add_segment(wall.a, wall.b, wall.radius_mm)

    @property
    def capsules(self) -> list[Capsule]:
        """All of them: walls, bars and plants."""
        bars = (Capsule(bar.a, bar.b, self._radius_mm) for bar in self.bars.values())
        return [*self.walls, *bars, *(Capsule(at, at, radius_mm) for at, radius_mm in self.plants.values())]

    def add(self, bar: Bar) -> None:
        """Adds a bar; it gets the next id."""
        self._put(self._next_id, bar)
        self._next_id += 1

    def move(self, bar_id: int, bar: Bar) -> None:
        """Moves a bar.

        Raises:
            KeyError: There is no bar with this id.
        """
        self._space.remove(self._shapes[bar_id])
        self._put(bar_id, bar)

    def remove(self, bar_id: int) -> None:
        """Removes a bar.

        Raises:
            KeyError: There is no bar with this id.
        """
        self._space.remove(self._shapes.pop(bar_id))
        del self.bars[bar_id]

    def plant(self, plant: Plant) -> None:
        """Adds a plant; it gets the next id."""
        self._put_plant(self._next_plant_id, plant)
        self._next_plant_id += 1

    def change_plant(self, plant_id: int, plant: Plant) -> None:
        """Moves a plant or lets it grow.

        Raises:
            KeyError: There is no plant with this id.
        """
        self._space.remove(self._plant_shapes[plant_id])
        self._put_plant(plant_id, plant)

    def remove_plant(self, plant_id: int) -> None:
        """Removes a plant.

        Raises:
            KeyError: There is no plant with this id.
        """
        self._space.remove(self._plant_shapes.pop(plant_id))
        del self.plants[plant_id]

    def _put_plant(self, plant_id: int, plant: Plant) -> None:
        self.plants[plant_id] = plant
        shape = pymunk.Circle(self._space.static_body, plant.radius_mm, plant.at)
        self._plant_shapes[plant_id] = shape
        self._add(shape)

    def _put(self, bar_id: int, bar: Bar) -> None:
        self.bars[bar_id] = bar
        self._shapes[bar_id] = self._add_segment(bar.a, bar.b, self._radius_mm)

    def _add_segment(self, a: Point, b: Point, radius_mm: float) -> pymunk.Segment:
        shape = pymunk.Segment(self._space.static_body, a, b, radius_mm)
        self._add(shape)
        return shape

    def _add(self, shape: pymunk.Shape) -> None:
        shape.collision_type = OBSTACLE
        shape.filter = OBSTACLE_FILTER
        self._space.add(shape)


def _walls(params: SimParams) -> list[Capsule]:
    # Their centre lines lie outside by their radius.
    left, top = -_WALL_MM, -_WALL_MM
    right, bottom = params.width_mm + _WALL_MM, params.height_mm + _WALL_MM
    corners = [(left, top), (right, top), (right, bottom), (left, bottom)]
    return [Capsule(a, b, _WALL_MM) for a, b in zip(corners, corners[1:] + corners[:1], strict=True)]
