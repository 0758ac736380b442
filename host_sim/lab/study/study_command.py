"""`tools/octet study`: runs a study, or resumes one that was stopped."""

import argparse
import os
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Any

from host_sim.base.errors import UsageError
from host_sim.base.paths import as_called
from host_sim.cli.parsing import DEFAULT, Subparsers, add_command, file_path, number

if TYPE_CHECKING:
    from host_sim.lab.study.atlas import Maps
    from host_sim.lab.study.atlas_report import Report
    from host_sim.lab.study.folder import StudyFolder
    from host_sim.lab.study.plan import Plan
    from host_sim.lab.study.trial import Trial
    from host_sim.lab.workers import Workers

_EXAMPLES = """\
examples:
  tools/octet study studies/learned.toml                          learned behaviour against programmed
  tools/octet study studies/learned.toml --out out/mine           into another folder
  tools/octet study studies/learned.toml --cluster tcp://host:8786   on a Dask cluster
  tools/octet compare out/studies/learned                         its results
  tools/octet study studies/learned.toml --docs docs              its tables, plots and numbers in docs/learning.md

Run the same command again to resume a study that was stopped, or to run seeds added to its file.
"""
_WRITE_S = 5.0
_OUT = Path("out/studies")
_DOCUMENT, _SIZE_MAX = "learning.md", 1_000_000


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
    document = f"write table and plots there, and their numbers into {_DOCUMENT}, as in docs/"
    add("--docs", type=file_path, metavar="FOLDER", help=document)
    add_workers(parser)


def add_workers(parser: argparse.ArgumentParser) -> None:
    """Adds the options that select the workers."""
    add = parser.add_argument
    add("--jobs", type=number(1, 1024), default=os.cpu_count(), metavar="N", help="processes" + DEFAULT)
    scheduler = "run on the cluster of this Dask scheduler instead, such as tcp://host:8786"
    add("--cluster", metavar="ADDRESS", help=scheduler)
    chunk = "runs per work item (default: automatic)"
    add("--chunk", type=number(1, 100_000), default=0, metavar="N", help=chunk)


def worker_stages(arguments: argparse.Namespace) -> list[str]:
    """The stages of tools/setup that the workers need."""
    return ["cluster"] if arguments.cluster else []


def workers_of(arguments: argparse.Namespace) -> "Workers":
    """The workers selected by the options.

    Raises:
        UsageError: There is no scheduler at the address.
    """
    from host_sim.lab.workers import cluster, processes

    return cluster(arguments.cluster) if arguments.cluster else processes(arguments.jobs)


def _study(arguments: argparse.Namespace) -> int:
    out = arguments.out or _OUT / arguments.plan.stem
    if arguments.docs is not None:
        return _document(arguments, out)
    from host_sim.lab.study.plan import read_plan

    plan = read_plan(arguments.plan)
    runs = run_study(arguments, plan, out)
    if plan.is_atlas:
        _atlas(plan, out)
    print(f"wrote     {out} ({runs})")
    if not plan.is_atlas:
        print(f"compare   {as_called('tools/octet')} compare {out}")
    return 0


def _atlas(plan: "Plan", out: Path) -> "Report":
    """Prints and draws the report of an atlas."""
    from host_sim.lab.study.atlas import Maps
    from host_sim.lab.study.atlas_report import draw_map, report_of, write_map
    from host_sim.lab.study.table import table

    report = report_of(plan, Maps(out))
    write_map(report, out / "map.csv")
    draw_map(report, out / "map.png")
    print("\n\n".join([str(report), *map(table, report.samples)]))
    return report


def _document(arguments: argparse.Namespace, out: Path) -> int:
    """Runs a study, and writes its table, its plots and the numbers of a document."""
    from host_sim.base.files import read_text, write_bytes
    from host_sim.lab.study.compare_command import of_fleets, of_study
    from host_sim.lab.study.document import TABLES, fill, write_table
    from host_sim.lab.study.plan import read_plan
    from host_sim.lab.study.plots import draw_plots

    name, docs, plan = arguments.plan.stem, arguments.docs, read_plan(arguments.plan)
    document = docs / _DOCUMENT
    if not document.exists():
        raise UsageError(f"there is no {document} to fill in; choose its folder with --docs")
    if not plan.is_fleet:
        run_study(arguments, plan, out)
    if plan.is_atlas:
        _document_atlas(_atlas(plan, out), docs, name)
    else:
        _, samples = of_fleets(arguments.plan) if plan.is_fleet else of_study(out)
        write_table(samples, docs / TABLES / f"{name}.csv")
        draw_plots(samples, docs / "images", f"{name}-", plan.plots)
    write_bytes(document, fill(read_text(document, _SIZE_MAX), docs).encode())
    print(f"wrote     {document}")
    return 0


