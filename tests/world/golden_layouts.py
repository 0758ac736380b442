"""What layouts were drawn when this was written; they stay the same for ever.

`layouts.json` has a digest for each world: of its numbers to the last bit, which are the same on every machine.
"""

import hashlib
import json
import math
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from host_sim.world.geometry import Bar, Plant, SimParams
from host_sim.world.layouts import Layout, World
from host_sim.world.names import WORLD_NAMES
from host_sim.world.worlds import world_from, world_of

DIGESTS: dict[str, str] = json.loads(Path(__file__).with_name("layouts.json").read_text())

WRITTEN = {
    "start drawn": {
        "size": [3000, 2000],
        "food": [[2700, 300], [1500, 1000.5]],
        "bars": [[1000, 0, 1000, 1400], [2000, 600, 2000, 2000]],
    },
    "start given": {"start": [300, 300, -1270.5], "food": [[3500, 2500]], "bars": []},
}


class Which(NamedTuple):
    """Which layout of a world."""

    seed: int
    number: int
    robots: int


WANTED = [Which(seed * 21_474_836, 1 + seed % 3, 1 + seed % 4) for seed in range(100)]


def world(name: str) -> World:
    """One of those in `DIGESTS`."""
    return world_of(name) if name in WORLD_NAMES else world_from(WRITTEN[name], name)


def numbers(layout: Layout) -> list[float]:
    """All numbers of a layout."""
    bars = [x for bar in layout.bars for end in bar for x in end]
    return [*bars, *(x for at in layout.food for x in at), *(x for start in layout.starts for x in start)]


def digest(layouts: Iterable[list[float]]) -> str:
    """The digest of the numbers of layouts."""
    text = "\n".join(" ".join((number + 0.0).hex() for number in layout) for layout in layouts)
    return hashlib.sha256(text.encode()).hexdigest()


CELL_MM = 25.0


def clearances_mm(
    points: NDArray[np.float64], bars: tuple[Bar, ...], params: SimParams, plants: tuple[Plant, ...] = ()
) -> NDArray[np.float64]:
    """For each of many points, shape (n, 2), the distance to the nearest obstacle or wall, mm."""
    x, y = points[:, 0], points[:, 1]
    nearest = np.minimum(np.minimum(x, params.width_mm - x), np.minimum(y, params.height_mm - y))
    for bar in bars:
        nearest = np.minimum(nearest, _distance_mm(x, y, bar) - params.bar_thickness_mm / 2)
    for (at_x, at_y), radius_mm in plants:
        nearest = np.minimum(nearest, length(x - at_x, y - at_y) - radius_mm)
    return nearest


def _distance_mm(x: NDArray[np.float64], y: NDArray[np.float64], bar: Bar) -> NDArray[np.float64]:
    (ax, ay), (bx, by) = bar
    dx, dy = bx - ax, by - ay
    along = np.clip(((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy), 0.0, 1.0)
    return length(x - ax - along * dx, y - ay - along * dy)


def length(dx: NDArray[np.float64], dy: NDArray[np.float64]) -> NDArray[np.float64]:
    """The lengths of ways, to the last bit as IEEE 754 has them; numpy's hypot is that of the C library."""
    return np.asarray(np.sqrt(dx * dx + dy * dy))


def middles(params: SimParams) -> NDArray[np.float64]:
    """The middles of the cells of an arena: shape (rows, columns, 2), mm."""
    rows, columns = math.ceil(params.height_mm / CELL_MM), math.ceil(params.width_mm / CELL_MM)
    y, x = (np.indices((rows, columns)) + 0.5) * CELL_MM
    return np.stack([x, y], axis=-1)


def free_cells(bars: tuple[Bar, ...], params: SimParams, plants: tuple[Plant, ...] = ()) -> NDArray[np.bool_]:
    """The cells in which the centre of the body may be anywhere."""
    at = middles(params)
    room_mm = clearances_mm(at.reshape(-1, 2), bars, params, plants).reshape(at.shape[:2])
    return room_mm >= params.body_radius_mm + CELL_MM * math.sqrt(0.5)


def flooded(free: NDArray[np.bool_], row: int, column: int) -> NDArray[np.bool_]:
    """The free cells that can be got to from one of the cells."""
    reached, frontier = np.zeros_like(free), [(row, column)]
    while frontier:
        row, column = frontier.pop()
        inside = 0 <= row < free.shape[0] and 0 <= column < free.shape[1]
        if inside and free[row, column] and not reached[row, column]:
            reached[row, column] = True
            frontier += ((row - 1, column), (row + 1, column), (row, column - 1), (row, column + 1))
    return reached


PITCH_MM = 20.0


def can_reach(layout: Layout, goal: tuple[float, float], params: SimParams) -> bool:
    """Whether steps from place to place, where the body fits, lead from the start to a goal."""
    y, x = np.mgrid[0 : params.height_mm : PITCH_MM, 0 : params.width_mm : PITCH_MM]
    places = np.column_stack([x.ravel(), y.ravel()])
    free = (clearances_mm(places, layout.bars, params) >= params.body_radius_mm).reshape(x.shape)
    reached = np.zeros_like(free)
    reached[round(layout.start.y_mm / PITCH_MM), round(layout.start.x_mm / PITCH_MM)] = True
    while True:
        grown = reached.copy()
        grown[1:] |= reached[:-1]
        grown[:-1] |= reached[1:]
        grown[:, 1:] |= reached[:, :-1]
        grown[:, :-1] |= reached[:, 1:]
        grown &= free
        if (grown == reached).all():
            return bool(reached[round(goal[1] / PITCH_MM), round(goal[0] / PITCH_MM)])
        reached = grown


def is_fair(layout: Layout, params: SimParams) -> bool:
    """Whether nothing is within sensor reach of the start or the food, and the body can get to all the food."""
    places = np.array([layout.start[:2], *layout.food])
    room_mm = clearances_mm(places, layout.bars, params).min()
    is_clear = room_mm >= params.body_radius_mm + params.sensor_reach_mm
    return bool(is_clear) and all(can_reach(layout, food, params) for food in layout.food)
