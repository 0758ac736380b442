"""`tools/octet world`: checks a world, and draws one of its environments."""

import argparse
from pathlib import Path

from host_sim.cli.parsing import DEFAULT, Subparsers, add_command, check_outputs, number, output_of
from host_sim.cli.run_options import add_option
from host_sim.world.names import WORLD_NAMES

_EXAMPLES = """\
examples:
  tools/octet world corridors --png corridors.png                   the first environment of seed 1
  tools/octet world corridors --seed 7 --environment 2 --png b.png  the second one of seed 7
  tools/octet world my.toml                                         check a file of your own
"""


def add(commands: Subparsers) -> None:
    """Adds the command."""
    parser = add_command(
        commands,
        "world",
        _world,
        summary="check a world, and draw one of its environments",
        description="Checks a world and describes one of its environments. Exit code 2 if the world has a mistake.",
        epilog=_EXAMPLES,
        check=lambda arguments: check_outputs("world", Path(arguments.world), {"--png": arguments.png}),
    )
    add = parser.add_argument
    add("world", metavar="WORLD", help=f"one of {', '.join(WORLD_NAMES)}, or your own file, such as my.toml")
    add_option(parser, "seed")
    add("--environment", type=number(1, 1000), default=1, metavar="N", help="number of the environment" + DEFAULT)
    add("--png", type=output_of(".png"), metavar="FILE", help="draw the environment to FILE")
    add("--width", type=number(100, 4000), default=640, metavar="PX", help="width of the picture" + DEFAULT)


def _world(arguments: argparse.Namespace) -> int:
    from host_sim.world.worlds import world_of

    world = world_of(arguments.world)
    layout, params = world.generate(arguments.seed, arguments.environment), world.params
    print(
        f"{world.name}: {params.width_mm:g} x {params.height_mm:g} mm, {len(layout.bars)} obstacles, "
        f"{len(layout.food)} pieces of food, all of which can be reached"
    )
    if arguments.png is not None:
        from host_sim.report.drawing import write_world_picture

        write_world_picture(arguments.png, layout, params, arguments.width)
        print(f"wrote     {arguments.png}")
    return 0
