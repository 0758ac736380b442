"""`tools/octet compare`: compares behaviours in the same worlds."""

import argparse
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from host_sim.base.errors import UsageError, counted
from host_sim.cli.parsing import DEFAULT, Subparsers, add_command, file_path, number, settings
from host_sim.lab.study.study_command import add_workers, rehearse_all, with_progress, worker_stages, workers_of
from host_sim.protocol.words import PROFILES
from host_sim.sim.access import BOARDS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from host_sim.lab.study.plan import Plan
    from host_sim.lab.study.sample import Sample

_EXAMPLES = """\
examples:
  tools/octet compare out/studies/learned                           the results of a study
  tools/octet compare out/studies/learned --plots out/plots         the same, and plots
  tools/octet compare studies/bodies.toml                           run a study as fleets: behaviours on real bodies
  tools/octet compare article fixed never --seeds 40                the value of learning and remembering
  tools/octet compare article mine.c                                your own behaviour
  tools/octet compare article --seeds 2 --robot emulated            the flash image, on an emulated board
  tools/octet compare article searcher --body kit                   with real motors and sensors
  tools/octet compare article forgetful --change swap-motors@env1      with the two motors swapped

Exit code 1 if the study has goals and misses one.
"""
_OF_RUNS = ("seeds", "seed", "environments", "set", "body", "change", "robot", "jobs", "cluster", "chunk")
"""The options that select the runs to make; the runs of a study exist already."""

_SET_HELP = "change a parameter, as tools/run --help-all lists them; may be repeated"


def add(commands: Subparsers) -> None:
    """Adds the command."""
    parser = add_command(
        commands,
        "compare",
        _compare,
        summary="compare behaviours, or the conditions of a study",
        description="Summarizes a study, or runs each profile with the same seeds and summarizes that.",
        epilog=_EXAMPLES,
        check=_check,
        stages=_stages,
    )
    add = parser.add_argument
    profiles = f"profiles: {', '.join(PROFILES)}, MINE.C"
    words = f"folder of a study; its file, to run it as fleets, without logs; or {profiles}"
    add("what", nargs="+", metavar="STUDY|PROFILE", help=words)
    least = "smallest difference of interest, %%; prints how many seeds it takes to detect it" + DEFAULT
    add("--difference", type=number(0.01, 100, float), default=5, metavar="PERCENT", help=least)
    add("--plots", type=file_path, metavar="FOLDER", help="draw plots into this folder")
    coverage = "print how often the intervals from N seeds of the study contain the figures of all its seeds"
    add("--coverage", type=number(10, 100_000), metavar="N", help=coverage)
    add = parser.add_argument_group("with profiles").add_argument
    add("--seeds", type=number(1, 100_000), default=100, metavar="N", help="number of seeds" + DEFAULT)
    add("--seed", type=number(0, 2**31), default=1, metavar="SEED", help="first seed" + DEFAULT)
    add("--environments", type=number(1, 1000), default=5, metavar="N", help="environments per seed" + DEFAULT)
    add("--set", type=settings, action="append", default=[], metavar="NAME=VALUE", help=_SET_HELP)
    add("--body", default="ideal", metavar="BODY", help="the robots' bodies, as tools/run has them" + DEFAULT)
    add("--change", action="append", default=[], metavar="CHANGE", help="one change, as tools/run has them")
    add("--robot", choices=("spawn", "emulated"), default="spawn", help="where robots come from" + DEFAULT)
    add_workers(parser)
    parser.set_defaults(untouched={name: parser.get_default(name) for name in _OF_RUNS})


def _check(arguments: argparse.Namespace) -> None:
    from host_sim.sim.run_config import profile_error
    from host_sim.world.body_kinds import body_kind

    folder = Path(arguments.what[0])
    if folder.is_dir() and len(arguments.what) > 1:
        raise UsageError(f"{folder} is the folder of a study, which is compared by itself: name nothing else")
    if folder.is_dir() or folder.suffix == ".toml":
        _check_no_runs(arguments)
        return
    if arguments.coverage:
        raise UsageError("--coverage draws from the seeds of a study: name its folder")
    for word in arguments.what:
        if wrong := profile_error(word):
            raise UsageError(f"{word!r} is neither a profile nor the folder of a study: {wrong}")
    if find_spec("_cffi_backend"):  # the plain python3 that checks a command line cannot call C
        body_kind(arguments.body)
    if len(arguments.change) > 1:
        raise UsageError("give one --change with profiles; for several, write a study with a file of changes")


