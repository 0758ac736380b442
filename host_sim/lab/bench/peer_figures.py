"""Our speed compared with Enki, a fast robot simulator in C++, at the same work, in processor time."""

import os
import subprocess
import time
from pathlib import Path
from tempfile import TemporaryDirectory

from host_sim.base.errors import OctetError
from host_sim.base.paths import ROOT
from host_sim.lab.bench.figure import ROUNDS, Figure, Rate, rate_figure
from host_sim.lab.bench.fleet_figures import robot_ticks_per_second
from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig
from host_sim.world.layouts import Layout, generate
from host_sim.world.params import SimParams

_SOURCE = ROOT / "tools" / "reference" / "enki_peer.cpp"
_ARENAS, _TICKS, _FLEET = 10, 30_000, 1000
_PEER = "Enki, without firmware and food"


def peer_figures() -> list[Figure]:
    """All figures, measured in turn.

    Raises:
        OctetError: Enki is not installed.
    """
    params = SimParams()
    with TemporaryDirectory() as folder:
        program = _built(Path(folder) / "enki_peer")
        layouts = [generate(seed, 1, params) for seed in range(1, _FLEET + 1)]
        rounds = [
            (_enki(program, layouts[:_ARENAS], params), _ours(), robot_ticks_per_second(layouts, params))
            for _ in range(ROUNDS)
        ]
    enki, single, fleet = (max(column) for column in zip(*rounds, strict=True))
    return [
        rate_figure(Rate("one robot, without a log", single), Rate(_PEER, enki, 1.0), "the wire's checksums"),
        rate_figure(
            Rate("fleet of 1,000, each in its own world", fleet),
            Rate(f"one robot in {_PEER}", enki, 9.0),
            "trigonometry",
        ),
    ]


def _built(program: Path) -> Path:
    """Builds the Enki program of the comparison."""
    command = ["g++", "-std=c++14", "-O3", "-o", os.fspath(program), os.fspath(_SOURCE), "-lenki"]
    try:
        subprocess.run(command, check=True, capture_output=True)
    except (OSError, subprocess.CalledProcessError):
        raise OctetError("cannot build enki_peer: install g++ and libenki-dev with apt-get") from None
    return program


def _enki(program: Path, layouts: list[Layout], params: SimParams) -> float:
    """Ticks per second of Enki, in the same arenas."""
    return len(layouts) * _TICKS / sum(_enki_s(program, layout, params) for layout in layouts)


def _enki_s(program: Path, layout: Layout, params: SimParams) -> float:
    bars = [number for bar in layout.bars for point in bar for number in point]
    words = map(str, (_TICKS, params.width_mm, params.height_mm, *layout.start, *bars))
    return float(subprocess.run([program, *words], capture_output=True, text=True, check=True).stdout)


def _ours() -> float:
    """Ticks per second of the firmware and its world without a log, within its environments."""
    seconds, ticks = 0.0, 0
    for seed in range(1, _ARENAS + 1):
        with make(RunConfig(seed=seed, environments=1)) as simulation:
            simulation.enter(1)
            began = time.process_time()
            while not simulation.over:
                simulation.step(simulation.block_ticks)
            seconds += time.process_time() - began
            ticks += simulation.episode.ticks
    return ticks / seconds
