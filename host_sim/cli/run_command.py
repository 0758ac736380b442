"""`tools/octet run`: lets a robot learn in simulated environments."""

import argparse
from typing import TYPE_CHECKING

from host_sim.base.errors import UsageError
from host_sim.cli.parsing import add_command, parameter_table
from host_sim.cli.run_arguments import add_run_options, add_watch_options
from host_sim.cli.run_options import check_no_page, check_run, run_options, run_stages, watch_options

if TYPE_CHECKING:
    from host_sim.cli.parsing import Subparsers

_EXAMPLES = """\
examples:
  tools/run                                          one robot, five environments
  tools/run --seed 7 --environments 1 --real-time    one environment, as fast as a real robot
  tools/run --memory robot.mem                       resume with the memory in robot.mem, and save it there
  tools/run --set turn_deg=20 --set boredom_limit=6  other parameters
  tools/run --robots 4                               four robots in the same environments
  tools/run --robots 1000                            a fleet: a thousand robots, each in its own world
  tools/run --robot emulated --board {board}       the flash image on an emulated board
  tools/run --bus socketcan:can0 --robot external --real-time
                                                     a real robot on a real bus
"""


def add(commands: "Subparsers") -> None:
    """Adds the command."""
    from host_sim.backends.images import BOARDS
    from host_sim.protocol.words import NODE_MAX
    from host_sim.sim.run_config import FLEET_MAX, WORLDS

    run = add_command(
        commands,
        "run",
        _run,
        summary="let a robot learn in simulated environments",
        description="Runs the real firmware in random simulated environments, where it learns to find food.\n"
        "`tools/run` is short for `tools/octet run`.",
        epilog=f"{parameter_table()}\n\n{_EXAMPLES.format(board=BOARDS[-1])}",
        check=_check,
        stages=run_stages,
    )
    add_run_options(run, FLEET_MAX)
    run.add_argument(
        "--worlds",
        choices=WORLDS,
        help="whether the robots share one world, each has its own, or all share a hall of as many worlds as they "
        f"need (default: one up to {NODE_MAX} robots, else own); in one world, {NODE_MAX} have a bus",
    )
    run.add_argument(
        "--real-time", action="store_true", help="run at wall-clock speed instead of as fast as possible"
    )
    run.add_argument("--watch", action="store_true", help="show the run in the browser")
    add_watch_options(run)


def _check(arguments: argparse.Namespace) -> None:
    from host_sim.protocol.words import NODE_MAX

    arguments.worlds = arguments.worlds or ("one" if arguments.robots <= NODE_MAX else "own")
    if not arguments.watch:
        check_no_page(arguments, "add --watch")
    config = check_run(arguments)
    if config.is_fleet and arguments.watch:
        raise UsageError("a fleet cannot be watched: take up to 31 robots in one world, or leave --watch out")


def _run(arguments: argparse.Namespace) -> int:
    from host_sim.backends.bus_choice import choose_bus
    from host_sim.cli.conduct import conduct, conduct_watched

    options = run_options(arguments, arguments.bus)
    if options.config.is_fleet:
        from host_sim.cli.fleet_run import conduct_fleet

        conduct_fleet(options)
    elif arguments.watch:
        speed = 1.0 if arguments.real_time else 0.0
        conduct_watched(arguments, watch_options(arguments, speed=speed, stays=False))
    else:
        conduct(run_options(arguments, choose_bus(arguments.bus, arguments.robot)))
    return 0
