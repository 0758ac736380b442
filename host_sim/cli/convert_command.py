"""`tools/octet convert`: converts a log of wire 1 to today's format."""

import argparse
import shutil
import sys

from host_sim.cli.parsing import Subparsers, add_command, check_outputs, file_path

_EXAMPLES = """\
examples:
  tools/octet convert old/run.log out/run.log
"""


def add(commands: Subparsers) -> None:
    """Adds the command."""
    parser = add_command(
        commands,
        "convert",
        _convert,
        summary="convert a log recorded with wire 1, the messages before today's",
        description="Converts a log recorded with wire 1, the messages before today's, and copies its world file.",
        epilog=_EXAMPLES,
        check=lambda arguments: check_outputs("convert", arguments.log, {"NEW": arguments.new}),
    )
    parser.add_argument("log", type=file_path, metavar="LOG", help="log of wire 1")
    parser.add_argument("new", type=file_path, metavar="NEW", help="log to write")


def _convert(arguments: argparse.Namespace) -> int:
    from host_sim.base.atomic_file import replacing
    from host_sim.client.frame_log import line_of
    from host_sim.recording.wire_1 import OldLog
    from host_sim.recording.world_file import world_path

    log = OldLog(arguments.log)
    with replacing(arguments.new) as part, part.open("w") as file:
        file.writelines(f"{line_of(*recorded)}\n" for recorded in log)
    written, world = [arguments.new], world_path(arguments.log)
    if world.exists():
        written.append(world_path(arguments.new))
        with replacing(written[-1]) as part:
            shutil.copyfile(world, part)
    if note := log.note():
        print(f"octet: {note}", file=sys.stderr)
    print(f"wrote     {', '.join(map(str, written))}")
    return 0
