"""Converts a change to edits of an arena."""

import math
import random
from collections.abc import Sequence

from host_sim.protocol.generated import PLANT_GROWTH_MM, PLANT_RADIUS_MM
from host_sim.world.arena import Arena
from host_sim.world.changes import GROW, PLANT, Change
from host_sim.world.edits import Edit, EditError
from host_sim.world.geometry import Plant, Point, SimParams
from host_sim.world.reach import Reach, clearance_mm

_TRIES = 200
_BESIDE_MM = 75.0
"""Maximum distance from a body beside a wall to a cell of the grid that it can be in."""


def edits_of(change: Change, arena: Arena, params: SimParams, seed: int) -> list[Edit]:
    """The edits that make a change happen to an arena as it is now; equal arenas and seeds give equal edits.

    Raises:
        EditError: It cannot happen.
    """
    if change.name == PLANT:
        numbers = change.numbers
        at = (float(numbers[0]), float(numbers[1])) if numbers else _place(arena, params, seed)
        return [Edit("plant", at=at, radius=float(PLANT_RADIUS_MM))]
    if change.name == GROW:
        return _growth(arena, change.numbers)
    robots = range(len(arena.bodies)) if change.robot is None else [change.robot - 1]
    return [Edit("body", what=change.what, robot=robot, seed=seed) for robot in robots]


def _growth(arena: Arena, numbers: Sequence[int]) -> list[Edit]:
    if not arena.obstacles.plants:
        raise EditError("there is no plant in this environment")
    growth_mm = numbers[0] if numbers else PLANT_GROWTH_MM
    return [
        Edit("grow_plant", plant_id, radius=plant.radius_mm + growth_mm)
        for plant_id, plant in arena.obstacles.plants.items()
    ]


def _place(arena: Arena, params: SimParams, seed: int) -> Point:
    """A place for a plant, out of sensor reach of robots and food, from which all food can still be reached."""
    draws = random.Random(f"octet {seed} plant {len(arena.obstacles.plants)}")
    for _ in range(_TRIES):
        at = float(int(draws.random() * params.width_mm)), float(int(draws.random() * params.height_mm))
        if _is_fair(Plant(at, PLANT_RADIUS_MM), arena, params):
            return at
    raise EditError("there is no room for a plant that leaves a way to all food")


def _is_fair(plant: Plant, arena: Arena, params: SimParams) -> bool:
    robots = [body.pose[:2] for body in arena.bodies if not body.lifted]
    food = list(arena.food.uneaten.values())
    needed_mm = plant.radius_mm + params.body_radius_mm + params.sensor_reach_mm
    if min((math.dist(plant.at, place) for place in (*robots, *food)), default=math.inf) < needed_mm:
        return False
    bars, plants = tuple(arena.obstacles.bars.values()), (*arena.obstacles.plants.values(), plant)
    if clearance_mm(plant.at, bars, params) < plant.radius_mm or not food:
        return False
    reach = Reach(bars, food[0], params, plants)
    return all(at in reach for at in food) and all(reach.distance_mm(robot) <= _BESIDE_MM for robot in robots)
