"""Reads what a person types: a parser that says what is wrong in one line, and argument types with ranges."""

import argparse
import math
from collections.abc import Callable
from typing import TYPE_CHECKING, NoReturn

from host_sim.errors import UsageError
from host_sim.protocol.generated import PARAMETERS

if TYPE_CHECKING:
    Subparsers = argparse._SubParsersAction["Parser"]


class Parser(argparse.ArgumentParser):
    """Says what is wrong in one line."""

    def error(self, message: str) -> NoReturn:
        """As in `argparse.ArgumentParser`, but raises.

        Raises:
            UsageError: Always.
        """
        raise UsageError(f"{message}; see {self.prog} --help")


def add_command(  # noqa: PLR0913 - what a command's help is made of
    commands: "Subparsers",
    name: str,
    run: Callable[[argparse.Namespace], int],
    *,
    summary: str,
    description: str,
    epilog: str = "",
) -> Parser:
    """Adds a subcommand.

    Args:
        commands: Of the whole command line.
        name: What a person types.
        run: Does it, and returns the exit code.
        summary: Its line in the list of commands.
        description: What its own help begins with.
        epilog: What its own help ends with, such as examples.

    Returns:
        Its parser, for its options.
    """
    formatter = argparse.RawDescriptionHelpFormatter
    parser = commands.add_parser(
        name, help=summary, description=description, epilog=epilog, formatter_class=formatter
    )
    parser.set_defaults(command=run)
    return parser


def number(low: float, high: float, kind: type[int] | type[float] = int) -> Callable[[str], int | float]:
    """An argument type: a number within a range."""

    def parse(text: str) -> int | float:
        try:
            value = kind(text)
        except ValueError:
            value = math.nan
        if not low <= value <= high:
            raise argparse.ArgumentTypeError(f"{text!r} is not a number from {low:.0f} to {high:.0f}")
        return value

    return parse


def setting(text: str) -> tuple[str, int]:
    """An argument type: NAME=VALUE of a parameter."""
    name, _, value = text.partition("=")
    if name not in PARAMETERS:
        raise argparse.ArgumentTypeError(f"no parameter {name!r}; there are {', '.join(PARAMETERS)}")
    _, low, high, _, unit, _ = PARAMETERS[name]
    if not value.isdecimal() or not low <= int(value) <= high:
        raise argparse.ArgumentTypeError(f"{name} takes a whole number from {low} to {high} {unit}, not {value!r}")
    return name, int(value)


def parameter_table() -> str:
    """Every parameter, with its range, unit and default, for a help text."""
    lines = ["parameters for --set:"]
    for name, it in PARAMETERS.items():
        unit = f" {it.unit}" if it.unit else ""
        lines.append(f"  {name:18} {it.minimum}..{it.maximum}{unit} (default: {it.default}): {it.comment}")
    return "\n".join(lines)
