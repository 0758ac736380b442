"""Prints whether a motor that dies is noticed on wheels that answer late, and whether sound wheels are denied.

.venv/bin/python -m tests.runs.dead_motors
"""

import argparse
import sys
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from host_sim.api import RunConfig, run
from host_sim.protocol.generated import Reason

LAGS_MS = (0, 10, 20, 40, 60, 100)
DELAYS_TICKS = (0, 1, 2)
SEEDS = 20
DIES_S = 10.0
WITHIN_S = 3.0
MINUTE_S = 60.0
_TICK_S = 0.02


def stopped_s(seed: int, lag_ms: int, delay_ticks: int, *changes: str, limit_s: float = MINUTE_S) -> float | None:
    """When an `adaptive` robot stops by itself on such wheels, s of robot time; None: never."""
    late = (f"lag:{lag_ms}ms@0s", f"latency:{delay_ticks}@0s")
    config = RunConfig(
        seed=seed, environments=1, bus="none", profile="adaptive", limit_s=limit_s, changes=(*late, *changes)
    )
    ticks = run(config).ticks()
    stops = ticks["tick_number"][ticks["reason"] == Reason.STOP]
    return float(stops[0]) * _TICK_S if len(stops) else None


class Figures(NamedTuple):
    """What became of the seeds of a cell.

    Attributes:
        unnoticed: Robots that still ran `WITHIN_S` after their right motor had died.
        slowest_s: The longest that it took the others to stop.
        denied: Robots with sound motors that stopped within a minute.
    """

    unnoticed: int
    slowest_s: float
    denied: int


def figures(lag_ms: int, delay_ticks: int, seeds: int) -> Figures:
    """A cell of the table."""
    took, denied = [], 0
    for seed in range(1, seeds + 1):
        dead = stopped_s(seed, lag_ms, delay_ticks, f"weak-motor:right:0%@{DIES_S:g}s", limit_s=DIES_S + WITHIN_S)
        took += [] if dead is None else [dead - DIES_S]
        denied += stopped_s(seed, lag_ms, delay_ticks) is not None
    return Figures(seeds - len(took), max(took, default=0.0), denied)


def lines(seeds: int = SEEDS, lags_ms: Sequence[int] = LAGS_MS) -> Iterator[str]:
    """The table as it stands in docs/faults.md; each cell has delays of 0, 1 and 2 ticks."""
    yield "| lag | dead motors unnoticed | noticed after, at most | sound wheels denied |"
    yield "|---|---|---|---|"
    for lag_ms in lags_ms:
        cells = [figures(lag_ms, delay, seeds) for delay in DELAYS_TICKS]
        unnoticed = " / ".join(f"{cell.unnoticed}" for cell in cells)
        slowest = " / ".join(f"{cell.slowest_s:.1f} s" for cell in cells)
        denied = " / ".join(f"{cell.denied}" for cell in cells)
        yield f"| {lag_ms} ms | {unnoticed} | {slowest} | {denied} |"


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument(
        "--seeds", type=int, default=SEEDS, metavar="N", help=f"seeds for each cell (default: {SEEDS})"
    )
    for line in lines(parser.parse_args().seeds):
        sys.stdout.write(line + "\n")


if __name__ == "__main__":
    main()
