"""`tools/octet run` and `tools/octet watch`: runs a robot, unwatched or watched."""

import argparse
import sys
from dataclasses import replace

from host_sim.base.system import HAS_ROBOT_PROCESSES
from host_sim.cli.parsing import Subparsers, add_command, parameter_table
from host_sim.cli.run_options import OTHER_GROUPS, RunOptions, add_options, run_options
from host_sim.sim.access import BOARDS

_RUN_EXAMPLES = f"""\
examples:
  tools/run                                          one robot, five environments
  tools/run --seed 7 --environments 1 --real-time    one environment, as fast as a real robot
  tools/run --memory robot.mem                       resume with the memory in robot.mem, and save it there
  tools/run --set turn_deg=20 --set boredom_limit=6  other parameters
  tools/run --robots 4                               four robots in the same environments
  tools/run --robots 1000                            a fleet: a thousand robots, each in its own world
  tools/run --robot emulated --board {BOARDS[-1]:<16}the flash image on an emulated board
  tools/run --bus socketcan:can0 --robot external --real-time
                                                     a real robot on a real bus
"""
_WATCH_EXAMPLES = """\
examples:
  tools/octet watch                                  one robot, five environments
  tools/octet watch --robots 3                       three robots in the same environments
  tools/octet watch --seed 7 --memory robot.mem      other environments, with the memory in robot.mem
  tools/octet watch --listen                         for other machines too: prints an address and a QR code
  tools/octet watch --terminal                       without a browser, for example over ssh
  tools/octet watch --bus socketcan:can0 --robot observe
                                                     watch a robot that runs by itself, in this terminal
"""
_PROCESSES_MAX = 8
"""Maximum number of robots of a watched run that have a process each, unless a bus is named."""


def add(commands: Subparsers) -> None:
    """Adds the commands."""
    _add(
        commands,
        "run",
        summary="let a robot learn in simulated environments",
        description="Runs the real firmware in random simulated environments, where it learns to find food.\n"
        "`tools/run` is short for `tools/octet run`.",
        examples=_RUN_EXAMPLES,
    )
    _add(
        commands,
        "watch",
        summary="watch a robot learn in the browser, and interfere",
        description="Shows a run in the browser, in real time, with controls. Ctrl-C ends it.",
        examples=_WATCH_EXAMPLES,
        watch=True,
        stays=True,
    )


def _add(commands: Subparsers, name: str, *, examples: str, summary: str, description: str, **others: bool) -> None:
    def check(arguments: argparse.Namespace) -> None:
        arguments.options = run_options(arguments, **others)

    parser = add_command(
        commands,
        name,
        lambda arguments: _run(arguments.options),
        summary=summary,
        description=description,
        epilog=examples,
        check=check,
        stages=lambda arguments: arguments.options.stages,
    )
    parser.usage = "%(prog)s [OPTION ...]"
    parser.shorten_help(OTHER_GROUPS, parameter_table())
    add_options(parser, name)


def _run(options: RunOptions) -> int:
    from host_sim.cli.single_run import run_single

    if options.robot == "observe":
        _observe(options)
    elif options.is_fleet:
        from host_sim.cli.fleet_run import run_fleet_command

        run_fleet_command(options)
    elif options.watch:
        run_single(_watched(options))
    else:
        from host_sim.sim.access import choose_bus

        bus = "none" if options.fast else choose_bus(options.bus, options.robot)
        run_single(replace(options, bus=bus))
    return 0


def _observe(options: RunOptions) -> None:
    """Follows a robot that runs by itself until Ctrl-C or the limit, then draws its log."""
    from host_sim.base.files import run_folder
    from host_sim.cli.interruption import until_ctrl_c
    from host_sim.cli.own_source import log_words
    from host_sim.client.frame_log import FrameLog
    from host_sim.live.observer import Line, observe
    from host_sim.recording.resimulation import resimulate
    from host_sim.report.picture import write_picture
    from host_sim.report.replay_page import write_page

    path, page, picture = (options.out / f"observed.{kind}" for kind in ("log", "html", "png"))
    with run_folder(options.out):
        log = FrameLog(path)
        try:
            with until_ctrl_c(options.limit_s) as goes_on:
                observe(Line(options.bus, options.node, options.bitrate), log, sys.stdout, goes_on)
        finally:
            log.close()
        seen = resimulate(path, options.node, ignore_world=True)
        write_page(page, seen.trajectory, seen.title, log=log_words(path, None))
        write_picture(picture, seen.trajectory)
    print(f"wrote     {path}, {page}, {picture}")


def _watched(options: RunOptions) -> RunOptions:
    """The options of a watched run.

    The page sets the pace, so the robot waits for it (lockstep); an external robot has its own clock, and the page
    follows. On a bus in a network namespace of its own, no browser could reach the page; a class needs no processes.
    """
    external = options.robot == "external"
    speed = 1.0 if external or options.stays or options.real_time else 0.0
    as_processes = HAS_ROBOT_PROCESSES and options.robots <= _PROCESSES_MAX
    auto = "none" if options.robot == "spawn" and not as_processes else "fd"
    bus = auto if options.bus == "auto" else options.bus
    return replace(options, bus=bus, speed=speed, real_time=external)
