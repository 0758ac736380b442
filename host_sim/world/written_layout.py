"""A layout that is given rather than drawn: that of a world which a person wrote."""

import math
import random
from dataclasses import dataclass

from host_sim.world.clearance import clearance_mm
from host_sim.world.geometry import Bar, Point, Pose
from host_sim.world.layouts import Layout, between
from host_sim.world.params import SimParams
from host_sim.world.reach import Reach


@dataclass(frozen=True)
class WrittenLayout:
    """Draws always the same layout; only a start that is not given is drawn.

    Attributes:
        bars: The obstacles.
        food: Centers of the pieces of food, at least one.
        start: The first robot's start, x and y in mm and the heading in degrees; None to draw one each time.
    """

    bars: tuple[Bar, ...]
    food: tuple[Point, ...]
    start: tuple[float, float, float] | None = None

    def __call__(self, draws: random.Random, params: SimParams) -> Layout:
        """The layout, with which `find_fault` finds nothing wrong."""
        if self.start is None:
            return Layout(self.bars, self.food, self._draw_start(draws, params))
        x, y, heading_deg = self.start
        return Layout(self.bars, self.food, Pose(x, y, math.remainder(math.radians(heading_deg), math.tau)))

    def find_fault(self, params: SimParams) -> tuple[int, str] | None:
        """What makes the layout unfair, as `World.generate` describes it; None if nothing does.

        Returns:
            What is in a bad place, -1 for the start or the number of the food from 0, and what is wrong, in words.
        """
        places = [(-1, self.start[:2])] if self.start else []
        places += list(enumerate(self.food))
        for number, at in places:
            room_mm = clearance_mm(at, self.bars, params)
            if room_mm < _needed_mm(params):
                return number, f"{_name(number)} is {_away(room_mm)}; {_needed_mm(params):.0f} mm are needed"
        reach, first = Reach(self.bars, places[0][1], params), _name(places[0][0])
        for number, at in places:
            if at not in reach:
                return number, f"{_name(number)} cannot be reached from {first}: the robot does not fit through"
        return None

    def _draw_start(self, draws: random.Random, params: SimParams) -> Pose:
        """A place from which all food can be reached, with nothing in sensor reach: at least that of the food is."""
        import numpy as np  # noqa: PLC0415 - a run begins sooner without

        from host_sim.world.grid import clearances_mm  # noqa: PLC0415 - see above

        points = np.array([*Reach(self.bars, self.food[0], params).points(), *self.food])
        fair = points[clearances_mm(points, self.bars, params) >= _needed_mm(params)]
        x, y = fair[int(draws.random() * len(fair))]
        return Pose(float(x), float(y), between(draws, -math.pi, math.pi))


def _needed_mm(params: SimParams) -> float:
    return params.body_radius_mm + params.sensor_reach_mm


def _away(room_mm: float) -> str:
    return f"only {room_mm:.0f} mm away from an obstacle or a wall" if room_mm > 0 else "inside an obstacle"


def _name(number: int) -> str:
    return "the start" if number < 0 else f"food {number + 1}"
