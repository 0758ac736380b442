"""Changes that a person can make to the world while robots are in it, and their form as JSON."""

import math
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from host_sim.world.arena import Arena
from host_sim.world.body import Body
from host_sim.world.geometry import Bar, Point, Pose
from host_sim.world.params import SimParams
from host_sim.world.reach import clearance_mm
from host_sim.world.written_world import BARS_MAX

SIZE_MAX_MM = 100_000
"""Maximum coordinate in an edit, mm."""

HEADING_MAX_MRAD = 3142
_ID_MAX = 1_000_000
_ROBOTS_MAX = 10_000


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


Edit = AddBar | MoveBar | RemoveBar | MoveFood | Lift | Put


def edit_from(fields: Mapping[str, Any]) -> Edit | None:
    """The edit in a JSON object, by its field `do`; None if that does not name an edit.

    Raises:
        ValueError: A field is missing, of the wrong type, or out of range.
    """
    parse = _PARSERS.get(str(fields.get("do")))
    return None if parse is None else parse(fields)


def edit_to(edit: Edit) -> dict[str, Any]:
    """The JSON object of an edit, from which `edit_from` makes an equal edit."""
    match edit:
        case AddBar(bar):
            return {"do": "add_bar", **_ends(bar)}
        case MoveBar(bar_id, bar):
            return {"do": "move_bar", "id": bar_id, **_ends(bar)}
        case RemoveBar(bar_id):
            return {"do": "remove_bar", "id": bar_id}
        case MoveFood(food_id, at):
            return {"do": "move_food", "id": food_id, "at": _whole_point(at)}
        case Lift(robot):
            return {"do": "lift", **_which(robot)}
        case Put(pose, robot):
            heading = round(pose.heading_rad * 1000)
            return {"do": "put", **_which(robot), "at": _whole_point(pose[:2]), "heading": heading}


def whole(fields: Mapping[str, Any], name: str, low: int, high: int) -> int:
    """A field that must hold a whole number from `low` to `high`.

    Raises:
        ValueError: It does not.
    """
    return _whole(fields.get(name), name, low, high)


def _whole(value: object, name: str, low: int, high: int) -> int:
    if type(value) is not int or not low <= value <= high:
        raise ValueError(f"{name} must be a whole number from {low} to {high}")
    return value


def _point(fields: Mapping[str, Any], name: str) -> Point:
    value = fields.get(name)
    if not isinstance(value, list) or len(value) != 2:  # noqa: PLR2004 - x and y
        raise ValueError(f"{name} must be [x, y]")
    x, y = (_whole(number, name, 0, SIZE_MAX_MM) for number in value)
    return float(x), float(y)


def _bar(fields: Mapping[str, Any]) -> Bar:
    return Bar(_point(fields, "a"), _point(fields, "b"))


def pose_from(fields: Mapping[str, Any]) -> Pose:
    """The pose in a JSON object: `at`, [x, y] in mm, and `heading` in mrad.

    Raises:
        ValueError: A field is missing, of the wrong type, or out of range.
    """
    return Pose(*_point(fields, "at"), whole(fields, "heading", -HEADING_MAX_MRAD, HEADING_MAX_MRAD) / 1000)


def _robot_index(fields: Mapping[str, Any]) -> int:
    return whole(fields, "robot", 0, _ROBOTS_MAX) if "robot" in fields else 0


_PARSERS: dict[str, Callable[[Mapping[str, Any]], Edit]] = {
    "add_bar": lambda fields: AddBar(_bar(fields)),
    "move_bar": lambda fields: MoveBar(whole(fields, "id", 0, _ID_MAX), _bar(fields)),
    "remove_bar": lambda fields: RemoveBar(whole(fields, "id", 0, _ID_MAX)),
    "move_food": lambda fields: MoveFood(whole(fields, "id", 0, _ID_MAX), _point(fields, "at")),
    "lift": lambda fields: Lift(_robot_index(fields)),
    "put": lambda fields: Put(pose_from(fields), _robot_index(fields)),
}


def _ends(bar: Bar) -> dict[str, list[int]]:
    return {"a": _whole_point(bar.a), "b": _whole_point(bar.b)}


def _which(robot: int) -> dict[str, int]:
    """The field that names a robot; it is left out for the first."""
    return {"robot": robot} if robot else {}


def _whole_point(point: Point) -> list[int]:
    return [round(point[0]), round(point[1])]


class EditError(ValueError):
    """An edit that cannot be made in the world as it is; the message says why."""


def make_edit(arena: Arena, edit: Edit, params: SimParams) -> None:
    """Makes one edit, between two ticks. Equal edits at equal ticks give equal runs.

    Raises:
        EditError: The edit cannot be made; nothing was changed.
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
