"""`tools/octet picture`: an animation or a picture of a recorded log."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from host_sim.cli.log_options import add_log_options, resimulated
from host_sim.cli.parsing import add_command, number
from host_sim.errors import UsageError

if TYPE_CHECKING:
    from host_sim.cli.parsing import Subparsers

_EXAMPLES = """\
examples:
  tools/octet picture out/run.log --png run.png                    the whole run, as `run` leaves it
  tools/octet picture out/run.log --gif trial.gif --from 12 --to 20
"""


def add(commands: "Subparsers") -> None:
    """Adds the command."""
    parser = add_command(
        commands,
        "picture",
        _picture,
        summary="make an animation or a picture of a recorded log",
        description="Draws a recorded run, for a README or a lesson.",
        epilog=_EXAMPLES,
    )
    add_log_options(parser)
    add, time = parser.add_argument, number(0, 1e9, float)
    add("--gif", type=Path, metavar="FILE", help="an animation, of about 45 s at most")
    add("--png", type=Path, metavar="FILE", help="one picture of the whole run")
    add(
        "--from",
        type=time,
        default=0.0,
        metavar="S",
        dest="from_s",
        help="first robot second (default: %(default)s)",
    )
    add("--to", type=time, metavar="S", dest="to_s", help="last robot second (default: the last of the run)")
    add(
        "--speed",
        type=number(0.1, 1000, float),
        default=1.0,
        metavar="X",
        help="factor to real time (default: %(default)s)",
    )
    add("--width", type=number(320, 1280), default=640, metavar="PX", help="of the animation (default: %(default)s)")


def _picture(arguments: argparse.Namespace) -> int:
    from host_sim.report.animation import Clip, write_gif
    from host_sim.report.picture import write_picture

    if arguments.gif is None and arguments.png is None:
        raise UsageError("give --gif FILE for an animation, or --png FILE for a picture")
    trajectory = resimulated(arguments).trajectory
    if arguments.gif is not None:
        write_gif(arguments.gif, trajectory, Clip(arguments.from_s, arguments.to_s, arguments.speed, arguments.width))
    if arguments.png is not None:
        write_picture(arguments.png, trajectory)
    print(f"wrote     {', '.join(str(path) for path in (arguments.gif, arguments.png) if path is not None)}")
    return 0
