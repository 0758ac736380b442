"""Prints how the robot fares on wheels that follow late: a minute for each lag, delay and slack.

.venv/bin/python -m tests.firmware.motion.wheel_sweep
"""

import argparse
import sys
from collections.abc import Iterator, Sequence
from functools import cache
from math import pi
from typing import NamedTuple

from tests.firmware.octet_c import ROOT, declarations, load

LAGS_MS = (0, 5, 10, 15, 20, 30, 40, 60, 80, 100)
DELAYS_TICKS = (0, 1, 2)
SLACKS_DEG = (0, 1, 2, 3)
WHEEL_MM = 42
MINUTE_TICKS = 3000
TOO_LATE_MS = 300
_ADAPTIVE = 6


class Figures(NamedTuple):
    """What came of some runs: sums, and the worst of each angle.

    Attributes:
        actions: The fewest that were done in a minute.
        denied: Actions that the wheels were found not to have carried out.
        stopped: Runs that ended with the robot stopped.
        lessons: Cells that were learned.
        over_deg: Farthest beyond the end of a turn.
        off_deg: Greatest error of heading at the end of a turn that is judged by it, with what the gears hide.
    """

    actions: int
    denied: int
    stopped: int
    lessons: int
    over_deg: float
    off_deg: float


@cache
def _interface():
    ffi, library = load()
    ffi.cdef(declarations(ROOT / "tests/firmware/motion/wheel_run.h"))
    return ffi, library


def run(lag_ms: float, delay_ticks: int, slack_deg: float = 0, seed: int = 1) -> Figures:
    """A minute of an `adaptive` robot on such wheels; slack is an angle of the wheel."""
    ffi, library = _interface()
    slack_mm = slack_deg / 180 * pi * WHEEL_MM / 2
    traits = ffi.new("struct wheel_traits *")
    traits.lag_ms, traits.slack_mm, traits.gain, traits.delay_ticks = lag_ms, slack_mm, 1, delay_ticks
    came = library.wheel_run(_ADAPTIVE, seed, MINUTE_TICKS, traits)
    return Figures(came.actions, came.denied, came.stopped_tick >= 0, came.lessons, came.over_deg, came.slack_deg)


def together(runs: Sequence[Figures]) -> Figures:
    """The sums and the worst of several runs."""
    each = Figures(*zip(*runs, strict=True))
    totals = sum(each.denied), sum(each.stopped), sum(each.lessons)
    return Figures(min(each.actions), *totals, max(each.over_deg), max(each.off_deg))


def lines(seeds: int, lags_ms: Sequence[float] = (*LAGS_MS, TOO_LATE_MS)) -> Iterator[str]:
    """The table as it stands in docs/bodies.md: for each lag all delays, slacks and seeds together."""
    yield "| lag | actions, by delay of 0 / 1 / 2 ticks | denied | stopped | beyond the end | error at the end |"
    yield "|---|---|---|---|---|---|"
    for lag_ms in lags_ms:
        by_delay = [
            together([run(lag_ms, delay, slack, seed) for slack in SLACKS_DEG for seed in range(1, seeds + 1)])
            for delay in DELAYS_TICKS
        ]
        of = together(by_delay)
        runs = len(DELAYS_TICKS) * len(SLACKS_DEG) * seeds
        actions = " / ".join(str(figures.actions) for figures in by_delay)
        angles = f"{of.over_deg:.1f} | {of.off_deg:.1f}"
        yield f"| {lag_ms} ms | {actions} | {of.denied} | {of.stopped} of {runs} | {angles} |"


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, default=10, metavar="N", help="seeds for each cell (default: 10)")
    for line in lines(parser.parse_args().seeds):
        sys.stdout.write(line + "\n")


if __name__ == "__main__":
    main()
