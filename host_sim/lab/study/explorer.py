"""The cost of searching for a robot that has a map, but without the food: the explorer of docs/learning.md.

It knows its place, all obstacles and how food is drawn, remembers all that it has seen, and drives the shortest ways
without time for turning, at the speed of the firmware's robots. It goes where it expects to see food soonest: to the
place with the highest chance per second of driving and looking. It is not optimal, but knows far more than eight
bytes hold.

.venv/bin/python -m host_sim.lab.study.explorer              60 seeds of five environments
.venv/bin/python -m host_sim.lab.study.explorer --seeds 5    fewer
"""

import argparse
import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from host_sim.lab.study.figures import FIGURES, compare, estimate
from host_sim.lab.study.fleets import sample_of
from host_sim.lab.study.sample import Floats, Sample
from host_sim.lab.study.table import interval_of, text_of
from host_sim.lab.table import markdown
from host_sim.protocol.words import PARAMETERS
from host_sim.sim.run_config import RunConfig
from host_sim.world.geometry import Bar, Point, Pose, SimParams
from host_sim.world.layouts import Layout
from host_sim.world.reach import clearance_mm, tour_mm
from host_sim.world.worlds import world_of

FIRST_SEED, SEEDS, ENVIRONMENTS = 4_700_001, 60, 5

_SPEED_MM_S, _TURN_DEG_S = PARAMETERS["speed_mm_s"].default, PARAMETERS["turn_speed_deg_s"].default
_APART_MM, _CELL_MM = 250, 100
_WORLD = "random"


def sees(eyes: Floats, points: Floats, bars: Sequence[Bar], radius_mm: float) -> NDArray[np.bool_]:
    """Which points are visible from which eyes, all of which are farther from each bar than its radius.

    Args:
        eyes: Shape (eyes, 2).
        points: Shape (points, 2).
        bars: The bars.
        radius_mm: Half of their thickness.

    Returns:
        Shape (eyes, points).
    """
    ways = points - eyes[:, np.newaxis]
    squares = np.maximum((ways * ways).sum(-1), 1.0)
    seen = np.ones(squares.shape, np.bool_)
    for bar in bars:
        a, b = ((it - eyes)[:, np.newaxis] for it in (bar.a, bar.b))
        for end in (a, b):
            along = np.clip((ways * end).sum(-1) / squares, 0, 1)
            aside = end - along[..., np.newaxis] * ways
            seen &= (aside * aside).sum(-1) > radius_mm**2
        across = _cross(ways, a) * _cross(ways, b) < 0
        seen &= ~(across & (_cross(b - a, -a) * _cross(b - a, ways - a) < 0))
    return seen


def _cross(a: Floats, b: Floats) -> Floats:
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])


class Room:
    """An environment as an explorer knows it.

    Attributes:
        layout: The whole layout, including the food, which the explorer does not know.
        params: Its dimensions.
        places: Where it may look around: shape (places, 2).
        cells: Where food may be: shape (cells, 2).
        bands: Which cells are in which band: shape (bands, cells). Each band has one piece of food.
        shown: Which cells it sees from which places: shape (places, cells).
    """

    def __init__(self, layout: Layout, params: SimParams) -> None:
        """Finds the places and the cells."""
        self.layout, self.params = layout, params
        self.places = self._grid(_APART_MM, params.body_radius_mm)
        self.cells = self._grid(_CELL_MM, params.body_radius_mm + params.sensor_reach_mm)
        x_mm = self.cells[:, 0]
        self.bands = np.array([(low <= x_mm) & (x_mm <= high) for low, high in params.food_bands_mm])
        self.shown = self.seen(self.places, self.cells)

    def _grid(self, apart_mm: int, clear_mm: float) -> Floats:
        """The points of a grid, `apart_mm` apart, that are at least `clear_mm` from all obstacles."""
        bars, params = self.layout.bars, self.params
        lines = (np.arange(apart_mm / 2, size, apart_mm) for size in (params.width_mm, params.height_mm))
        places = np.stack(np.meshgrid(*lines), -1).reshape(-1, 2)
        kept = [clearance_mm((x, y), bars, params) >= clear_mm for x, y in places.tolist()]
        return np.asarray(places[kept])

    def seen(self, eyes: Floats, points: Floats) -> NDArray[np.bool_]:
        """Which points are seen from which eyes."""
        return sees(eyes, points, self.layout.bars, self.params.bar_thickness_mm / 2)


