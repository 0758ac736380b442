"""A row of the table of options: one field of a dataclass, its help text and what it allows."""

from dataclasses import dataclass, field, fields
from functools import cache
from typing import Any


@dataclass(frozen=True)
class Option:
    """A row of the table: the properties of an option besides its name, type and default.

    Attributes:
        text: Description for people.
        limits: Its minimum and maximum; None if it is not a number, or has choices.
        choices: The permitted values; empty if any.
        endings: Files whose names end in one of these are permitted, too.
        metavar: The placeholder of its value in the help text.
        unset: Description of the default, if its value does not say enough.
        flag: Its name on the command line, if it differs from the field's.
        const: The value if the flag is given without one; None if a value is required.
        commands: The commands that have it.
        fleet: Whether a fleet has it.
    """

    text: str
    limits: tuple[float, float] | None = None
    choices: tuple[Any, ...] = ()
    endings: tuple[str, ...] = ()
    metavar: str | None = None
    unset: str = ""
    flag: str = ""
    const: str | None = None
    commands: tuple[str, ...] = ("run", "watch")
    fleet: bool = True

    def allows(self, value: Any) -> bool:
        """Whether a value is one of the choices and within the limits."""
        if self.limits is not None:
            return bool(self.limits[0] <= value <= self.limits[1])
        return not self.choices or value in self.choices or bool(self.endings and value.endswith(self.endings))

    @property
    def range(self) -> str:
        """The permitted values, for people; empty if any."""
        return "{:.10g}..{:.10g}".format(*self.limits) if self.limits else ", ".join(map(str, self.choices))


def option(default: Any, text: str, **row: Any) -> Any:
    """A field of a dataclass that is an option; the further arguments are those of `Option`."""
    given: dict[str, Any] = {"default_factory": dict} if default == {} else {"default": default}
    return field(metadata={"option": Option(text, **row)}, **given)


@cache
def options_of(config: Any) -> dict[str, tuple[Any, Option]]:
    """The options of a configuration: for each name, its field and its row."""
    return {it.name: (it, it.metadata["option"]) for it in fields(config) if "option" in it.metadata}


def flag_of(name: str, row: Option) -> str:
    """The name of an option on the command line."""
    return row.flag or f"--{name.replace('_', '-')}"
