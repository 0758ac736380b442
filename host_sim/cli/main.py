"""The command line, `tools/octet COMMAND ...`.

Each module NAME_command of this package, or of a folder in host_sim/lab, adds a command NAME; A_B_command adds two.
Module names leave out hyphens.
"""

import argparse
import contextlib
import errno
import importlib
import os
import signal
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from types import FrameType
from typing import NoReturn

from host_sim.base.errors import OctetError, UsageError
from host_sim.base.paths import INSTALLED, as_called, version
from host_sim.base.system import ENDING_SIGNALS
from host_sim.base.terminal import RED, coloured
from host_sim.cli.parsing import Parser

_ROOMS = ("cli", "lab/*")
_GROUPS = {
    "start": ("run", "watch", "page", "talk", "class", "new"),
    "look at a run": ("replay", "picture", "export", "world", "debug"),
    "measure": ("compare", "study", "tune", "campaign", "grade"),
    "CAN bus and protocol": ("check", "dbc"),
    "firmware": ("check-wiring", "calibrate"),
}
"""The commands, in the order of the list."""

_BROKEN_PIPE = 141
"""128 and the number of SIGPIPE, which not all systems have."""

_FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO)


class _EndedBySignal(KeyboardInterrupt):
    """Raised on SIGTERM or SIGHUP: ends a command as Ctrl-C does."""

    def __init__(self, number: int) -> None:
        super().__init__()
        self.number = number


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs a command.

    Args:
        arguments: The arguments after the program's name; None for those of this process.

    Returns:
        The exit code: 0 success, 1 error, 2 wrong usage, 128 and the signal's number where a signal ended it.
    """

    def run() -> int:
        parsed = _parse(arguments)
        code = _call(parsed)
        try:
            sys.stdout.flush()
        except BrokenPipeError:  # all is done, and the reader has read enough
            _drop_output()
        return code

    return _run(run)


def _call(parsed: argparse.Namespace) -> int:
    """Calls a command; one that lacks a library ends with a message that says how to install it."""
    try:
        code: int = parsed.command(parsed)
    except ModuleNotFoundError as error:
        name = error.name or "host_sim"
        if name.startswith("host_sim"):
            raise
        from host_sim.base.extra_library import missing

        again = f"{name} is missing from .venv: remove that folder and run the command again"
        raise OctetError(missing(name, *parsed.stages(parsed)) if INSTALLED else again) from None
    return code


def judge(arguments: Sequence[str]) -> Sequence[str]:
    """Checks a command line before anything is set up, with the standard library only.

    Returns:
        The stages of tools/setup that it needs.

    Raises:
        SystemExit: The command line is wrong or asks for help; the message has been printed.
    """
    stages: list[str] = []

    def add() -> int:
        parsed = _parse(arguments)
        stages.extend(parsed.stages(parsed))
        return 0

    code = _run(add)
    if code:
        raise SystemExit(code)
    return stages


def _run(action: Callable[[], int]) -> int:
    """Runs an action, reports an error in one line, and returns the exit code."""
    _open_closed()
    with _signals_raised():
        try:
            return action()
        except OctetError as error:
            _print_error(str(error))
            return error.exit_code
        except BrokenPipeError:  # the reader of standard output has closed it before the end
            _drop_output()
            return _BROKEN_PIPE
        except OSError as error:
            if error.filename is not None:  # a path that the system refuses, such as too long a name
                _print_error(f"cannot use {error.filename}: {error.strerror}")
                return UsageError.exit_code
            if error.errno not in _FULL:
                raise
            _drop_output()
            _print_error(f"cannot write to standard output: {error.strerror}")
            return 1
        except KeyboardInterrupt as end:
            number = end.number if isinstance(end, _EndedBySignal) else signal.SIGINT
            how = "interrupted" if number == signal.SIGINT else f"ended by {signal.Signals(number).name}"
            _print_error("; ".join([how, *end.args]))
            return 128 + number


def _print_error(message: str) -> None:
    print(coloured("octet:", RED, sys.stderr), as_called(message), file=sys.stderr)


def parser_of(given: Sequence[str]) -> Parser:
    """The parser for a command line: with the command that it names, or with all commands."""
    parser = Parser(
        prog=as_called("tools/octet"),
        usage="%(prog)s COMMAND [OPTION ...]",
        description="Octet: a robot that learns with eight bytes of memory. `tools/octet COMMAND --help` says more.",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="store_true", help="print the version and exit")
    commands = parser.add_subparsers(
        required=True, metavar="COMMAND", parser_class=Parser, prog=parser.prog, help=argparse.SUPPRESS
    )
    for name in _modules_for(given):
        importlib.import_module(name).add(commands)
    parser.epilog = _overview(commands.choices)
    return parser


def _parse(arguments: Sequence[str] | None) -> argparse.Namespace:
    given = list(sys.argv[1:] if arguments is None else arguments) or ["--help"]
    if given == ["--version"]:
        print(f"Octet {version()}", flush=True)
        raise SystemExit(0)
    parsed, unknown = parser_of(given).parse_known_args(given)
    if unknown:
        parsed.parser.unknown_option(unknown)
    parsed.check(parsed)
    return parsed


def _overview(parsers: Mapping[str, Parser]) -> str:
    """The list of the loaded commands, in their groups."""
    lines = []
    for title, names in _GROUPS.items():
        lines += [f"{title}:", *(f"  {name:12} {parsers[name].summary}" for name in names if name in parsers), ""]
    return "\n".join(lines)


@contextlib.contextmanager
def _signals_raised() -> Iterator[None]:
    """Turns SIGTERM and SIGHUP into exceptions, unless the process was started to ignore them, as by nohup."""
    numbers = [n for n in ENDING_SIGNALS if n != signal.SIGINT and signal.getsignal(n) == signal.SIG_DFL]
    for number in numbers:
        signal.signal(number, _raise_end)
    try:
        yield
    finally:
        for number in numbers:
            signal.signal(number, signal.SIG_DFL)


def _raise_end(number: int, _frame: FrameType | None) -> NoReturn:
    raise _EndedBySignal(number)


def _modules_for(arguments: Sequence[str]) -> list[str]:
    """Names the module of the called command, so that no other is loaded; or all modules, if none is called."""
    top = Path(__file__).parents[1]
    files = sorted((file for room in _ROOMS for file in top.glob(f"{room}/*_command.py")), key=lambda file: file.stem)
    name = arguments[0].replace("-", "") if arguments else ""
    called = [file for file in files if name in file.stem.split("_")[:-1]]
    return [".".join((top.name, *file.relative_to(top).with_suffix("").parts)) for file in called or files]


def _open_closed() -> None:
    """Opens the null device on each closed standard stream; otherwise a file of the run would get its descriptor."""
    for number in filter(_is_closed, range(3)):
        os.dup2(os.open(os.devnull, os.O_RDWR), number)
        os.set_inheritable(number, True)
    sys.stdin = sys.stdin or open(0, closefd=False)  # noqa: SIM115 - as long as the process lasts
    sys.stdout = sys.stdout or open(1, "w", closefd=False)  # noqa: SIM115
    sys.stderr = sys.stderr or open(2, "w", closefd=False)  # noqa: SIM115


def _drop_output() -> None:
    """Discards buffered standard output, so that flushing it at exit does not fail again."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _is_closed(number: int) -> bool:
    try:
        os.fstat(number)
    except OSError:
        return True
    return False
