"""The learner as a Markov chain, with a race of two clocks for each cell: the table of docs/learning.md.

A trial at a pattern is to the left or to the right, each equally likely, and helps with a chance of that side and
pattern. The first side that helps is kept for ever. So the two chances predict how often each side is kept, and how
often the first trial helps. The chances are estimated from some robots, and the predictions tested on others.

.venv/bin/python -m host_sim.lab.study.clocks              500 robots to estimate, 500 others to test
.venv/bin/python -m host_sim.lab.study.clocks --seeds 50   fewer of each
"""

import argparse
import math
import os
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from host_sim.lab.study.claims import STUDY, Life, measured
from host_sim.lab.study.figures import wilson
from host_sim.lab.study.plan import Plan, read_plan
from host_sim.lab.table import markdown
from host_sim.protocol.generated import CELL_COUNT, Side

FIRST_SEED, SEEDS = 2_200_001, 500


class Clocks(NamedTuple):
    """The two clocks of a cell.

    Attributes:
        left: Chance that a trial to the left helps; 0 if there was none.
        right: The same to the right.
    """

    left: float
    right: float

    @property
    def left_wins(self) -> float:
        """How often the cell is left, 0 to 1, NaN if no trial helped: those to both sides are equally likely."""
        return self.left / both if (both := self.left + self.right) else math.nan

    @property
    def first_helps(self) -> float:
        """How often the first trial helps, as every other one, 0 to 1."""
        return (self.left + self.right) / 2


def clocks_of(lives: Sequence[Life], cell: int) -> Clocks:
    """The clocks of a cell, estimated from robots: of all trials to a side, the part that helped."""
    sides = [side for life in lives for pattern, side in life.tried if pattern == cell]
    kept = [life.memories[-1][cell] for life in lives]
    left, right = (kept.count(side) / max(1, sides.count(side)) for side in (Side.LEFT, Side.RIGHT))
    return Clocks(left, right)


def left_of(lives: Sequence[Life], cell: int) -> list[bool]:
    """For each robot that has learned a cell, whether it is left."""
    return [life.memories[-1][cell] == Side.LEFT for life in lives if life.memories[-1][cell]]


def first_helped(lives: Sequence[Life], cell: int) -> list[bool]:
    """For each robot that has tried something at a pattern, whether its first trial helped: it never tried again."""
    tried = [(sum(pattern == cell for pattern, _ in life.tried), life.memories[-1][cell]) for life in lives]
    return [count == 1 and bool(kept) for count, kept in tried if count]


def rows_of(estimated_from: Sequence[Life], tested_on: Sequence[Life]) -> Iterator[list[str]]:
    """A row for each cell: its clocks, then their predictions, each beside the result of the other robots."""
    for cell in range(1, CELL_COUNT):
        clocks = clocks_of(estimated_from, cell)
        left, first = left_of(tested_on, cell), first_helped(tested_on, cell)
        predicted = (*clocks, clocks.left_wins, clocks.first_helps)
        left_chance, right_chance, wins, helps = (f"{100 * it:.1f} %" for it in predicted)
        yield [str(cell), left_chance, right_chance, wins, _share(left), helps, _share(first), str(len(left))]


def _share(truths: Sequence[bool]) -> str:
    if not truths:
        return "-"
    value, low, high = (100 * it for it in wilson(np.array(truths, np.float64)[:, np.newaxis]))
    return f"{value:.1f} % ({low:.1f}..{high:.1f})"


HEADINGS = [
    *("cell", "left helps", "right helps", "left, predicted", "left, seen"),
    *("first helps, predicted", "first helps, seen", "robots that know it"),
]


def table_of(estimated_from: Sequence[Life], tested_on: Sequence[Life]) -> str:
    """The table in Markdown."""
    return markdown([HEADINGS, *rows_of(estimated_from, tested_on)])


def plan_of(seeds: int) -> Plan:
    """The article's robot with an ideal body on so many seeds for each half."""
    plan = read_plan(STUDY)
    return replace(plan, conditions=plan.conditions[:1], first_seed=FIRST_SEED, seeds=2 * seeds)


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    seeds = "seeds to estimate from, and again to test on"
    parser.add_argument("--seeds", type=int, default=SEEDS, metavar="N", help=seeds)
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, metavar="N", help="processes")
    arguments = parser.parse_args()
    plan = plan_of(arguments.seeds)
    (lives,) = measured(plan, arguments.jobs)
    first, last = plan.seeds_used
    middle = first + arguments.seeds
    print(f"estimated from seeds {first}..{middle - 1}, tested on {middle}..{last}; five environments each\n")
    print(table_of(lives[: arguments.seeds], lives[arguments.seeds :]))


if __name__ == "__main__":
    main()
