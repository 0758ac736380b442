"""The types of the data sent to pages: host_sim/web/generated_types.ts."""

from types import NoneType, UnionType
from typing import Any, get_args, get_origin, get_type_hints

from host_sim.recording.state_types import EnvironmentScene, Lesson, Measures, State, Trial
from host_sim.world.geometry import SimParams

_NAMES: dict[object, str] = {int: "number", float: "number", NoneType: "null"}
_TYPES: tuple[Any, ...] = (Measures, EnvironmentScene, Trial, Lesson, State, SimParams)
_SOURCES = "host_sim/recording/state_types.py and host_sim/world/geometry.py"
_HEAD = f"/* Made by tools/generate; {_SOURCES} document the fields. */\n"


def module() -> str:
    """The text of generated_types.ts."""
    return "\n".join([_HEAD, *map(_interface, _TYPES)])


def _interface(kind: Any) -> str:
    lines = [f"export interface {kind.__name__} {{"]
    for name, hint in get_type_hints(kind).items():
        mark = "?" if name in getattr(kind, "__optional_keys__", ()) else ""
        lines.append(f"  {name}{mark}: {_in_typescript(hint)};")
    return "\n".join([*lines, "}"]) + "\n"


def _in_typescript(kind: Any) -> str:
    """The TypeScript type of a Python type."""
    parts = get_args(kind)
    if get_origin(kind) is list or ... in parts:
        return f"{_in_typescript(parts[0])}[]"
    if get_origin(kind) is tuple:
        return f"[{', '.join(map(_in_typescript, parts))}]"
    if get_origin(kind) is UnionType:
        return " | ".join(map(_in_typescript, parts))
    return _NAMES.get(kind) or str(kind.__name__)
