"""One layout of obstacles, food and robots for each seed and number."""

import math
import random
from collections.abc import Callable
from dataclasses import dataclass, replace

from host_sim.world.clearance import clearance_mm
from host_sim.world.geometry import Bar, Point, Pose
from host_sim.world.params import SimParams
from host_sim.world.reach import Reach

_TRIES = 1000


@dataclass(frozen=True)
class Layout:
    """The initial layout of an environment.

    Attributes:
        bars: The obstacles.
        food: Centers of the pieces of food.
        start: The first robot's start pose.
        other_starts: The other robots' start poses.
    """

    bars: tuple[Bar, ...]
    food: tuple[Point, ...]
    start: Pose
    other_starts: tuple[Pose, ...] = ()

    @property
    def starts(self) -> tuple[Pose, ...]:
        """Every robot's start pose."""
        return self.start, *self.other_starts


Draw = Callable[[random.Random, SimParams], Layout]
"""Draws a layout for one robot, fair or not."""


class NoRoomError(ValueError):
    """More robots than fit into an environment.

    Attributes:
        fitting: Number of robots that fit.
    """

    def __init__(self, number: int, fitting: int) -> None:
        """Describes the environment of that number."""
        super().__init__(f"there is room for {fitting} robots in environment {number}")
        self.fitting = fitting


def generate(seed: int, number: int, params: SimParams, robots: int = 1) -> Layout:
    """Draws the layout of the random world for a seed and a number: always the same, with every version of Python.

    >>> layout = generate(seed=1, number=1, params=SimParams())
    >>> len(layout.bars), len(layout.food), len(layout.starts)
    (6, 3, 1)

    The arguments and the errors are those of `World.generate`.
    """
    return World("random", params).generate(seed, number, robots)


def between(draws: random.Random, low: float, high: float) -> float:
    """A number from low to high, each as likely."""
    # random() is the only method of the generator that is guaranteed to stay the same across versions of Python.
    return low + (high - low) * draws.random()


def draw_start(draws: random.Random, params: SimParams) -> Pose:
    """A pose anywhere in the arena."""
    x, y = between(draws, 0.0, params.width_mm), between(draws, 0.0, params.height_mm)
    return Pose(x, y, between(draws, -math.pi, math.pi))


def draw_food(draws: random.Random, params: SimParams) -> tuple[Point, ...]:
    """A piece of food in each of its bands."""
    return tuple(
        (between(draws, low, high), between(draws, 0.0, params.height_mm)) for low, high in params.food_bands_mm
    )


def draw_bars(draws: random.Random, params: SimParams) -> Layout:
    """Bars of random length and angle, anywhere inside the walls."""
    bars = tuple(_draw_bar(draws, params) for _ in range(params.bar_count))
    return Layout(bars, draw_food(draws, params), draw_start(draws, params))


def _draw_bar(draws: random.Random, params: SimParams) -> Bar:
    half = (between(draws, *params.bar_length_mm) - params.bar_thickness_mm) / 2
    angle = between(draws, 0.0, math.pi)
    dx, dy = half * math.cos(angle), half * math.sin(angle)
    margin_x, margin_y = abs(dx) + params.bar_thickness_mm / 2, abs(dy) + params.bar_thickness_mm / 2
    x = between(draws, margin_x, params.width_mm - margin_x)
    y = between(draws, margin_y, params.height_mm - margin_y)
    return Bar((x - dx, y - dy), (x + dx, y + dy))


@dataclass(frozen=True)
class World:
    """A kind of environment.

    Attributes:
        name: Its name.
        params: Its dimensions.
        draw: Draws its layouts.
    """

    name: str
    params: SimParams
    draw: Draw = draw_bars

    def generate(self, seed: int, number: int, robots: int = 1) -> Layout:
        """Draws the layout for a seed and a number: always the same one.

        The layout is fair: nothing is within sensor reach of a start or of a piece of food, and every piece can be
        reached from each start. More robots do not change the rest of the layout.

        Args:
            seed: The run's seed, any integer.
            number: Number of the environment, any integer.
            robots: Number of robots, at least 1.

        Returns:
            The first fair layout drawn.

        Raises:
            ValueError: The world is so crowded that 1000 draws gave no fair layout.
            NoRoomError: There is no room for all the robots.
        """
        draws = random.Random(f"octet {seed} {number}")
        for _ in range(_TRIES):
            layout = self.draw(draws, self.params)
            if is_fair(layout, self.params):
                return layout if robots == 1 else self._with_robots(layout, seed, number, robots)
        raise ValueError(f"no fair environment in {_TRIES} draws for seed {seed}, number {number}: {self.params}")

    def _with_robots(self, layout: Layout, seed: int, number: int, robots: int) -> Layout:
        """The layout with a start for each robot; adding robots does not move the starts of the others."""
        draws, params = random.Random(f"octet {seed} {number} starts"), self.params
        reach_mm = params.body_radius_mm + params.sensor_reach_mm
        reach, starts = Reach(layout.bars, layout.start[:2], params), [layout.start]
        for _ in range(_TRIES):
            if len(starts) == robots:
                return replace(layout, other_starts=tuple(starts[1:]))
            start = draw_start(draws, params)
            clear_mm = clearance_mm(start[:2], layout.bars, params)
            apart_mm = min(math.dist(start[:2], other[:2]) for other in starts) - params.body_radius_mm
            if start[:2] in reach and min(clear_mm, apart_mm) >= reach_mm:
                starts.append(start)
        raise NoRoomError(number, len(starts))


def is_fair(layout: Layout, params: SimParams) -> bool:
    """Whether nothing is within sensor reach of the start or the food, and the body can get to all the food."""
    reach_mm = params.body_radius_mm + params.sensor_reach_mm
    if any(clearance_mm(place, layout.bars, params) < reach_mm for place in (layout.start[:2], *layout.food)):
        return False
    reach = Reach(layout.bars, layout.start[:2], params)
    return all(point in reach for point in layout.food)
