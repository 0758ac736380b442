"""The types of the data sent to pages, for the TypeScript compiler: host_sim/web/generated_types.js."""

from types import NoneType, UnionType
from typing import Any, get_args, get_origin, get_type_hints

from host_sim.recording.state_types import EnvironmentScene, Lesson, Measures, State, Trial
from host_sim.world.geometry import SimParams

_NAMES: dict[object, str] = {int: "number", float: "number", NoneType: "null"}
_TYPES: tuple[Any, ...] = (Measures, EnvironmentScene, Trial, Lesson, State, SimParams)
_SOURCES = "host_sim/recording/state_types.py and host_sim/world/geometry.py"
_HEAD = f"// @ts-check\n/* Made by tools/generate; {_SOURCES} document the fields. */\n\n"


def module() -> str:
    """The text of generated_types.js."""
    return _HEAD + "\n".join(map(_typedef, _TYPES)) + "\nexport {};\n"


def _typedef(kind: Any) -> str:
    lines = [f" * @typedef {{Object}} {kind.__name__}"]
    for name, hint in get_type_hints(kind).items():
        shown = f"[{name}]" if name in getattr(kind, "__optional_keys__", ()) else name
        lines.append(f" * @property {{{_in_javascript(hint)}}} {shown}")
    return "\n".join(["/**", *lines, " */"]) + "\n"


def _in_javascript(kind: Any) -> str:
    """The JSDoc type of a Python type."""
    parts = get_args(kind)
    if get_origin(kind) is list or ... in parts:
        return f"{_in_javascript(parts[0])}[]"
    if get_origin(kind) is tuple:
        return f"[{', '.join(map(_in_javascript, parts))}]"
    if get_origin(kind) is UnionType:
        return " | ".join(map(_in_javascript, parts))
    return _NAMES.get(kind) or str(kind.__name__)
