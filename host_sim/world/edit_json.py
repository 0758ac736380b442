"""Edits as JSON objects: in `run.world.json`, and as commands of a page."""

from collections.abc import Callable, Mapping
from typing import Any

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
    parse = _PARSERS.get(str(fields.get("do")))
    return None if parse is None else parse(fields)


def edit_to(edit: Edit) -> dict[str, Any]:
    """The JSON object of an edit, from which `edit_from` makes an equal edit."""
    name, fields = _WRITERS[type(edit)]
    return {"do": name, **fields(edit)}


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


_PARSERS: dict[str, Callable[[Mapping[str, Any]], Edit]] = {
    "add_bar": lambda fields: AddBar(_bar(fields)),
    "move_bar": lambda fields: MoveBar(whole(fields, "id", 0, _ID_MAX), _bar(fields)),
    "remove_bar": lambda fields: RemoveBar(whole(fields, "id", 0, _ID_MAX)),
    "move_food": lambda fields: MoveFood(whole(fields, "id", 0, _ID_MAX), _point(fields, "at")),
    "lift": lambda fields: Lift(_robot_index(fields)),
    "put": lambda fields: Put(pose_from(fields), _robot_index(fields)),
    "plant": lambda fields: AddPlant(_plant(fields)),
    "move_plant": lambda fields: MovePlant(whole(fields, "id", 0, _ID_MAX), _point(fields, "at")),
    "grow_plant": lambda fields: GrowPlant(whole(fields, "id", 0, _ID_MAX), _radius_mm(fields)),
    "remove_plant": lambda fields: RemovePlant(whole(fields, "id", 0, _ID_MAX)),
    "body": lambda fields: ChangeBody(_fault(fields), _robot_index(fields), _seed(fields)),
}


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


_WRITERS: dict[type, tuple[str, Callable[[Any], dict[str, Any]]]] = {
    AddBar: ("add_bar", lambda edit: _ends(edit.bar)),
    MoveBar: ("move_bar", lambda edit: {"id": edit.id, **_ends(edit.bar)}),
    RemoveBar: ("remove_bar", lambda edit: {"id": edit.id}),
    MoveFood: ("move_food", lambda edit: {"id": edit.id, "at": _whole_point(edit.at)}),
    Lift: ("lift", lambda edit: _which(edit.robot)),
    Put: ("put", lambda edit: {**_which(edit.robot), **_pose_fields(edit.pose)}),
    AddPlant: ("plant", lambda edit: _plant_fields(edit.plant)),
    MovePlant: ("move_plant", lambda edit: {"id": edit.id, "at": _whole_point(edit.at)}),
    GrowPlant: ("grow_plant", lambda edit: {"id": edit.id, "radius": round(edit.radius_mm)}),
    RemovePlant: ("remove_plant", lambda edit: {"id": edit.id}),
    ChangeBody: ("body", lambda edit: {"what": edit.what, **_which(edit.robot), "seed": edit.seed}),
}
