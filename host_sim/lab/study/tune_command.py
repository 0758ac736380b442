"""`tools/octet tune`: tunes the parameters of a behaviour, and tests them on held-out seeds."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from host_sim.base.errors import UsageError
from host_sim.cli.parsing import DEFAULT, Subparsers, add_command, file_path, number, settings
from host_sim.cli.run_options import add_option
from host_sim.lab.study.study_command import add_workers, worker_stages, workers_of
from host_sim.protocol.words import PARAMETERS

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from host_sim.lab.study.sample import Sample
    from host_sim.lab.study.tuning import Piece, Settings

_EXAMPLES = """\
examples:
  tools/octet tune --profile searcher --goal time --world crowded     the searcher's parameters, in crowded worlds
  tools/octet tune --only turn_deg step_mm --body kit                 two parameters of article, for real wheels
  tools/run --set @out/tune/article.txt                               a run with the result

Run the same command again to resume a search that was stopped.
"""
HELD_OUT = 5_000_001
"""The first of the held-out seeds, which nothing else uses; a later one if the search itself uses so many."""


def add(commands: Subparsers) -> None:
    """Adds the command."""
    parser = add_command(
        commands,
        "tune",
        _tune,
        summary="tune the parameters of a behaviour",
        description="Tunes parameters by CMA-ES on fleets; compares the best with the defaults on held-out seeds.",
        epilog=_EXAMPLES,
        stages=lambda arguments: ["study", *worker_stages(arguments)],
    )
    for name in ("profile", "world", "body", "limit_s"):
        add_option(parser, name)
    add = parser.add_argument
    add("--goal", choices=("time", "finished"), default="time", help="what to improve" + DEFAULT)
    only = "parameters to search (default: all but those of the body)"
    add("--only", nargs="+", choices=PARAMETERS, metavar="NAME", help=only)
    add("--set", type=settings, action="append", default=[], metavar="NAME=VALUE", help="fix a parameter at a value")
    add("--environments", type=number(1, 1000), default=2, metavar="N", help="environments per seed" + DEFAULT)
    add("--trials", type=number(4, 100_000), default=200, metavar="N", help="number of settings to try" + DEFAULT)
    seeds = "seeds for a generation's best settings" + DEFAULT
    add("--seeds", type=number(3, 100_000), default=120, metavar="N", help=seeds)
    add("--held-out", type=number(2, 100_000), default=400, metavar="N", help="seeds for the comparison" + DEFAULT)
    add("--out", type=file_path, default=Path("out/tune"), metavar="FOLDER", help="folder for the results" + DEFAULT)
    add_workers(parser)


def _tune(arguments: argparse.Namespace) -> int:
    from host_sim.base.files import run_folder, write_bytes
    from host_sim.base.terminal import ProgressLine
    from host_sim.lab.study.tuning import OF_THE_BODY, Search, SearchTask, samples_of
    from host_sim.lab.workers import run_all
    from host_sim.sim.run_config import RunConfig

    a, fixed = arguments, {name: value for each in arguments.set for name, value in each.items()}
    wanted = dict.fromkeys(a.only or (name for name in PARAMETERS if name not in OF_THE_BODY))
    names = [name for name in wanted if name not in fixed]
    if not names:
        raise UsageError("nothing to tune: --set fixes every parameter of --only")
    workers = workers_of(a)
    config = RunConfig(
        seed=1,
        environments=a.environments,
        profile=a.profile,
        world=a.world,
        body=a.body,
        limit_s=a.limit_s,
        settings=fixed,
    )

    def run(pieces: "Sequence[Piece]") -> "Iterator[Sequence[tuple[Piece, Sample]]]":
        from host_sim.lab.study.tuning import run_pieces

        return run_all(run_pieces, pieces, workers, a.chunk)

    with run_folder(a.out):
        search = Search(SearchTask(config, a.goal, names, a.seeds), run, a.out / f"{a.profile}.jsonl")
        with ProgressLine(a.trials) as line:
            search.go(a.trials, lambda done: line.show("settings", done))
        first, last = search.seeds
        print(f"searched  {len(names)} parameters of {a.profile} on seeds {first}..{last}")
        if not search.best:
            print("found     nothing better than the defaults")
            return 0
        without = [tuple(it for it in search.best if it != one) for one in search.best]
        held_out = max(HELD_OUT, last + 1)
        samples = samples_of(config, [(), search.best, *without], held_out, a.held_out, run)
        path = a.out / f"{a.profile}.txt"
        write_bytes(path, _preset(search.best, f"{config.command()}: chosen on seeds {first}..{last}").encode())
        print(_report(samples, search.best))
        print(f"wrote     {path}\ntry it    tools/run --profile {a.profile} --set @{path}")
    return 0


def _preset(best: "Settings", about: str) -> str:
    return "".join([f"# {about}\n", *(f"{name}={value}\n" for name, value in best)])


def _report(samples: "Sequence[Sample]", best: "Settings") -> str:
    """Compares the best settings with the defaults, and with themselves without each parameter."""
    from host_sim.lab.study.figures import FIGURES, compare, estimate
    from host_sim.lab.study.table import compared, text_of
    from host_sim.lab.table import aligned

    defaults, found, *without = samples
    lines = [f"found     {found.name}", f"held out  seeds {found.seeds[0]}..{found.seeds[-1]}, by the defaults"]
    for figure in (FIGURES[name] for name in ("mean_s", "median_s", "finished", "bumped")):
        values = (text_of(figure, estimate(figure, it, resamples=1).value) for it in (found, defaults))
        difference = compared(figure, compare(figure, found, defaults))
        lines.append(f"          {figure.heading}: {' by '.join(values)}, {difference}")
    mean = FIGURES["mean_s"]
    rows = [
        (f"          {name}={value}", f"without it, mean {compared(mean, compare(mean, it, found))}")
        for (name, value), it in zip(best, without, strict=True)
    ]
    return "\n".join([*lines, "worth", *aligned(rows)])
