"""Compares runs in Node or a browser with those of tools/run: python -m tests.web.sim.page_equality -h."""

import argparse
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from host_sim.protocol.generated import PROFILES
from tests.runs.support import octet
from tests.web.browsers import BROWSERS, launched
from tests.web.sim.page_runs import LOGS, experiment, page_file, run_in_page, words

NODE = "node"

LogOf = Callable[[dict[str, Any]], str]
"""The log of an experiment."""


@contextmanager
def page_in(where: str, folder: Path) -> Iterator[LogOf]:
    """What runs experiments: Node, or one of `BROWSERS`."""
    if where == NODE:
        yield lambda wanted: str(run_in_page(folder, wanted)[0]["log"])
        return
    with launched(where) as browser:
        page = browser.new_page()
        page.goto(page_file(folder).as_uri())
        yield lambda wanted: str(page.evaluate(LOGS, [wanted])[0])


def differing(folder: Path, log_of: LogOf, profile: str, seed: int, environments: int) -> str:
    """What differs; empty if nothing does."""
    wanted = experiment(profile, seed, environments=environments, limit_ticks=30_000)
    done = octet("run", "--bus", "none", "--quiet", "--out", folder / "run", *words(wanted))
    if done.returncode != 0:
        return done.stderr
    here, there = log_of(wanted), (folder / "run/run.log").read_text()
    pairs = zip(here.splitlines(), there.splitlines(), strict=False)
    lines = (f"line {i}: {ours}, not {theirs}" for i, (ours, theirs) in enumerate(pairs, 1) if ours != theirs)
    return next(lines, "" if here == there else "another length")


def main() -> int:
    """Returns the number of runs that differ."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--environments", type=int, default=5)
    parser.add_argument("--profiles", nargs="+", choices=PROFILES, default=PROFILES)
    parser.add_argument("--in", dest="where", choices=(NODE, *BROWSERS), default=NODE)
    arguments = parser.parse_args()
    failed = 0
    with tempfile.TemporaryDirectory() as folder, page_in(arguments.where, Path(folder)) as log_of:
        for profile in arguments.profiles:
            for seed in range(1, arguments.seeds + 1):
                difference = differing(Path(folder), log_of, profile, seed, arguments.environments)
                failed += bool(difference)
                sys.stdout.write(f"{profile} {seed}: {difference or 'equal'}\n")
                sys.stdout.flush()
    sys.stdout.write(f"{failed} of {len(arguments.profiles) * arguments.seeds} runs differ\n")
    return failed


if __name__ == "__main__":
    sys.exit(main())
