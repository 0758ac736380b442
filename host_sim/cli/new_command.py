"""`tools/octet new`: begins a behaviour of one's own, in a C file."""

import argparse
import shlex
from pathlib import Path

from host_sim.base.errors import OctetError, UsageError
from host_sim.base.paths import ROOT, as_called
from host_sim.cli.parsing import Subparsers, add_command, check_outputs, file_path
from host_sim.sim.run_config import C_FILE

_TEMPLATE = ROOT / "host_sim" / "program" / "own" / "mine.c"
_EXAMPLES = """\
examples:
  tools/octet new mine.c             the article's loop, to change
  tools/run --profile mine.c         a robot that decides by it
"""


def add(commands: Subparsers) -> None:
    """Adds the command."""
    parser = add_command(
        commands,
        "new",
        _new,
        summary="begin a behaviour of your own in a C file",
        description="Writes the article's loop to a C file, as the beginning of a behaviour of your own.",
        epilog=_EXAMPLES,
        check=_check,
    )
    parser.add_argument("file", type=file_path, metavar="MINE.C", help=f"the file, whose name ends in {C_FILE}")


def _check(arguments: argparse.Namespace) -> None:
    file = arguments.file
    if file.suffix != C_FILE:
        raise UsageError(f"{file} does not end in {C_FILE}: a behaviour is a C file")
    check_outputs("new", None, {"MINE.C": file})


def _new(arguments: argparse.Namespace) -> int:
    path: Path = arguments.file
    if not _TEMPLATE.exists():
        raise OctetError("behaviours in C files need a checkout of Octet with gcc, which a wheel is not")
    try:
        with path.open("xb") as file:
            file.write(_TEMPLATE.read_bytes())
    except FileExistsError:
        raise UsageError(f"{path} is there already: choose another name") from None
    except OSError as error:
        raise OctetError(f"cannot write {path}: {error.strerror}") from None
    print(as_called(f"wrote     {path}\ntry it    tools/run --profile {shlex.quote(str(path))}"))
    return 0