def _document_atlas(report: "Report", docs: Path, name: str) -> None:
    """Writes the tables of an atlas, and draws its maps."""
    from host_sim.lab.study.atlas_report import draw_map, write_map
    from host_sim.lab.study.document import TABLES, rows_of, write_rows

    tables = docs / TABLES
    write_rows(report.rows(), tables / f"{name}-cells.csv")
    write_rows(
        {key: row for samples in report.samples for key, row in rows_of(samples).items()}, tables / f"{name}.csv"
    )
    write_map(report, tables / f"{name}-map.csv")
    draw_map(report, docs / "images" / f"{name}-map.png")


def run_study(arguments: argparse.Namespace, plan: "Plan", out: Path) -> str:
    """Runs the missing trials of a study, and returns their number in words."""
    from host_sim.base.files import write_bytes
    from host_sim.lab.study.atlas import Maps, map_of
    from host_sim.lab.study.folder import PLAN_FILE, open_study, used_seed_notes
    from host_sim.lab.study.trial import run_trial

    path: Path = arguments.plan
    if plan.is_fleet:
        raise UsageError(f"{path}: robots in worlds of their own run as a fleet: use tools/octet compare {path}")
    for line in used_seed_notes(*plan.seeds_used):
        print(line)
    rehearse_all(plan, arguments.cluster)
    with open_study(out, plan) as study:
        write_bytes(out / PLAN_FILE, path.read_bytes())
        folder, make = (Maps(out), map_of) if plan.is_atlas else (study, run_trial)
        done = folder.done()
        trials = [trial for trial in plan.trials() if trial.key not in done]
        with ExitStack() as stack:
            writer = _PeriodicWriter(folder)
            stack.callback(writer.write)  # however the study ends
            for runs in with_progress(make, trials, workers_of(arguments), arguments.chunk):
                writer.extend(runs)
    return (
        f"{len(trials)} runs, {len(plan.trials()) - len(trials)} existed already" if done else f"{len(trials)} runs"
    )


def rehearse_all(plan: "Plan", cluster: str | None) -> None:
    """Runs users' behaviours for a minute in a process with memory checks, which the workers do not have.

    Raises:
        UsageError: The workers do not have the file.
        BrainError: A behaviour has made a mistake.
    """
    from host_sim.sim.make import rehearse

    for it in plan.conditions:
        if it.config.own and cluster:
            raise UsageError(f"--profile {it.config.profile} is a file of this machine: leave --cluster out")
        rehearse(it.config)


def with_progress(
    make: "Callable[[Trial], Any]", trials: "Sequence[Trial]", workers: "Workers", chunk: int
) -> "Iterator[Sequence[Any]]":
    """As `host_sim.lab.study.trial.run_all`, with a progress line."""
    from host_sim.base.terminal import ProgressLine
    from host_sim.lab.study.trial import run_all

    done = 0
    with ProgressLine(len(trials)) as line:
        for runs in run_all(make, trials, workers, chunk):
            done += len(runs)
            if line.is_due():
                line.show("runs", done)
            yield runs


class _PeriodicWriter:
    """Writes completed runs every few seconds."""

    def __init__(self, folder: "StudyFolder | Maps") -> None:
        self._folder, self._runs, self._written = folder, list[Any](), 0.0

    def extend(self, runs: "Sequence[Any]") -> None:
        self._runs += runs
        if time.monotonic() >= self._written + _WRITE_S:
            self.write()

    def write(self) -> None:
        runs, self._runs = self._runs, []  # a signal during the write must not write them twice
        if runs:
            self._folder.add(runs)
        self._written = time.monotonic()
