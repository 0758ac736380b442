"""`tools/octet export`: writes a recorded log in the formats of other programs, by python-can and pyarrow."""

import argparse
import sys
from collections.abc import Callable, Iterable, Iterator
from datetime import datetime, timezone
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from host_sim.base.errors import OctetError, UsageError
from host_sim.cli.parsing import Subparsers, add_command, check_outputs, file_path
from host_sim.cli.run_options import add_channel

if TYPE_CHECKING:
    from can.io.generic import MessageWriter

    from host_sim.recording.log_text import Recorded

_YEAR_9999_S = 253_370_764_800
_NANOSECONDS_S = 2**64 // 10**9 - 1


class Format(NamedTuple):
    """A format that can be written.

    Attributes:
        what: Its description in the help text.
        write: Writes frames to a file.
        last_s: Latest time, s since 1970: limited by years of four digits, or by nanoseconds in 64 bits.
        library: A library that not every command needs.
    """

    what: str
    write: "Callable[[Path, Iterable[Recorded]], None]"
    last_s: float = float("inf")
    library: str = ""


def _csv(path: Path, frames: "Iterable[Recorded]") -> None:
    from host_sim.recording.frame_table import write_csv

    write_csv(path, frames)


def _parquet(path: Path, frames: "Iterable[Recorded]") -> None:
    from host_sim.recording.frame_table import write_parquet

    write_parquet(path, frames)


def _can(name: str) -> "Callable[[Path, Iterable[Recorded]], None]":
    """A writer of python-can, by its name."""

    def write(path: Path, frames: "Iterable[Recorded]") -> None:
        import can

        _write(getattr(can, name)(path), frames)

    return write


def _mf4(path: Path, frames: "Iterable[Recorded]") -> None:
    from host_sim.recording.log_files import mf4_module

    every = iter(frames)
    first = next(every)
    writer = mf4_module().MF4Writer(path)
    # python-can has the file begin when it is written, and the frames before its beginning.
    writer._start_time = writer.last_timestamp = first.time_us / 1e6
    writer._mdf.header.start_time = datetime.fromtimestamp(first.time_us / 1e6, timezone.utc)
    _write(writer, (frame for part in ([first], every) for frame in part))


def _write(writer: "MessageWriter", frames: "Iterable[Recorded]") -> None:
    from can import Message

    with writer:
        for time_us, (frame_id, data) in frames:
            writer.on_message_received(
                Message(time_us / 1e6, frame_id, data=data, is_extended_id=False, channel=0, check=False)
            )


FORMATS = {
    "csv": Format("a table with a row for each frame and a column for each signal", _csv),
    "parquet": Format("the same table as Parquet", _parquet, library="pyarrow"),
    "asc": Format("frames in Vector's ASC format", _can("ASCWriter"), _YEAR_9999_S),
    "blf": Format("frames in Vector's BLF format", _can("BLFWriter"), _YEAR_9999_S),
    "trc": Format("frames in PEAK's TRC format", _can("TRCWriter"), _YEAR_9999_S),
    "mf4": Format("frames as the bus logging of ASAM MDF 4", _mf4, _NANOSECONDS_S, "asammdf"),
}
_EXAMPLES = """\
examples:
  tools/octet export out/run.log --csv out/run.csv --blf out/run.blf
  tools/octet export out/run.log --mf4 out/run.mf4 --trc out/run.trc --parquet out/run.parquet
"""


def add(commands: Subparsers) -> None:
    """Adds the command."""
    parser = add_command(
        commands,
        "export",
        _export,
        summary="write a recorded log as CSV, Parquet, ASC, BLF, TRC or MF4",
        description="Writes the robots' frames of a log in the formats of other programs.",
        epilog=_EXAMPLES,
        check=_check,
        stages=lambda arguments: ["export" if any(FORMATS[it].library for it in _wanted(arguments)) else "run"],
    )
    parser.add_argument("log", type=file_path, metavar="LOG", help="log of a run, of candump or of python-can")
    add_channel(parser)
    for name, it in FORMATS.items():
        parser.add_argument(f"--{name}", type=file_path, metavar="FILE", help=f"write {it.what}")


def _wanted(arguments: argparse.Namespace) -> dict[str, Path]:
    """The file to write for each requested format."""
    return {name: getattr(arguments, name) for name in FORMATS if getattr(arguments, name) is not None}


def _check(arguments: argparse.Namespace) -> None:
    wanted = _wanted(arguments)
    if not wanted:
        raise UsageError(f"give {', '.join(f'--{name} FILE' for name in FORMATS)}, or several of them")
    check_outputs("export", arguments.log, {f"--{name}": path for name, path in wanted.items()})


def _export(arguments: argparse.Namespace) -> int:
    from host_sim.base.extra_library import library
    from host_sim.base.files import replacing
    from host_sim.recording.log_reader import read_log

    wanted = _wanted(arguments)
    for name in wanted:
        if FORMATS[name].library:
            library(FORMATS[name].library, "export")
    log = read_log(arguments.log, arguments.channel)
    if next(iter(log), None) is None:
        raise UsageError(f"{log.note()}: there is no frame of a robot")
    for name, path in wanted.items():
        with replacing(path) as part:
            FORMATS[name].write(part, _within_limits(log, name))
    if note := log.note():
        print(f"octet: {note}", file=sys.stderr)
    print(f"wrote     {', '.join(map(str, wanted.values()))}")
    return 0


def _within_limits(frames: "Iterable[Recorded]", name: str) -> "Iterator[Recorded]":
    """Yields the frames, in order.

    Raises:
        OctetError: A frame's time exceeds the limit of the named format.
    """
    last_s = FORMATS[name].last_s
    for recorded in frames:
        if recorded.time_us > last_s * 1_000_000:
            raise OctetError(
                f"a frame at {recorded.time_us / 1e6:.0f} s is too late for {name.upper()}, which ends at {last_s} s:"
                " is that log in seconds?"
            )
        yield recorded
