"""What a person can do to the world while the robot is in it, and how that is written down as JSON."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from host_sim.world.geometry import Bar, Point, Pose

SIZE_MAX_MM = 100_000
"""No place is farther than this from the arena's corner."""

HEADING_MAX_MRAD = 3142
_ID_MAX = 1_000_000
_ROBOTS_MAX = 10_000


@dataclass(frozen=True)
class AddBar:
    """A new obstacle stands there; it gets the next id."""

    bar: Bar


@dataclass(frozen=True)
class MoveBar:
    """An obstacle stands elsewhere from now on."""

    id: int
    bar: Bar


@dataclass(frozen=True)
class RemoveBar:
    """An obstacle is taken away."""

    id: int


@dataclass(frozen=True)
class MoveFood:
    """A piece of food, eaten or not, lies elsewhere from now on."""

    id: int
    at: Point


@dataclass(frozen=True)
class Lift:
    """A robot, counted from 0, is held in the air: its wheels turn, it senses nothing and goes nowhere."""

    robot: int = 0


@dataclass(frozen=True)
class Put:
    """A robot, counted from 0, is put down."""

    pose: Pose
    robot: int = 0


Edit = AddBar | MoveBar | RemoveBar | MoveFood | Lift | Put


def edit_from(fields: Mapping[str, Any]) -> Edit | None:
    """The edit in a JSON object, by its `do`; None if it names no edit.

    Raises:
        ValueError: A field is missing, of a wrong type or out of all bounds.
    """
    parse = _PARSERS.get(str(fields.get("do")))
    return None if parse is None else parse(fields)


def edit_to(edit: Edit) -> dict[str, Any]:
    """The JSON object of an edit: `edit_from` gives back an equal edit."""
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
    """A field that must hold a whole number within bounds.

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
    """The pose in a JSON object: `at`, and `heading` in mrad.

    Raises:
        ValueError: A field is missing, of a wrong type or out of all bounds.
    """
    return Pose(*_point(fields, "at"), whole(fields, "heading", -HEADING_MAX_MRAD, HEADING_MAX_MRAD) / 1000)


def _robot(fields: Mapping[str, Any]) -> int:
    return whole(fields, "robot", 0, _ROBOTS_MAX) if "robot" in fields else 0


_PARSERS: dict[str, Callable[[Mapping[str, Any]], Edit]] = {
    "add_bar": lambda fields: AddBar(_bar(fields)),
    "move_bar": lambda fields: MoveBar(whole(fields, "id", 0, _ID_MAX), _bar(fields)),
    "remove_bar": lambda fields: RemoveBar(whole(fields, "id", 0, _ID_MAX)),
    "move_food": lambda fields: MoveFood(whole(fields, "id", 0, _ID_MAX), _point(fields, "at")),
    "lift": lambda fields: Lift(_robot(fields)),
    "put": lambda fields: Put(pose_from(fields), _robot(fields)),
}


def _ends(bar: Bar) -> dict[str, list[int]]:
    return {"a": _whole_point(bar.a), "b": _whole_point(bar.b)}


def _which(robot: int) -> dict[str, int]:
    """The field that names a robot; the first needs none."""
    return {"robot": robot} if robot else {}


def _whole_point(point: Point) -> list[int]:
    return [round(point[0]), round(point[1])]
