"""The command line, `tools/octet COMMAND ...`. Each module of this package named *_command adds one command."""

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
    """Runs a command.

    Args:
        arguments: The arguments after the program's name; None for those of this process.

    Returns:
        The exit code: 0 success, 1 error, 2 wrong usage, 130 interrupted.
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
        # The reader of stdout has closed it; the rest of the output must not fail a second time at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        code = 1
    except KeyboardInterrupt:
        print("octet: interrupted; the log so far was written", file=sys.stderr)
        code = 130
    return code


def _command_modules() -> Iterator[ModuleType]:
    for info in pkgutil.iter_modules(cli.__path__):
        if info.name.endswith("_command"):
            yield importlib.import_module(f"host_sim.cli.{info.name}")
