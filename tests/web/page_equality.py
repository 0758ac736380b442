"""Holds runs in Node against those of tools/run, byte for byte: python -m tests.web.page_equality --seeds 20."""

import argparse
import sys
import tempfile
from pathlib import Path

from host_sim.protocol.generated import PROFILES
from tests.runs.support import octet
from tests.web.page_runs import experiment, run_in_page, words


def differing(folder: Path, profile: str, seed: int, environments: int) -> str:
    """What differs; empty if nothing does."""
    wanted = experiment(profile, seed, environments=environments, limit_ticks=30_000)
    done = octet("run", "--bus", "none", "--quiet", "--out", folder / "run", *words(wanted))
    if done.returncode != 0:
        return done.stderr
    (there,) = run_in_page(folder, wanted)
    pairs = zip(there["log"].splitlines(), (folder / "run/run.log").read_text().splitlines(), strict=False)
    lines = (f"line {i}: {here}, not {it}" for i, (here, it) in enumerate(pairs, 1) if here != it)
    return next(lines, "" if there["log"] == (folder / "run/run.log").read_text() else "another length")


def main() -> int:
    """Returns the number of runs that differ."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--environments", type=int, default=5)
    arguments = parser.parse_args()
    failed = 0
    for profile in PROFILES:
        for seed in range(1, arguments.seeds + 1):
            with tempfile.TemporaryDirectory() as folder:
                difference = differing(Path(folder), profile, seed, arguments.environments)
            failed += bool(difference)
            sys.stdout.write(f"{profile} {seed}: {difference or 'equal'}\n")
            sys.stdout.flush()
    sys.stdout.write(f"{failed} of {len(PROFILES) * arguments.seeds} runs differ\n")
    return failed


if __name__ == "__main__":
    sys.exit(main())
