"""Changes of the world while robots are in it, by a person or a schedule."""

import math
from collections.abc import Callable, Collection
from dataclasses import dataclass
from typing import Any

from host_sim.world.arena import Arena
from host_sim.world.body import Body
from host_sim.world.clearance import clearance_mm
from host_sim.world.geometry import Bar, Plant, Point, Pose
from host_sim.world.params import SimParams
from host_sim.world.written_world import BARS_MAX

PLANTS_MAX = 20
"""Maximum number of plants in an arena."""

PLANT_MIN_MM, PLANT_MAX_MM = 20, 500
"""Radius of the smallest and of the largest plant."""


@dataclass(frozen=True)
class AddBar:
    """Adds an obstacle, which gets the next id."""

    bar: Bar


@dataclass(frozen=True)
class MoveBar:
    """Moves an obstacle."""

    id: int
    bar: Bar


@dataclass(frozen=True)
class RemoveBar:
    """Removes an obstacle."""

    id: int


@dataclass(frozen=True)
class MoveFood:
    """Moves a piece of food, eaten or not."""

    id: int
    at: Point


@dataclass(frozen=True)
class Lift:
    """Lifts a robot, counted from 0: its wheels still turn, but it does not move or sense anything."""

    robot: int = 0


@dataclass(frozen=True)
class Put:
    """Puts a lifted robot, counted from 0, down."""

    pose: Pose
    robot: int = 0


@dataclass(frozen=True)
class AddPlant:
    """Puts a plant down, which gets the next id of the plants."""

    plant: Plant


@dataclass(frozen=True)
class MovePlant:
    """Moves a plant."""

    id: int
    at: Point


@dataclass(frozen=True)
class GrowPlant:
    """Gives a plant another radius."""

    id: int
    radius_mm: float


@dataclass(frozen=True)
class RemovePlant:
    """Removes a plant."""

    id: int


@dataclass(frozen=True)
class ChangeBody:
    """Breaks something in the body of a robot, counted from 0, or repairs it.

    `what` is as in `check_fault`; when noise strikes follows from the seed.
    """

    what: str
    robot: int = 0
    seed: int = 0


Edit = (
    AddBar | MoveBar | RemoveBar | MoveFood | Lift | Put | AddPlant | MovePlant | GrowPlant | RemovePlant | ChangeBody
)


class EditError(ValueError):
    """An edit that cannot be made in the world as it is; the message says why."""


def make_edit(arena: Arena, edit: Edit, params: SimParams) -> None:
    """Makes one edit, between two ticks. Equal edits at equal ticks give equal runs.

    Raises:
        EditError: The edit cannot be made; nothing was changed.
    """
    _MAKERS[type(edit)](arena, edit, params)


def _add_bar(arena: Arena, edit: AddBar, params: SimParams) -> None:
    if len(arena.obstacles.bars) >= BARS_MAX:
        raise EditError(f"there are {BARS_MAX} obstacles already")
    _check_bar(arena, edit.bar, params)
    arena.obstacles.add(edit.bar)


def _move_bar(arena: Arena, edit: MoveBar, params: SimParams) -> None:
    _check_known(edit.id, arena.obstacles.bars)
    _check_bar(arena, edit.bar, params)
    arena.obstacles.move(edit.id, edit.bar)


def _remove_bar(arena: Arena, edit: RemoveBar, _params: SimParams) -> None:
    _check_known(edit.id, arena.obstacles.bars)
    arena.obstacles.remove(edit.id)


def _move_food(arena: Arena, edit: MoveFood, params: SimParams) -> None:
    _check_known(edit.id, range(len(arena.food.at)))
    _check_inside(edit.at, params)
    arena.food.move(edit.id, edit.at)


def _add_plant(arena: Arena, edit: AddPlant, params: SimParams) -> None:
    if len(arena.obstacles.plants) >= PLANTS_MAX:
        raise EditError(f"there are {PLANTS_MAX} plants already")
    _check_plant(arena, edit.plant, params)
    arena.obstacles.plant(edit.plant)


