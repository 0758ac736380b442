"""The samples of a fleet for fleet.html: positions and memories of its robots, and the food left."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from host_sim.sim.native_fleet import NativeFleet
from host_sim.world.layouts import Layout
from host_sim.world.memory_kinds import sides_of

SAMPLE_TICKS = 50
"""Ticks from one sample to the next."""

_SAMPLES_MAX, _POSITIONS_MAX = 600, 600_000
_SIDE_BITS = 2


@dataclass
class FleetFilm:
    """Samples of a fleet for up to ten minutes; less for more than 1,000 robots.

    Attributes:
        poses: For each sample, an array of shape (robots, 3), as returned by `NativeFleet.positions`.
        sides: For each sample and robot, the turns that it knows: two bits per pattern, the lowest for pattern 0.
        eaten: For each sample and world, whether each piece of food was eaten.
        scenes: The environments: world, first sample, and layout.
    """

    poses: list[NDArray[np.int64]] = field(default_factory=list)
    sides: list[NDArray[np.int64]] = field(default_factory=list)
    eaten: list[list[tuple[bool, ...]]] = field(default_factory=list)
    scenes: list[tuple[int, int, Layout]] = field(default_factory=list)
    _codes: dict[bytes, int] = field(default_factory=dict)
    _meals: NDArray[np.uint32] | None = None

    def is_full(self, robots: int) -> bool:
        """Whether there are enough samples for this number of robots."""
        return len(self.poses) >= min(_SAMPLES_MAX, _POSITIONS_MAX // robots)

    def enter(self, world: int, layout: Layout, robots: int) -> None:
        """Begins another environment in a world."""
        if not self.is_full(robots):
            self.scenes.append((world, len(self.poses), layout))

    def add(self, fleet: NativeFleet) -> None:
        """Adds a sample."""
        self.poses.append(fleet.positions())
        self.sides.append(np.array([self._code(memory) for memory in fleet.memories()], np.int64))
        meals = fleet.meals()
        before, self._meals = self._meals, meals
        if before is None or fleet.worlds == 1:
            self.eaten.append([tuple(fleet.eaten(world)) for world in range(fleet.worlds)])
            return
        eaten = list(self.eaten[-1])
        for world in np.flatnonzero(before != meals).tolist():
            eaten[world] = tuple(fleet.eaten(world))
        self.eaten.append(eaten)

    def _code(self, memory: bytes) -> int:
        code = self._codes.get(memory)
        if code is None:
            code = sum(side << _SIDE_BITS * pattern for pattern, side in enumerate(sides_of(tuple(memory))))
            self._codes[memory] = code
        return code
