"""Start time of a run, and memory of a long run."""

import os
import subprocess
import sys
from tempfile import TemporaryDirectory

from host_sim.base.paths import ROOT
from host_sim.lab.bench.figure import Figure, most_figure

_STARTS = 10
_RATIO_MAX = 1.6
_NUMPY = "import time, numpy; print(1000 * time.process_time())"


def start_figure() -> Figure:
    """Processor time up to the first tick of a run in one process, compared with starting Python with numpy."""
    with TemporaryDirectory() as folder:
        # In turn, so that both run under the same load.
        pairs = [(_ms("-m", "host_sim.lab.bench.first_tick", folder), _ms("-c", _NUMPY)) for _ in range(_STARTS)]
    ours, numpy = (min(column) for column in zip(*pairs, strict=True))
    return Figure(
        name="processor time until the first tick",
        value=round(ours),
        unit="ms",
        bar="",
        reached=ours <= _RATIO_MAX * numpy,
        bound="imports, and reading the C code's interface",
        reference=f"Python with numpy: {numpy:.0f} ms",
        ratio=round(ours / numpy, 2),
        ratio_bar=f"<= {_RATIO_MAX}",
    )


def _ms(*arguments: str) -> float:
    command = [sys.executable, *arguments]
    return float(subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout)


_ENVIRONMENTS = 1000
_MB_MAX = 150.0


def memory_figure() -> Figure:
    """Peak memory of a run of a thousand environments, including its page and picture."""
    with TemporaryDirectory() as folder:
        options = ["run", "--bus", "none", "--environments", str(_ENVIRONMENTS), "--quiet", "--out", folder]
        process = os.spawnv(os.P_NOWAIT, sys.executable, [sys.executable, "-m", "host_sim", *options])
        _, status, usage = os.wait4(process, 0)
    if status:
        raise ChildProcessError(f"the run of {_ENVIRONMENTS} environments ended with {status}")
    name = f"memory of a run of {_ENVIRONMENTS} environments"
    return most_figure(name, usage.ru_maxrss / 1024, "MB", _MB_MAX, "the ticks that page and picture show")
