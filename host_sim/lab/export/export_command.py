"""`tools/octet export`: writes a recorded log in the formats of other programs."""

import argparse
import sys
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from host_sim.base.errors import UsageError
from host_sim.cli.parsing import Subparsers, add_command, check_outputs, file_path

if TYPE_CHECKING:
    from host_sim.recording.log_text import Recorded

_FORMATS = {
    "csv": "a table with a row for each frame and a column for each signal",
    "parquet": "the same table as Parquet",
    "asc": "frames in Vector's ASC format",
    "blf": "frames in Vector's BLF format",
    "mf4": "frames as the bus logging of ASAM MDF 4",
    "mcap": "messages as JSON in MCAP, for Foxglove and ROS 2",
}
_LIBRARIES = {"parquet": "pyarrow", "mf4": "asammdf", "mcap": "mcap"}
_EXAMPLES = """\
examples:
  tools/octet export out/run.log --csv out/run.csv --blf out/run.blf
  tools/octet export out/run.log --mf4 out/run.mf4 --mcap out/run.mcap --parquet out/run.parquet
"""


def add(commands: Subparsers) -> None:
    """Adds the command."""
    parser = add_command(
        commands,
        "export",
        _export,
        summary="write a recorded log as CSV, Parquet, ASC, BLF, MF4 or MCAP",
        description="Writes the robots' frames of a log in the formats of other programs.",
        epilog=_EXAMPLES,
        check=_check,
        stages=lambda arguments: ["export" if _wanted(arguments).keys() & _LIBRARIES else "run"],
    )
    parser.add_argument(
        "log", type=file_path, metavar="LOG", help="log of a run, of candump, of python-can; ASC or BLF"
    )
    for name, what in _FORMATS.items():
        parser.add_argument(f"--{name}", type=file_path, metavar="FILE", help=f"write {what}")


def _wanted(arguments: argparse.Namespace) -> dict[str, Path]:
    """The file to write for each requested format."""
    return {name: getattr(arguments, name) for name in _FORMATS if getattr(arguments, name) is not None}


def _check(arguments: argparse.Namespace) -> None:
    wanted = _wanted(arguments)
    if not wanted:
        raise UsageError(f"give {', '.join(f'--{name} FILE' for name in _FORMATS)}, or several of them")
    check_outputs("export", arguments.log, {f"--{name}": path for name, path in wanted.items()})


def _export(arguments: argparse.Namespace) -> int:
    from host_sim.base.atomic_file import replacing
    from host_sim.base.extra_library import library
    from host_sim.lab.export import frames, mcap_file
    from host_sim.recording import frame_table
    from host_sim.recording.log_reader import read_log

    wanted = _wanted(arguments)
    for name in wanted:
        if name in _LIBRARIES:
            library(_LIBRARIES[name], "export")
    log = read_log(arguments.log)
    if next(iter(log), None) is None:
        raise UsageError(f"{log.note()}: there is no frame of a robot")
    writers: dict[str, Callable[[Path, Iterable[Recorded]], None]] = {
        "csv": frame_table.write_csv,
        "parquet": frame_table.write_parquet,
        "asc": frames.write_asc,
        "blf": frames.write_blf,
        "mf4": frames.write_mf4,
        "mcap": mcap_file.write_mcap,
    }
    for name, path in wanted.items():
        with replacing(path) as part:
            writers[name](part, frames.within_limits(log, name))
    if note := log.note():
        print(f"octet: {note}", file=sys.stderr)
    print(f"wrote     {', '.join(map(str, wanted.values()))}")
    return 0