def _move_plant(arena: Arena, edit: MovePlant, params: SimParams) -> None:
    _check_known(edit.id, arena.obstacles.plants)
    moved = arena.obstacles.plants[edit.id]._replace(at=edit.at)
    _check_plant(arena, moved, params)
    arena.obstacles.change_plant(edit.id, moved)


def _grow_plant(arena: Arena, edit: GrowPlant, params: SimParams) -> None:
    _check_known(edit.id, arena.obstacles.plants)
    grown = arena.obstacles.plants[edit.id]._replace(radius_mm=edit.radius_mm)
    _check_plant(arena, grown, params)
    arena.obstacles.change_plant(edit.id, grown)


def _remove_plant(arena: Arena, edit: RemovePlant, _params: SimParams) -> None:
    _check_known(edit.id, arena.obstacles.plants)
    arena.obstacles.remove_plant(edit.id)


def _change_body(arena: Arena, edit: ChangeBody, _params: SimParams) -> None:
    body = _robot(arena, edit.robot)
    try:
        body.add_fault(edit.what, edit.seed)
    except ValueError as error:
        raise EditError(f"{edit.what!r} cannot happen to a body: {error}") from None


def _lift(arena: Arena, edit: Lift, _params: SimParams) -> None:
    body = _robot(arena, edit.robot)
    if body.lifted:
        raise EditError("the robot is in the air already")
    body.lift()


def _put(arena: Arena, edit: Put, params: SimParams) -> None:
    body = _robot(arena, edit.robot)
    if not body.lifted:
        raise EditError("the robot is not in the air")
    others = [other for other in arena.bodies if not (other is body or other.lifted)]
    apart_mm = min((math.dist(edit.pose[:2], other.pose[:2]) for other in others), default=math.inf)
    room_mm = clearance_mm(edit.pose[:2], arena.obstacles.bars.values(), params, arena.obstacles.plants.values())
    if min(room_mm, apart_mm - params.body_radius_mm) < params.body_radius_mm:
        raise EditError("there is no room for the robot")
    body.put(edit.pose)


def _robot(arena: Arena, index: int) -> Body:
    if index >= len(arena.bodies):
        raise EditError(f"there is no such robot; there are {len(arena.bodies)}")
    return arena.bodies[index]


_MAKERS: dict[type, Callable[[Arena, Any, SimParams], None]] = {
    AddBar: _add_bar,
    MoveBar: _move_bar,
    RemoveBar: _remove_bar,
    MoveFood: _move_food,
    Lift: _lift,
    Put: _put,
    AddPlant: _add_plant,
    MovePlant: _move_plant,
    GrowPlant: _grow_plant,
    RemovePlant: _remove_plant,
    ChangeBody: _change_body,
}


def _check_bar(arena: Arena, bar: Bar, params: SimParams) -> None:
    _check_inside(bar.a, params)
    _check_inside(bar.b, params)
    if math.dist(bar.a, bar.b) < params.bar_thickness_mm:
        raise EditError("the obstacle is too short")
    standing = (body for body in arena.bodies if not body.lifted)
    if any(clearance_mm(body.pose[:2], [bar], params) < params.body_radius_mm for body in standing):
        raise EditError("the robot stands there")


def _check_plant(arena: Arena, plant: Plant, params: SimParams) -> None:
    _check_inside(plant.at, params)
    if not PLANT_MIN_MM <= plant.radius_mm <= PLANT_MAX_MM:
        raise EditError(f"a plant has a radius of {PLANT_MIN_MM} to {PLANT_MAX_MM} mm, not {plant.radius_mm:g}")
    standing = (body for body in arena.bodies if not body.lifted)
    if any(_beside_mm(body.pose[:2], plant) < params.body_radius_mm for body in standing):
        raise EditError("the robot stands there")


def _beside_mm(point: Point, plant: Plant) -> float:
    """The distance from a point to a plant."""
    return math.dist(point, plant.at) - plant.radius_mm


def _check_inside(point: Point, params: SimParams) -> None:
    if not (0 <= point[0] <= params.width_mm and 0 <= point[1] <= params.height_mm):
        raise EditError("that is outside of the arena")


def _check_known(number: int, known: Collection[int]) -> None:
    if number not in known:
        raise EditError(f"there is no number {number}")
