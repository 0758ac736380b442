"""Makes the runs of a study in other processes, all with the same version of robot and world."""

from collections.abc import Iterator, Sequence

from host_sim.base.errors import OctetError
from host_sim.lab import workers as of_lab
from host_sim.lab.study.trial import Run, Trial, run_trial
from host_sim.lab.study.version import code_version


def run_chunk(trials: Sequence[Trial]) -> tuple[list[Run], str]:
    """Makes runs in this process; returns them, and the version of the sources used."""
    return [run_trial(trial) for trial in trials], code_version()


def run_all(trials: Sequence[Trial], workers: of_lab.Workers, chunk: int = 0) -> Iterator[Sequence[Run]]:
    """Makes runs; arguments and errors are those of `host_sim.lab.workers.run_all`.

    Raises:
        OctetError: A worker is of another version.
    """
    for runs, code in of_lab.run_all(run_chunk, trials, workers, chunk):
        if code != code_version():
            raise OctetError("a worker has another version of robot or world; finished runs are kept")
        yield runs
