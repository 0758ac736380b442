"""Carries out what a person does to the world, where it can be done."""

import math
from collections.abc import Callable, Collection, Iterable
from typing import Any

import numpy as np

from host_sim.world.arena import Arena
from host_sim.world.body import Body
from host_sim.world.edits import AddBar, Edit, Lift, MoveBar, MoveFood, Put, RemoveBar
from host_sim.world.geometry import Bar, Point
from host_sim.world.layouts import clearance_mm
from host_sim.world.params import SimParams

BARS_MAX = 40


class EditError(ValueError):
    """An edit that cannot be made in this world as it is; says why, in words for people."""


def make_edit(arena: Arena, edit: Edit, params: SimParams) -> None:
    """Makes one edit, between two ticks. Equal edits at equal ticks give equal runs.

    Raises:
        EditError: Nothing was changed.
    """
    _MAKERS[type(edit)](arena, edit, params)
    arena.settle()


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
    room_mm = _room_mm(edit.pose[:2], arena.obstacles.bars.values(), params)
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
}


def _check_bar(arena: Arena, bar: Bar, params: SimParams) -> None:
    _check_inside(bar.a, params)
    _check_inside(bar.b, params)
    if math.dist(bar.a, bar.b) < params.bar_thickness_mm:
        raise EditError("the obstacle is too short")
    standing = (body for body in arena.bodies if not body.lifted)
    if any(_room_mm(body.pose[:2], [bar], params) < params.body_radius_mm for body in standing):
        raise EditError("the robot stands there")


def _check_inside(point: Point, params: SimParams) -> None:
    if not (0 <= point[0] <= params.width_mm and 0 <= point[1] <= params.height_mm):
        raise EditError("that is outside of the arena")


def _check_known(number: int, known: Collection[int]) -> None:
    if number not in known:
        raise EditError(f"there is no number {number}")


def _room_mm(point: Point, bars: Iterable[Bar], params: SimParams) -> float:
    """The distance from a point to the nearest of these bars or a wall."""
    return float(clearance_mm(np.array([point]), tuple(bars), params)[0])
