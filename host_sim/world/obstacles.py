"""The bars and plants of an arena."""

from typing import Any

from host_sim.world.geometry import Bar, Plant


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