class Explorer:
    """An explorer in an environment."""

    def __init__(self, room: Room, *, turns: bool) -> None:
        """Puts it at the start.

        Args:
            room: The environment.
            turns: Whether it must turn to look around until it sees food; otherwise it sees all around at once.
        """
        self._room, self._turns, layout = room, turns, room.layout
        self._at, self._heading_rad = layout.start[:2], layout.start.heading_rad
        self._left = [*layout.food]
        self._unseen = room.bands.copy()

    def finish_s(self) -> float:
        """Eats all food, and returns how long that takes, s."""
        taken_s = 0.0
        while self._left:
            taken_s += self._look_around_s()
        return taken_s

    def _look_around_s(self) -> float:
        """Looks around, and drives to the food seen first, or else to another place. Returns the time taken, s."""
        room, here = self._room, np.array([self._at])
        self._unseen &= ~room.seen(here, room.cells)
        seen = room.seen(here, np.array(self._left))[0]
        found = [food for food, is_seen in zip(self._left, seen, strict=True) if is_seen]
        if found:
            target = min(found, key=self._turn_deg if self._turns else self._way_s)
            return self._looking_s(self._turn_deg(target)) + self._eat_s(target)
        place = self._best_place()
        if place is None:  # the food left is visible from no place of the grid: its position is given
            return self._eat_s(min(self._left, key=self._way_s))
        return self._looking_s(360) + self._go_s(place)

    def _looking_s(self, turned_deg: float) -> float:
        return turned_deg / _TURN_DEG_S if self._turns else 0.0

    def _turn_deg(self, target: Point) -> float:
        """How far it turns to the right to see a place, degrees."""
        x, y = np.subtract(target, self._at)
        return math.degrees(math.atan2(y, x) - self._heading_rad) % 360

    def _way_s(self, target: Point) -> float:
        layout = Layout(self._room.layout.bars, (target,), Pose(*self._at, 0.0))
        return tour_mm(layout, self._room.params) / _SPEED_MM_S

    def _go_s(self, target: Point) -> float:
        taken_s, way = self._way_s(target), np.subtract(target, self._at)
        self._at, self._heading_rad = target, math.atan2(way[1], way[0])
        return taken_s

    def _eat_s(self, food: Point) -> float:
        self._unseen[self._room.layout.food.index(food)] = False  # there is one for each band
        self._left.remove(food)
        return max(0.0, self._go_s(food) - self._room.params.eat_reach_mm / _SPEED_MM_S)

    def _best_place(self) -> Point | None:
        """The place with the highest chance per second to see food; bounds spare the exact ways to most places."""
        places, unseen = self._room.places, self._unseen
        chances = self._room.shown @ (unseen / np.maximum(1, unseen.sum(-1, keepdims=True))).sum(0)
        straight_s = np.hypot(*(places - self._at).T) / _SPEED_MM_S + self._looking_s(360)
        at_most = chances / np.maximum(straight_s, 1e-3)
        best, found = 0.0, None
        for i in np.argsort(-at_most):
            if at_most[i] <= best:
                break
            place = (float(places[i, 0]), float(places[i, 1]))
            if (rate := chances[i] / max(1e-3, self._way_s(place) + self._looking_s(360))) > best:
                best, found = rate, place
        return found


def _times(seed: int, number: int) -> list[float]:
    """Times of the explorer that turns to look, of the one that does not, and of the shortest tour, s."""
    world = world_of(_WORLD)
    layout = world.generate(seed, number)
    room = Room(layout, world.params)
    explored = [Explorer(room, turns=turns).finish_s() for turns in (True, False)]
    return [*explored, tour_mm(layout, world.params) / _SPEED_MM_S]


def samples_of(seeds: int) -> list[Sample]:
    """The firmware's robots, the explorers, and the shortest tour, in the same environments."""
    config = RunConfig(environments=ENVIRONMENTS, world=_WORLD)
    article, searcher = (
        sample_of(f"`{name}`", replace(config, profile=name), FIRST_SEED, seeds) for name in ("article", "searcher")
    )
    times = [[_times(int(seed), 1 + i) for i in range(ENVIRONMENTS)] for seed in article.seeds]
    names = ("explorer that turns to look", "explorer that sees all around", "shortest tour")
    others = zip(names, np.moveaxis(np.array(times), -1, 0), strict=True)
    return [article, searcher, *(replace(article, name=name, robot_s=robot_s) for name, robot_s in others)]


def table_of(samples: Sequence[Sample]) -> str:
    """The table in Markdown, each by the first sample."""
    mean, rows = FIGURES["mean_s"], [("who", "mean", "by `article`")]
    for it in samples:
        value, part = estimate(mean, it), compare(mean, it, samples[0])
        seconds = f"{text_of(mean, value.value)} ({interval_of(mean, value.low, value.high).removesuffix(' s')})"
        rows.append((it.name, seconds, f"{part.value:.2f} ({part.low:.2f}..{part.high:.2f})"))
    return markdown(rows)


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, default=SEEDS, metavar="N", help="number of seeds")
    seeds = parser.parse_args().seeds
    print(f"seeds {FIRST_SEED}..{FIRST_SEED + seeds - 1}, {ENVIRONMENTS} environments each\n")
    print(table_of(samples_of(seeds)))


if __name__ == "__main__":
    main()
