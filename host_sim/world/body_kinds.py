"""The kinds of body that a robot may have: ideal, the kit's, or as a person's file describes it; and their faults."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from host_sim.base.errors import UsageError, meant, near_word
from host_sim.protocol.words import BODY_FAULTS, KIT_SETTINGS
from host_sim.world.geometry import SimParams
from host_sim.world.world_library import world_library


def check_fault(what: str) -> None:
    """Refuses text that does not name a fault.

    The plain python3 that checks a command line cannot call C, so it checks only the names.

    Raises:
        ValueError: There is no such fault; the message says what is expected.
    """
    name = what.partition(":")[0]
    if name not in BODY_FAULTS:
        raise ValueError(meant(name, BODY_FAULTS))
    if find_spec("_cffi_backend"):
        add_fault(world_library()[0].new("struct body_faults *"), what)


def add_fault(faults: Any, what: str, seed: int = 0, robot: int = 0) -> None:
    """Adds or repairs a fault of a body.

    Args:
        faults: Its `struct body_faults *`.
        what: The fault, such as "stuck-on:front"; docs/worlds.md has all.
        seed: Determines, with the robot, the ticks of noise.
        robot: Number of the robot, from 0.

    Raises:
        ValueError: There is no such fault.
    """
    ffi, library = world_library()
    if why := library.body_faults_add(faults, what.encode(), seed, robot):
        raise ValueError(ffi.string(why).decode())


IDEAL, KIT, PINS = "ideal", "kit", "pins"
_VALUES = 2  # a value, and its tolerance


@dataclass(frozen=True)
class BodyKind:
    """The kind of the bodies of a run.

    Attributes:
        traits: For each trait of `KIT_TRAITS`, by name, its value and its tolerance.
        settings: Parameters that their robots are set to unless a run says otherwise.
    """

    traits: Mapping[str, tuple[float, float]]
    settings: Mapping[str, int] = field(default_factory=dict)

    def reach(self, params: SimParams) -> SimParams:
        """The dimensions, with cones that reach as far as any sensor of these bodies."""
        reach_mm = world_library()[1].kit_reach_mm(self.in_c())
        return replace(params, sensor_reach_mm=reach_mm, front_extra_mm=0.0)

    def in_c(self) -> Any:
        """This kind as a `struct kit_kind *`."""
        return world_library()[0].new("struct kit_kind *", [*zip(*self.traits.values(), strict=True)])


def draw_body(kind: BodyKind | None, seed: int, robot: int) -> Any:
    """A robot's own body, a `struct kit *`.

    Args:
        kind: Kind of the body; None: ideal.
        seed: Seed of the run.
        robot: Number of the robot, from 0.
    """
    ffi, library = world_library()
    kit = ffi.new("struct kit *")
    library.kit_draw(kit, ffi.NULL if kind is None else kind.in_c(), seed, robot)
    return kit


def body_kind(text: str) -> BodyKind | None:
    """The kind of body that has this name or that a file describes; None for the ideal one.

    A file is TOML: a line such as `lag_ms = 40`, or with a tolerance `lag_ms = [40, 10]`, for each trait that is not
    ideal; `base = "kit"` takes the others from the kit. docs/bodies.md has all.

    Raises:
        UsageError: There is no such kind; for a file, the message gives the line, and what is allowed there.
    """
    if text == IDEAL:
        return None
    if text in {KIT, PINS}:
        return kind_from({"base": KIT})
    from host_sim.base.toml_file import read_toml  # noqa: PLC0415 - seldom needed, and slow to load

    path = Path(text)
    if path.suffix != ".toml" and not path.exists():
        raise UsageError(f"there is no body {text!r}: {meant(text, (IDEAL, KIT, PINS))}, or name a file")
    file = read_toml(path, "a body")
    try:
        return kind_from(file.content)
    except _TraitError as error:
        raise file.error(error, error.name) from None


class _TraitError(ValueError):
    def __init__(self, name: str, why: str) -> None:
        super().__init__(why)
        self.name = name


def _rows() -> dict[str, Any]:
    ffi, library = world_library()
    return {ffi.string(row.name).decode(): row for row in library.KIT_TRAITS}


def kind_from(content: Mapping[str, Any]) -> BodyKind:
    """The kind of body that the content of a file describes.

    Raises:
        ValueError: It is none.
    """
    rows, base = _rows(), content.get("base", IDEAL)
    if base not in (IDEAL, KIT):  # not a set: it may be a list
        raise _TraitError("base", f"base is {IDEAL} or {KIT}, not {base!r}")
    traits = {name: (row.kit, row.tolerance) if base == KIT else (row.ideal, 0.0) for name, row in rows.items()}
    for name, value in content.items():
        if name != "base":
            traits[name] = _value(name, value, rows)
    return BodyKind(traits, KIT_SETTINGS if base == KIT else {})


def _value(name: str, given: Any, rows: Mapping[str, Any]) -> tuple[float, float]:
    if name not in rows:
        near = near_word(name, tuple(rows))
        raise _TraitError(name, f"there is no {name!r}" + (f": did you mean {near!r}?" if near else ""))
    values = given if isinstance(given, list) else [given, 0]
    least, most = rows[name].least, rows[name].most
    numbers = [value for value in values if isinstance(value, int | float) and not isinstance(value, bool)]
    if len(numbers) != len(values) or len(values) != _VALUES:
        raise _TraitError(name, f"{name} is a number, or [number, tolerance]")
    if not least <= numbers[0] <= most or not 0 <= numbers[1] <= most - least:
        raise _TraitError(name, f"{name} is {least:g} to {most:g}, its tolerance 0 to {most - least:g}")
    return float(numbers[0]), float(numbers[1])
