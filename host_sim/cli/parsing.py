"""Parsing of the command line: one-line error messages, and argument types with ranges."""

import argparse
import math
from collections.abc import Callable
from typing import TYPE_CHECKING, NoReturn

from host_sim.errors import UsageError
from host_sim.protocol.generated import PARAMETERS
from host_sim.transport.bit_rates import BIT_RATE, BIT_RATES

if TYPE_CHECKING:
    Subparsers = argparse._SubParsersAction["Parser"]

DEFAULT = " (default: %(default)s)"
"""The end of the help text of an option that has a default."""


class Parser(argparse.ArgumentParser):
    """An argument parser whose errors are one line each."""

    def error(self, message: str) -> NoReturn:
        """As in `argparse.ArgumentParser`, but raises instead of exiting.

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
        commands: The subcommands of the command line.
        name: Name of the subcommand.
        run: Runs it, and returns the exit code.
        summary: Its line in the list of commands.
        description: First lines of its help text.
        epilog: Last lines of its help text, such as examples.

    Returns:
        The subcommand's parser, to which options can be added.
    """
    formatter = argparse.RawDescriptionHelpFormatter
    parser = commands.add_parser(
        name, help=summary, description=description, epilog=epilog, formatter_class=formatter
    )
    parser.set_defaults(command=run)
    return parser


def number(low: float, high: float, kind: type[int] | type[float] = int) -> Callable[[str], int | float]:
    """An argument type: a number from `low` to `high`."""

    def parse(text: str) -> int | float:
        try:
            value = kind(text)
        except ValueError:
            value = math.nan
        if not low <= value <= high:
            raise argparse.ArgumentTypeError(f"{text!r} is not a number from {low:.0f} to {high:.0f}")
        return value

    return parse


def add_bitrate(parser: argparse.ArgumentParser) -> None:
    """Adds the option for the bit rate of a bus."""
    parser.add_argument(
        "--bitrate",
        type=int,
        choices=BIT_RATES,
        default=BIT_RATE,
        metavar="BITS",
        help=f"bits a second of the bus: {', '.join(map(str, BIT_RATES))}; set up in an adapter that is not the"
        " kernel's (default: %(default)s)",
    )


def setting(text: str) -> tuple[str, int]:
    """An argument type: NAME=VALUE for a parameter, the value within the parameter's range."""
    name, _, value = text.partition("=")
    if name not in PARAMETERS:
        raise argparse.ArgumentTypeError(f"unknown parameter {name!r}; choose from {', '.join(PARAMETERS)}")
    _, low, high, _, unit, _ = PARAMETERS[name]
    if not value.isdecimal() or not low <= int(value) <= high:
        unit = f" {unit}" if unit else ""
        raise argparse.ArgumentTypeError(f"{name} must be a whole number from {low} to {high}{unit}, not {value!r}")
    return name, int(value)


def parameter_table() -> str:
    """Every parameter with its range, unit, default and meaning, for a help text."""
    lines = ["parameters for --set:"]
    for name, parameter in PARAMETERS.items():
        values = f"{parameter.minimum}..{parameter.maximum} {parameter.unit}"
        default = f"(default: {parameter.default})"
        lines.append(f"  {name:16}  {values:13}  {default:14}  {parameter.comment}")
    return "\n".join(lines)
