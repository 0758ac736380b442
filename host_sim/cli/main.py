"""The command line: `tools/octet COMMAND ...`. Each module here whose name ends in _command is a command."""

import importlib
import os
import pkgutil
import sys
from collections.abc import Iterator, Sequence
from types import ModuleType

from host_sim import cli
from host_sim.cli.parsing import Parser
from host_sim.errors import OctetError


def main(arguments: Sequence[str] | None = None) -> int:
    """Does what the command line says.

    Args:
        arguments: The words after the program's name; None for those that it was started with.

    Returns:
        The exit code: 0 done, 1 fault, 2 wrong usage, 130 interrupted.
    """
    parser = Parser(prog="tools/octet", description="Octet: a robot that learns with eight bytes of memory.")
    commands = parser.add_subparsers(required=True, metavar="COMMAND", parser_class=Parser)
    for module in _command_modules():
        module.add(commands)
    try:
        parsed = parser.parse_args(arguments)
        code: int = parsed.command(parsed)
    except OctetError as error:
        print(f"octet: {error}", file=sys.stderr)
        code = error.exit_code
    except BrokenPipeError:
        # Whoever read our output has had enough; what is left of it must not fail a second time at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        code = 1
    except KeyboardInterrupt:
        print("octet: interrupted; what was recorded is kept", file=sys.stderr)
        code = 130
    return code


def _command_modules() -> Iterator[ModuleType]:
    for info in pkgutil.iter_modules(cli.__path__):
        if info.name.endswith("_command"):
            yield importlib.import_module(f"host_sim.cli.{info.name}")
