"""Makes the runs of a study in other processes, all with the same version of robot and world."""

from collections.abc import Callable, Iterator, Sequence
from typing import TypeVar

from host_sim.base.errors import OctetError
from host_sim.lab import workers as lab_workers
from host_sim.lab.study.atlas import SeedMap, map_of
from host_sim.lab.study.tables import Rows
from host_sim.lab.study.trial import Trial, run_trial
from host_sim.lab.study.version import code_version

Made = TypeVar("Made")


def run_chunk(trials: Sequence[Trial]) -> tuple[list[Rows], str]:
    """Makes runs in this process; returns them, and the version of the sources used."""
    return [run_trial(trial) for trial in trials], code_version()


def map_chunk(trials: Sequence[Trial]) -> tuple[list[SeedMap], str]:
    """Makes the runs of all memories in this process; otherwise as `run_chunk`."""
    return [map_of(trial) for trial in trials], code_version()


def run_all(
    work: Callable[[Sequence[Trial]], tuple[list[Made], str]],
    trials: Sequence[Trial],
    workers: lab_workers.Workers,
    chunk: int = 0,
) -> Iterator[Sequence[Made]]:
    """Makes runs; the other arguments and errors are those of `host_sim.lab.workers.run_all`.

    Args:
        work: `run_chunk` or `map_chunk`.
        trials: The runs to make.
        workers: The workers.
        chunk: Number of runs to hand over at once.

    Raises:
        OctetError: A worker is of another version.
    """
    for runs, code in lab_workers.run_all(work, trials, workers, chunk):
        if code != code_version():
            raise OctetError("a worker has another version of robot or world; finished runs are kept")
        yield runs
