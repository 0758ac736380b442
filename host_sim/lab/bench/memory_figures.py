"""How much memory a long run takes."""

import os
import sys
from tempfile import TemporaryDirectory

from host_sim.lab.bench.figure import Figure, most_figure

_ENVIRONMENTS = 1000
_MB_MAX = 150.0


def memory_figure() -> Figure:
    """The greatest memory of a run of a thousand environments, its page and its picture included."""
    with TemporaryDirectory() as folder:
        options = ["run", "--bus", "none", "--environments", str(_ENVIRONMENTS), "--quiet", "--out", folder]
        process = os.spawnv(os.P_NOWAIT, sys.executable, [sys.executable, "-m", "host_sim", *options])
        _, status, usage = os.wait4(process, 0)
    if status:
        raise ChildProcessError(f"the run of {_ENVIRONMENTS} environments ended with {status}")
    name = f"memory of a run of {_ENVIRONMENTS} environments"
    return most_figure(name, usage.ru_maxrss / 1024, "MB", _MB_MAX, "the ticks that page and picture show")
