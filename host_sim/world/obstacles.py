"""The walls, bars and plants of an arena. Bars and plants can be added, moved and removed."""

from host_sim.world.geometry import Bar, Capsule, Plant
from host_sim.world.native_world import NativeWorld
from host_sim.world.params import SimParams

_WALL_MM = 100.0


class Obstacles:
    """The obstacles of an arena; bodies feel a change at once.

    Attributes:
        bars: The bars by id: 0, 1, ... in the order in which they were added. Ids are never reused.
        plants: The plants by id, likewise.
        walls: The four walls; their inside faces are the arena's edge.
    """

    def __init__(self, inside: NativeWorld, bars: tuple[Bar, ...], params: SimParams) -> None:
        """Puts bars and walls into a world, whose bodies are where they start."""
        self._inside, self._radius_mm = inside, params.bar_thickness_mm / 2
        self.bars, self._next_id = dict(enumerate(bars)), len(bars)
        self.plants: dict[int, Plant] = {}
        self._next_plant_id = 0
        self.walls = walls_of(params)
        self._lay_out()

    @property
    def capsules(self) -> list[Capsule]:
        """All of them: walls, bars and plants."""
        bars = (Capsule(bar.a, bar.b, self._radius_mm) for bar in self.bars.values())
        return [*self.walls, *bars, *(Capsule(at, at, radius_mm) for at, radius_mm in self.plants.values())]

    def add(self, bar: Bar) -> None:
        """Adds a bar; it gets the next id."""
        self.move(self._next_id, bar)
        self._next_id += 1

    def move(self, bar_id: int, bar: Bar) -> None:
        """Moves a bar."""
        self.bars[bar_id] = bar
        self._lay_out()

    def remove(self, bar_id: int) -> None:
        """Removes a bar.

        Raises:
            KeyError: There is no bar with this id.
        """
        del self.bars[bar_id]
        self._lay_out()

    def plant(self, plant: Plant) -> None:
        """Adds a plant; it gets the next id."""
        self.change_plant(self._next_plant_id, plant)
        self._next_plant_id += 1

    def change_plant(self, plant_id: int, plant: Plant) -> None:
        """Moves a plant or lets it grow."""
        self.plants[plant_id] = plant
        self._lay_out()

    def remove_plant(self, plant_id: int) -> None:
        """Removes a plant.

        Raises:
            KeyError: There is no plant with this id.
        """
        del self.plants[plant_id]
        self._lay_out()

    def _lay_out(self) -> None:
        self._inside.lay_out(self.capsules)


def walls_of(params: SimParams) -> list[Capsule]:
    """The four walls of an arena."""
    # Their centre lines lie outside by their radius.
    left, top = -_WALL_MM, -_WALL_MM
    right, bottom = params.width_mm + _WALL_MM, params.height_mm + _WALL_MM
    corners = [(left, top), (right, top), (right, bottom), (left, bottom)]
    return [Capsule(a, b, _WALL_MM) for a, b in zip(corners, corners[1:] + corners[:1], strict=True)]
