"""`tools/octet study`: runs a study, or resumes one that was stopped."""

import argparse
import os
import time
from collections.abc import Iterator, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING

from host_sim.base.errors import UsageError
from host_sim.base.paths import as_called
from host_sim.cli.parsing import DEFAULT, Subparsers, add_command, file_path, number

if TYPE_CHECKING:
    from host_sim.lab.study.folder import StudyFolder
    from host_sim.lab.study.trial import Run, Trial
    from host_sim.lab.workers import Workers

_EXAMPLES = """\
examples:
  tools/octet study studies/learned.toml                          learned behaviour against programmed
  tools/octet study studies/learned.toml --out out/mine           into another folder
  tools/octet study studies/learned.toml --dask tcp://host:8786   on a cluster (tools/octet dask)
  tools/octet compare out/studies/learned                         its results

Run the same command again to resume a study that was stopped, or to run seeds added to its file.
"""
_WRITE_S = 5.0
_OUT = Path("out/studies")


def add(commands: Subparsers) -> None:
    """Adds the command."""
    parser = add_command(
        commands,
        "study",
        _study,
        summary="run a study of behaviours in many environments",
        description="Runs each condition of a study with the same seeds, on all cores, and writes Parquet.",
        epilog=_EXAMPLES,
        stages=lambda arguments: ["study", *worker_stages(arguments)],
    )
    add = parser.add_argument
    add("plan", type=file_path, metavar="FILE.toml", help="the study")
    add("--out", type=file_path, metavar="FOLDER", help=f"folder for the rows (default: {_OUT}/NAME)")
    add_workers(parser)


def add_workers(parser: argparse.ArgumentParser) -> None:
    """Adds the options that select the workers."""
    add = parser.add_argument
    add("--jobs", type=number(1, 1024), default=os.cpu_count(), metavar="N", help="processes" + DEFAULT)
    add(
        "--dask", metavar="ADDRESS", help="run on the cluster of this Dask scheduler instead, such as tcp://host:8786"
    )
    chunk = "runs per work item (default: automatic)"
    add("--chunk", type=number(1, 100_000), default=0, metavar="N", help=chunk)


def worker_stages(arguments: argparse.Namespace) -> list[str]:
    """The stages of tools/setup that the workers need."""
    return ["cluster"] if arguments.dask else []


def workers_of(arguments: argparse.Namespace) -> "Workers":
    """The workers selected by the options.

    Raises:
        UsageError: There is no scheduler at the address.
    """
    from host_sim.lab.workers import cluster, processes

    return cluster(arguments.dask) if arguments.dask else processes(arguments.jobs)


def _study(arguments: argparse.Namespace) -> int:
    out = arguments.out or _OUT / arguments.plan.stem
    runs = run_study(arguments.plan, out, workers_of(arguments), arguments.chunk)
    print(f"wrote     {out} ({runs})\ncompare   {as_called('tools/octet')} compare {out}")
    return 0


def run_study(path: Path, out: Path, workers: "Workers", chunk: int = 0) -> str:
    """Runs the missing trials of a study, and returns their number in words."""
    from host_sim.base.atomic_file import write_bytes
    from host_sim.lab.study.folder import PLAN_FILE, open_study
    from host_sim.lab.study.plan_file import read_plan

    plan = read_plan(path)
    if plan.is_fleet:
        raise UsageError(f"{path}: robots in worlds of their own run as a fleet: use tools/octet compare {path}")
    with open_study(out, plan) as folder:
        write_bytes(out / PLAN_FILE, path.read_bytes())
        done = folder.done()
        trials = [trial for trial in plan.trials() if trial.key not in done]
        with ExitStack() as stack:
            keeper = _Keeper(folder)
            stack.callback(keeper.write)  # however the study ends
            for runs in with_progress(trials, workers, chunk):
                keeper.extend(runs)
    return (
        f"{len(trials)} runs, {len(plan.trials()) - len(trials)} existed already" if done else f"{len(trials)} runs"
    )


def with_progress(trials: "Sequence[Trial]", workers: "Workers", chunk: int = 0) -> "Iterator[Sequence[Run]]":
    """Runs trials, with a progress line."""
    from host_sim.cli.progress_line import ProgressLine
    from host_sim.lab.study.workers import run_all

    done = 0
    with ProgressLine(len(trials)) as line:
        for runs in run_all(trials, workers, chunk):
            done += len(runs)
            if line.is_due():
                line.show("runs", done)
            yield runs


class _Keeper:
    """Writes completed runs every few seconds."""

    def __init__(self, folder: "StudyFolder") -> None:
        self._folder, self._runs, self._written = folder, list["Run"](), 0.0

    def extend(self, runs: "Sequence[Run]") -> None:
        self._runs += runs
        if time.monotonic() >= self._written + _WRITE_S:
            self.write()

    def write(self) -> None:
        runs, self._runs = self._runs, []  # a signal during the write must not write them twice
        if runs:
            self._folder.add(runs)
        self._written = time.monotonic()