def _stages(arguments: argparse.Namespace) -> "Sequence[str]":
    emulated = [BOARDS[0], "emulator"] if arguments.robot == "emulated" else []
    study = ["study"] if arguments.plots or Path(arguments.what[0]).is_dir() else []
    return [*emulated, *study, *worker_stages(arguments)] or ["run"]


def _compare(arguments: argparse.Namespace) -> int:
    from host_sim.lab.study.folder import used_seed_notes
    from host_sim.lab.study.table import coverage_table, judge, table

    folder = Path(arguments.what[0])
    if folder.suffix == ".toml":
        plan, samples = of_fleets(folder)
    else:
        plan, samples = of_study(folder) if folder.is_dir() else _of_profiles(arguments)
    environments = counted(plan.conditions[0].config.environments, "environment")
    held_out = f", none of {plan.chosen_on[0]}..{plan.chosen_on[1]}" if plan.chosen_on else ""
    print(f"{plan.title}: {counted(len(samples[0].seeds), 'seed')} of {environments} each{held_out}")
    if arguments.coverage:
        print(coverage_table(samples, arguments.coverage))
        return 0
    print("\n".join([table(samples, arguments.difference / 100), *used_seed_notes(*plan.seeds_used)]))
    if arguments.plots:
        from host_sim.lab.study.plots import draw_plots

        print(f"wrote     {', '.join(map(str, draw_plots(samples, arguments.plots)))}")
    judged = list(judge(plan.goals, samples))
    for each in judged:
        print(each)
    return 0 if all(each.is_reached for each in judged) else 1


def _check_no_runs(arguments: argparse.Namespace) -> None:
    """Refuses options for runs if none are made."""
    given = [f"--{name}" for name, value in arguments.untouched.items() if getattr(arguments, name) != value]
    if given:
        raise UsageError(
            f"{arguments.what[0]} is the folder of a study: leave out {', '.join(given)}, for profiles only"
        )


def of_fleets(path: Path) -> "tuple[Plan, Sequence[Sample]]":
    """Reads a plan, and runs its conditions as fleets.

    Raises:
        UsageError: The file is not a plan, or not one for fleets.
    """
    from host_sim.lab.study.fleets import samples_of_fleets
    from host_sim.lab.study.plan import read_plan

    plan = _no_atlas(read_plan(path))
    return plan, samples_of_fleets(plan)


def _no_atlas(plan: "Plan") -> "Plan":
    if plan.is_atlas:
        raise UsageError("an atlas is not compared: tools/octet study with its file prints what it shows")
    return plan


def of_study(path: Path) -> "tuple[Plan, Sequence[Sample]]":
    """Reads the plan and the samples of the study in a folder.

    Raises:
        UsageError: There is no study, or it has nothing to compare yet.
    """
    from host_sim.lab.study.folder import PLAN_FILE, StudyFolder
    from host_sim.lab.study.plan import read_plan
    from host_sim.lab.study.sample import samples_of

    folder = StudyFolder(path)
    plan = _no_atlas(read_plan(path / PLAN_FILE))
    seeds = range(plan.first_seed, plan.first_seed + plan.seeds)
    samples = samples_of(folder.tables(), [it.condition for it in plan.conditions], seeds)
    if not len(samples[0].seeds):
        raise UsageError(f"no seed in {path} has a run of each condition yet: go on with tools/octet study")
    return replace(plan, title=folder.about["title"]), samples


def _of_profiles(arguments: argparse.Namespace) -> "tuple[Plan, Sequence[Sample]]":
    from host_sim.lab.study.plan import Plan
    from host_sim.lab.study.sample import samples_of
    from host_sim.lab.study.tables import tables_of
    from host_sim.lab.study.trial import Trial, run_trial
    from host_sim.sim.run_config import C_FILE, RunConfig
    from host_sim.world.changes import Change

    a = arguments
    for change in a.change:
        Change.parse(change)
    chosen = {name: value for each in a.set for name, value in each.items()}
    shared = RunConfig(
        environments=a.environments, settings=chosen, body=a.body, changes=tuple(a.change), robot=a.robot
    )
    names = list(dict.fromkeys(a.what))
    configs = [
        replace(shared, profile=name, fast=name.endswith(C_FILE) and a.robot == RunConfig.robot) for name in names
    ]
    plan = Plan(" ".join(names), list(map(Trial, configs, names)), a.seed, a.seeds)
    rehearse_all(plan, a.cluster)
    runs = [run for some in with_progress(run_trial, plan.trials(), workers_of(a), a.chunk) for run in some]
    return plan, samples_of(tables_of(runs), names)
