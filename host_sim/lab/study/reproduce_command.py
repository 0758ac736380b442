"""`tools/octet reproduce`: regenerates the tables, plots and numbers of docs/learning.md."""

import argparse
from pathlib import Path

from host_sim.base.errors import UsageError
from host_sim.base.paths import ROOT
from host_sim.cli.parsing import DEFAULT, Subparsers, add_command, file_path
from host_sim.lab.study.study_command import add_workers, run_study, worker_stages, workers_of

_DOCUMENT, _SIZE_MAX = "learning.md", 1_000_000
_EXAMPLES = """\
examples:
  tools/octet reproduce                  everything: a quarter of an hour on two cores
  tools/octet reproduce --only learned   only one study; other tables and plots stay
"""
_PLOTS = {"learned": ("learning", "survival"), "swapped": ("recovery",), "score": ("score",)}


def add(commands: Subparsers) -> None:
    """Adds the command."""
    parser = add_command(
        commands,
        "reproduce",
        _reproduce,
        summary="measure everything in docs/learning.md again",
        description=f"Runs every study with a table in {_DOCUMENT}, and writes the tables, plots and numbers.",
        epilog=_EXAMPLES,
        stages=lambda arguments: ["study", *worker_stages(arguments)],
    )
    add = parser.add_argument
    add(
        "--studies",
        type=file_path,
        default=ROOT / "studies",
        metavar="FOLDER",
        help="folder of the studies (default: studies/)",
    )
    add(
        "--docs",
        type=file_path,
        default=ROOT / "docs",
        metavar="FOLDER",
        help=f"folder with {_DOCUMENT}; tables and plots go there too (default: docs/)",
    )
    add(
        "--out",
        type=file_path,
        default=Path("out/reproduce"),
        metavar="FOLDER",
        help="folder for the rows" + DEFAULT,
    )
    add("--only", metavar="NAME", help="run only the study of this name (default: all)")
    add_workers(parser)


def _reproduce(arguments: argparse.Namespace) -> int:
    from host_sim.base.atomic_file import write_bytes
    from host_sim.base.regular_file import read_text
    from host_sim.lab.study.document import fill

    a = arguments
    document = a.docs / _DOCUMENT
    try:
        asked = read_text(document, _SIZE_MAX)
    except FileNotFoundError:
        raise UsageError(f"there is no {document} to fill in; choose its folder with --docs") from None
    paths = sorted(
        path for path in a.studies.glob("*.toml") if f"{path.stem}.csv" in asked and a.only in (None, path.stem)
    )
    if not paths:
        raise UsageError(f"there is no study {a.only or ''} in {a.studies}".replace("  ", " "))
    for path in paths:
        _reproduce_study(path, arguments)
    write_bytes(document, fill(read_text(document, _SIZE_MAX), a.docs).encode())
    print(f"wrote     {document}")
    return 0


def _reproduce_study(path: Path, arguments: argparse.Namespace) -> None:
    from host_sim.lab.study.compare_command import of_fleets, of_study
    from host_sim.lab.study.document import TABLES, write_table
    from host_sim.lab.study.plan_file import read_plan
    from host_sim.lab.study.plots import draw_plots

    name, docs = path.stem, arguments.docs
    plan = read_plan(path)
    if plan.is_fleet:
        runs = f"{len(plan.conditions)} fleets"
        _, samples = of_fleets(path)
    else:
        runs = run_study(path, arguments.out / name, workers_of(arguments), arguments.chunk)
        _, samples = of_study(arguments.out / name)
    write_table(samples, docs / TABLES / f"{name}.csv")
    draw_plots(samples, docs / "images", f"{name}-", _PLOTS.get(name, ()))
    print(f"{name:9} {runs}", flush=True)
