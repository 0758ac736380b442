"""Speed of the flash images in emulators, and comparison of their frames with the host's."""

import time
from pathlib import Path
from tempfile import TemporaryDirectory

from host_sim.backends.images import BOARDS
from host_sim.client.frame_log import FrameLog
from host_sim.lab.bench.equality import compare
from host_sim.lab.bench.figure import Figure, Rate, rate_figure
from host_sim.lab.bench.short_run import run_ticks
from host_sim.sim.run_config import RunConfig

_SEED = 1
_TICKS = {"emulated": 10_000, "qemu": 2000}
_EQUAL_SEEDS, _EQUAL_TICKS = 20, 10_000
_REAL_TIME = Rate("real time", 50)
_EMULATED_AT_LEAST, _QEMU_AT_LEAST = 8000, 200


def image_figures() -> list[Figure]:
    """Figures for lockstep with each image, in a whole run with physics and log."""
    emulated = [
        rate_figure(
            Rate(f"CAN image on an emulated {board}", _ticks_per_second("emulated", board), _EMULATED_AT_LEAST),
            _REAL_TIME,
            "the simulator's Python, and Unicorn",
        )
        for board in BOARDS
    ]
    in_qemu = Rate("slcan image in QEMU", _ticks_per_second("qemu", BOARDS[0]), _QEMU_AT_LEAST)
    return [*emulated, rate_figure(in_qemu, _REAL_TIME, "bytes going one by one through QEMU's serial line")]


def compare_images() -> bool:
    """Compares long runs in QEMU and on the emulated boards with the host's, and prints the results.

    Returns:
        Whether all frames are the same.
    """
    equal = True
    with TemporaryDirectory() as folder:
        for seed, where, difference in compare(range(1, _EQUAL_SEEDS + 1), _EQUAL_TICKS, Path(folder)):
            print(f"seed {seed}, {_EQUAL_TICKS} ticks, {where}: {difference or 'equal'}", flush=True)
            equal = equal and difference is None
    return equal


def _ticks_per_second(robot: str, board: str) -> float:
    with TemporaryDirectory() as folder:
        began = time.perf_counter()
        run_ticks(RunConfig(seed=_SEED, robot=robot, board=board), _TICKS[robot], FrameLog(Path(folder) / "run.log"))
        return _TICKS[robot] / (time.perf_counter() - began)
