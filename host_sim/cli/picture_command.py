"""`tools/octet picture`: draws a recorded run as a picture or an animation."""

import argparse

from host_sim.base.errors import UsageError
from host_sim.cli.parsing import DEFAULT, Parser, Subparsers, add_command, check_outputs, number, output_of
from host_sim.cli.run_options import add_log_options, resimulated

_EXAMPLES = """\
examples:
  tools/octet picture out/run.log --png run.png                      one picture of the whole run
  tools/octet picture out/run.log --gif trial.gif --from 0 --to 5    its first five seconds, animated
"""


def add(commands: Subparsers) -> None:
    """Adds the command."""
    parser = add_command(
        commands,
        "picture",
        _picture,
        summary="draw a recorded run as a picture or an animation",
        description="Draws a recorded run as a PNG picture, an animated GIF, or both.",
        epilog=_EXAMPLES,
        check=_check,
    )
    add_log_options(parser)
    add = parser.add_argument
    add("--png", type=output_of(".png"), metavar="FILE", help="write a picture of the whole run to FILE")
    add("--gif", type=output_of(".gif"), metavar="FILE", help="write an animation to FILE, at most 600 frames")
    _add_clip_options(parser)


def _add_clip_options(parser: Parser) -> None:
    """Adds the options for the animation's part of the run, speed and width."""
    time, speed = number(0, 1e9, float), number(0.1, 1000, float)
    texts = {
        "from": "start of the animation, s of robot time (default: %(default)g)",
        "to": "end of the animation, s of robot time (default: end of the run)",
        "speed": "speed of the animation, as a multiple of real time (default: %(default)g)",
    }
    add = parser.add_argument
    add("--from", type=time, default=0.0, metavar="S", dest="from_s", help=texts["from"])
    add("--to", type=time, metavar="S", dest="to_s", help=texts["to"])
    add("--speed", type=speed, default=1.0, metavar="X", help=texts["speed"])
    add("--width", type=number(320, 1280), default=640, metavar="PX", help="width of the animation, pixels" + DEFAULT)


def _check(arguments: argparse.Namespace) -> None:
    if arguments.gif is None and arguments.png is None:
        raise UsageError("give --gif FILE for an animation, or --png FILE for a picture")
    if arguments.to_s is not None and arguments.to_s < arguments.from_s:
        raise UsageError(f"--to {arguments.to_s:g} s is before --from {arguments.from_s:g} s: exchange them")
    check_outputs("picture", arguments.log, {"--png": arguments.png, "--gif": arguments.gif})


def _picture(arguments: argparse.Namespace) -> int:
    from host_sim.report.animation import Clip, write_gif
    from host_sim.report.picture import write_picture

    trajectory = resimulated(arguments).trajectory
    if arguments.gif is not None:
        write_gif(arguments.gif, trajectory, Clip(arguments.from_s, arguments.to_s, arguments.speed, arguments.width))
    if arguments.png is not None:
        write_picture(arguments.png, trajectory)
    print(f"wrote     {', '.join(str(path) for path in (arguments.gif, arguments.png) if path is not None)}")
    return 0
