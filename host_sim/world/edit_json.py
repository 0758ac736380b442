"""Edits as JSON objects: in `run.world.json`, and as commands of a page."""

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

from host_sim.world.body_faults import check_fault
from host_sim.world.edits import (
    PLANT_MAX_MM,
    PLANT_MIN_MM,
    AddBar,
    AddPlant,
    ChangeBody,
    Edit,
    GrowPlant,
    Lift,
    MoveBar,
    MoveFood,
    MovePlant,
    Put,
    RemoveBar,
    RemovePlant,
)
from host_sim.world.geometry import Bar, Plant, Point, Pose
from host_sim.world.world_library import world_library

SIZE_MAX_MM = 100_000
"""Maximum coordinate in an edit, mm."""

HEADING_MAX_MRAD = 3142
_ID_MAX = 1_000_000
_ROBOTS_MAX = 10_000
_SEED_MAX = 2**32 - 1


def edit_from(fields: Mapping[str, Any]) -> Edit | None:
    """The edit in a JSON object, by its field `do`; None if that does not name an edit.

    Raises:
        ValueError: A field is missing, of the wrong type, or out of range.
    """
    kind = _KINDS.get(str(fields.get("do")))
    return None if kind is None else kind[0](**{part.name: part.read(fields) for part in kind[1:]})


def edit_to(edit: Edit) -> dict[str, Any]:
    """The JSON object of an edit, from which `edit_from` makes an equal edit."""
    name, (_, *parts) = next((name, kind) for name, kind in _KINDS.items() if kind[0] is type(edit))
    written = (part.write(getattr(edit, part.name)) for part in parts)
    return {"do": name, **{field: value for fields in written for field, value in fields.items()}}


def edit_in_c(edit: Edit) -> Any:
    """The same as a `struct edit *`."""
    ffi, library = world_library()
    fields = edit_to(edit)
    kind = getattr(library, f"EDIT_KIND_{fields.pop('do').upper()}")
    what = fields.pop("what", "").encode()[: library.EDIT_TEXT_MAX - 1]
    return ffi.new("struct edit *", {"kind": kind, "what": what, **fields})


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


def _plant(fields: Mapping[str, Any]) -> Plant:
    return Plant(_point(fields, "at"), _radius_mm(fields))


def _radius_mm(fields: Mapping[str, Any]) -> float:
    return float(whole(fields, "radius", PLANT_MIN_MM, PLANT_MAX_MM))


def _fault(fields: Mapping[str, Any]) -> str:
    what = fields.get("what")
    if not isinstance(what, str):
        raise ValueError("what must be a text")
    check_fault(what)
    return what


def _seed(fields: Mapping[str, Any]) -> int:
    return whole(fields, "seed", 0, _SEED_MAX) if "seed" in fields else 0


def _ends(bar: Bar) -> dict[str, list[int]]:
    return {"a": _whole_point(bar.a), "b": _whole_point(bar.b)}


def _which(robot: int) -> dict[str, int]:
    """The field that names a robot; it is left out for the first."""
    return {"robot": robot} if robot else {}


def _whole_point(point: Point) -> list[int]:
    return [round(point[0]), round(point[1])]


def _pose_fields(pose: Pose) -> dict[str, Any]:
    return {"at": _whole_point(pose[:2]), "heading": round(pose.heading_rad * 1000)}


def _plant_fields(plant: Plant) -> dict[str, Any]:
    return {"at": _whole_point(plant.at), "radius": round(plant.radius_mm)}


class _Part(NamedTuple):
    """An attribute of an edit: its name, how it is read from the fields of an object, and the fields for it."""

    name: str
    read: Callable[[Mapping[str, Any]], Any]
    write: Callable[[Any], dict[str, Any]]


_ID = _Part("id", lambda fields: whole(fields, "id", 0, _ID_MAX), lambda number: {"id": number})
_BAR = _Part("bar", _bar, _ends)
_AT = _Part("at", lambda fields: _point(fields, "at"), lambda point: {"at": _whole_point(point)})
_PLANT = _Part("plant", _plant, _plant_fields)
_RADIUS = _Part("radius_mm", _radius_mm, lambda radius_mm: {"radius": round(radius_mm)})
_ROBOT = _Part("robot", _robot_index, _which)
_POSE = _Part("pose", pose_from, _pose_fields)
_WHAT = _Part("what", _fault, lambda what: {"what": what})
_SEED = _Part("seed", _seed, lambda seed: {"seed": seed})

_KINDS: dict[str, tuple[Any, ...]] = {
    "add_bar": (AddBar, _BAR),
    "move_bar": (MoveBar, _ID, _BAR),
    "remove_bar": (RemoveBar, _ID),
    "move_food": (MoveFood, _ID, _AT),
    "lift": (Lift, _ROBOT),
    "put": (Put, _ROBOT, _POSE),
    "plant": (AddPlant, _PLANT),
    "move_plant": (MovePlant, _ID, _AT),
    "grow_plant": (GrowPlant, _ID, _RADIUS),
    "remove_plant": (RemovePlant, _ID),
    "body": (ChangeBody, _WHAT, _ROBOT, _SEED),
}
"""Each edit by its name, with its parts in the order in which they are written."""
