"""Carries out what a person does to the world, where it can be done."""

import math
from collections.abc import Callable, Collection, Iterable
from typing import Any

import numpy as np

from host_sim.world.arena import Arena
from host_sim.world.edits import AddBar, Edit, Lift, MoveBar, MoveFood, Put, RemoveBar
from host_sim.world.environment import Bar, Point, World, clearance_mm

BARS_MAX = 40


class EditError(ValueError):
    """An edit that cannot be made in this world as it is; says why, in words for people."""


def make_edit(arena: Arena, edit: Edit, world: World) -> None:
    """Makes one edit, between two ticks. Equal edits at equal ticks give equal runs.

    Raises:
        EditError: Nothing was changed.
    """
    _MAKERS[type(edit)](arena, edit, world)
    arena.settle()


def _add_bar(arena: Arena, edit: AddBar, world: World) -> None:
    if len(arena.obstacles.bars) >= BARS_MAX:
        raise EditError(f"there are {BARS_MAX} obstacles already")
    _check_bar(arena, edit.bar, world)
    arena.obstacles.add(edit.bar)


def _move_bar(arena: Arena, edit: MoveBar, world: World) -> None:
    _check_known(edit.id, arena.obstacles.bars)
    _check_bar(arena, edit.bar, world)
    arena.obstacles.move(edit.id, edit.bar)


def _remove_bar(arena: Arena, edit: RemoveBar, _world: World) -> None:
    _check_known(edit.id, arena.obstacles.bars)
    arena.obstacles.remove(edit.id)


def _move_food(arena: Arena, edit: MoveFood, world: World) -> None:
    _check_known(edit.id, range(len(arena.food)))
    _check_inside(edit.at, world)
    arena.move_food(edit.id, edit.at)


def _lift(arena: Arena, _edit: Lift, _world: World) -> None:
    if arena.lifted:
        raise EditError("the robot is in the air already")
    arena.lift()


def _put(arena: Arena, edit: Put, world: World) -> None:
    if not arena.lifted:
        raise EditError("the robot is not in the air")
    if _room_mm(edit.pose[:2], arena.obstacles.bars.values(), world) < world.body_radius_mm:
        raise EditError("there is no room for the robot")
    arena.put(edit.pose)


_MAKERS: dict[type, Callable[[Arena, Any, World], None]] = {
    AddBar: _add_bar,
    MoveBar: _move_bar,
    RemoveBar: _remove_bar,
    MoveFood: _move_food,
    Lift: _lift,
    Put: _put,
}


def _check_bar(arena: Arena, bar: Bar, world: World) -> None:
    _check_inside(bar.a, world)
    _check_inside(bar.b, world)
    if math.dist(bar.a, bar.b) < world.bar_thickness_mm:
        raise EditError("the obstacle is too short")
    if not arena.lifted and _room_mm(arena.pose[:2], [bar], world) < world.body_radius_mm:
        raise EditError("the robot stands there")


def _check_inside(point: Point, world: World) -> None:
    if not (0 <= point[0] <= world.width_mm and 0 <= point[1] <= world.height_mm):
        raise EditError("that is outside of the arena")


def _check_known(number: int, known: Collection[int]) -> None:
    if number not in known:
        raise EditError(f"there is no number {number}")


def _room_mm(point: Point, bars: Iterable[Bar], world: World) -> float:
    """The distance from a point to the nearest of these bars or a wall."""
    return float(clearance_mm(np.array([point]), tuple(bars), world)[0])
