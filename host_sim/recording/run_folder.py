"""The folder of a run's files, locked so that only one run at a time writes to it."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from host_sim.base.errors import UsageError
from host_sim.base.files import lock
from host_sim.base.system import open_to_lock


@contextmanager
def run_folder(path: Path) -> Iterator[None]:
    """Creates the folder if it does not exist, and keeps other runs out of it.

    Raises:
        UsageError: The folder cannot be created or locked, or another run is using it.
    """
    descriptor = _open(path)
    try:
        lock(descriptor, f"the folder {path}", "choose another with --out")
        yield
    finally:
        os.close(descriptor)


def _open(path: Path) -> int:
    try:
        path.mkdir(parents=True, exist_ok=True)
        return open_to_lock(path)
    except OSError as error:
        raise UsageError(f"cannot make the folder {path}: {error.strerror}; choose another with --out") from None
