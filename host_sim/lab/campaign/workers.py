"""Cells in several processes at once: those of one configuration stay together."""

from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

from host_sim.lab.campaign.cell import Cell
from host_sim.lab.campaign.outcome import Outcome
from host_sim.lab.campaign.running import run_all


def run_in_processes(groups: Sequence[Sequence[Cell]], count: int) -> Iterator[Outcome]:
    """The outcomes in the order of the cells.

    Args:
        groups: The cells; the first of each group has no fault.
        count: Number of processes.
    """
    with ProcessPoolExecutor(count, mp_context=get_context("spawn")) as pool:
        for outcomes in pool.map(_run, groups):
            yield from outcomes


def _run(cells: Sequence[Cell]) -> list[Outcome]:
    return list(run_all(cells))
