"""Changes of the world while robots are in it, by a person or a schedule.

They are JSON objects in `run.world.json` and as commands of a page: `do`, and the fields that `robot.toml` gives it.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from host_sim.protocol.generated import EDITS
from host_sim.world.body_kinds import check_fault
from host_sim.world.geometry import Point
from host_sim.world.world_library import world_library

SIZE_MAX_MM = 100_000
"""Maximum coordinate in an edit, mm."""

_NOWHERE = (0.0, 0.0)


@dataclass(frozen=True)
class Edit:
    """A change, as `struct edit` in `native/edits.h` has it. Numbers are whole; a fraction is rounded.

    Attributes:
        do: Its name in `EDITS`. `add_bar`, `move_bar` and `remove_bar` change the obstacles, and `plant`,
            `move_plant`, `grow_plant` and `remove_plant` the plants; what is added gets the next id. `push_bar` says
            where robots have pushed an obstacle. `move_food` moves a piece of food, eaten or not. A robot that was
            lifted (`lift`) turns its wheels, but does not move or sense anything until it is put down (`put`).
            `body` breaks something in a body, or repairs it.
        id: The obstacle, plant or piece of food that changes.
        robot: The robot, counted from 0.
        seed: Determines the ticks of noise.
        heading: Heading of a robot, -3142..3142 mrad.
        radius: The radius of a plant, 20..500 mm.
        a: The first end of an obstacle, mm.
        b: Its second end, mm.
        at: The place of a plant, of a piece of food, or of a robot, mm.
        what: What happens to a body, as in `check_fault`.
    """

    do: str
    id: int = 0
    robot: int = 0
    seed: int = 0
    heading: float = 0
    radius: float = 0
    a: Point = _NOWHERE
    b: Point = _NOWHERE
    at: Point = _NOWHERE
    what: str = ""


class EditError(ValueError):
    """An edit that cannot be made in the world as it is; the message says why."""


def edit_from(fields: Mapping[str, Any]) -> Edit | None:
    """The edit in a JSON object, by its field `do`; None if that does not name an edit.

    Raises:
        ValueError: A field is missing, of the wrong type, or out of range.
    """
    do = str(fields.get("do"))
    needed = [name for name in EDITS.get(do, ()) if name in fields or name not in _OPTIONAL]
    return Edit(do, **{name: _READERS[name](fields, name) for name in needed}) if do in EDITS else None


def edit_to(edit: Edit) -> dict[str, Any]:
    """The JSON object of an edit, from which `edit_from` makes an equal edit. The first robot is not named."""
    written = {name: _whole(getattr(edit, name)) for name in EDITS[edit.do] if name != "robot" or edit.robot}
    return {"do": edit.do, **written}


def edit_in_c(edit: Edit) -> Any:
    """An edit as a `struct edit *`."""
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
    return _in_range(fields.get(name), name, low, high)


def _in_range(value: object, name: str, low: int, high: int) -> int:
    if type(value) is not int or not low <= value <= high:
        raise ValueError(f"{name} must be a whole number from {low} to {high}")
    return value


def _from(low: int, high: int) -> Callable[[Mapping[str, Any], str], int]:
    return lambda fields, name: whole(fields, name, low, high)


def _point(fields: Mapping[str, Any], name: str) -> Point:
    value = fields.get(name)
    if not isinstance(value, list) or len(value) != 2:  # noqa: PLR2004 - x and y
        raise ValueError(f"{name} must be [x, y]")
    x, y = (_in_range(number, name, 0, SIZE_MAX_MM) for number in value)
    return float(x), float(y)


def _fault(fields: Mapping[str, Any], name: str) -> str:
    what = fields.get(name)
    if not isinstance(what, str):
        raise ValueError(f"{name} must be a text")
    check_fault(what)
    return what


def _whole(value: Any) -> Any:
    """Numbers rounded, those of a point, too; a text as it is."""
    if isinstance(value, tuple):
        return [round(number) for number in value]
    return value if isinstance(value, str) else round(value)


_OPTIONAL = frozenset(("robot", "seed"))
_READERS: dict[str, Callable[[Mapping[str, Any], str], Any]] = {
    "id": _from(0, 1_000_000),
    "robot": _from(0, 10_000),
    "seed": _from(0, 2**32 - 1),
    "heading": _from(-3142, 3142),
    "radius": _from(20, 500),
    "what": _fault,
    **dict.fromkeys(("a", "b", "at"), _point),
}
