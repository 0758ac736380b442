"""`tools/bench`: how fast it all is, each figure beside a reference measured in the same run on the same machine."""

import argparse
import json
import os
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from dataclasses import asdict, dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import can

from host_sim.commands.equality import compare
from host_sim.commands.run_options import BOARDS
from host_sim.commands.short_run import run_ticks
from host_sim.paths import ROOT
from host_sim.robots.connection import connect
from host_sim.wire.lockstep import Lockstep
from host_sim.wire.protocol import Protocol
from host_sim.wire.record import Recorder
from host_sim.wire.session import Session
from host_sim.world.arena import Arena
from host_sim.world.environment import World, generate
from host_sim.world.simulation import Simulation

_REFERENCE = ROOT / "build" / "host" / "tools" / "reference"
_WITH_VCAN = ROOT / "tools" / "with-vcan"
_VCAN = "socketcan:vcan0"
_ROUNDS = 20_000
_VCAN_ROUNDS = 2_000
_LIMIT_S = 60.0
_SEED = 1
_IMAGE_TICKS = 2000
_EQUAL_SEEDS, _EQUAL_TICKS = 20, 10_000


@dataclass(frozen=True)
class Figure:
    """One measured figure.

    Attributes:
        name: What was measured.
        value: How much.
        unit: Of value and of bar.
        bar: What is to be reached.
        reference: What it is held against; empty if nothing is.
        ratio: Value by that of the reference; None without one.
        ratio_bar: What the ratio is to reach; None if it may be anything.
        bound: What bounds it.
    """

    name: str
    value: float
    unit: str
    bar: str
    reference: str
    ratio: float | None
    ratio_bar: float | None
    reached: bool
    bound: str


def ticks_per_second(bus: str, limit_s: float = _LIMIT_S) -> float:
    """Lockstep with physics and log, over a bus: ticks by wall time, from the first tick to the last."""
    with TemporaryDirectory() as folder, ExitStack() as stack:
        recorder = Recorder(Path(folder) / "run.log")
        stack.callback(recorder.close)
        connection = connect(stack, bus, "spawn", 1)
        session = Session(connection.link, Protocol(), recorder, status=connection.status)
        session.greet(5.0)
        session.start(_SEED, 0, {}, None)
        simulation = Simulation(World(), session, Lockstep(session), _SEED, 3, limit_s)
        began = time.perf_counter()
        ticks = sum(chapter.ticks for chapter in simulation.run())
        return ticks / (time.perf_counter() - began)


def arena_ticks_per_second() -> float:
    """The arena alone, its robot turning in place."""
    arena = Arena(generate(_SEED, 1, World()), World())
    began = time.perf_counter()
    for tick in range(_ROUNDS):
        arena.sense(tick)
        arena.move(200, -200)
    return _ROUNDS / (time.perf_counter() - began)


def c_rounds_per_second() -> float:
    """Two C processes taking turns on a socket pair: round trips a second."""
    ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    program = os.fspath(_REFERENCE / "octet-pingpong")
    with ours, theirs:
        echo_order = [program, "echo", f"fd:{theirs.fileno()}"]
        with subprocess.Popen(echo_order, pass_fds=[theirs.fileno()], stdout=subprocess.DEVNULL) as echo:
            ping_order = [program, "ping", f"fd:{ours.fileno()}", str(_ROUNDS * 2)]
            fds = [ours.fileno()]
            ping = subprocess.run(ping_order, pass_fds=fds, capture_output=True, text=True, check=True)
            echo.terminate()
    return 1e6 / float(ping.stdout)


def python_can_rounds_per_second() -> float:
    """python-can and a C echo taking turns on vcan0: round trips a second."""
    order = [os.fspath(_REFERENCE / "octet-pingpong"), "echo", _VCAN]
    message = can.Message(arbitration_id=0x0C1, data=bytes(8), is_extended_id=False)
    with subprocess.Popen(order, stdout=subprocess.PIPE) as echo, can.Bus("vcan0", "socketcan") as bus:
        assert echo.stdout is not None
        echo.stdout.readline()
        began = time.perf_counter()
        for _ in range(_VCAN_ROUNDS):
            bus.send(message)
            bus.recv(5.0)
        seconds = time.perf_counter() - began
        echo.terminate()
    return _VCAN_ROUNDS / seconds


def core_tick_ns() -> float:
    """One tick of the core, in C, natively."""
    done = subprocess.run([os.fspath(_REFERENCE / "octet-core-tick")], capture_output=True, text=True, check=True)
    return float(done.stdout)


def start_s() -> float:
    """From `tools/run` to the end of a run of one robot second: more than to its first tick."""
    with TemporaryDirectory() as folder:
        order = [f"{ROOT}/tools/run", "--environments", "1", "--limit-s", "1", "--quiet", "--out", folder]
        began = time.perf_counter()
        subprocess.run(order, check=True)
        return time.perf_counter() - began


def measure_vcan() -> dict[str, float]:
    """Reference and our own figure, where vcan0 exists; the best of three each, taken in turn."""
    pairs = [(python_can_rounds_per_second(), ticks_per_second(_VCAN, 20.0)) for _ in range(3)]
    return {"reference": max(reference for reference, _ in pairs), "ours": max(ours for _, ours in pairs)}


def compare_images() -> bool:
    """Long runs of the host build, of the QEMU image and of both emulated boards: are all frames the same?"""
    with TemporaryDirectory() as folder:
        differences = 0
        for seed, where, difference in compare(range(1, _EQUAL_SEEDS + 1), _EQUAL_TICKS, Path(folder)):
            print(f"seed {seed}, {_EQUAL_TICKS} ticks, {where}: {difference or 'equal'}", flush=True)
            differences += difference is not None
    return differences == 0


def _image_figure(robot: str, board: str = BOARDS[0]) -> Figure:
    """Lockstep with an image that is flashed, on a board that is not there."""
    with ExitStack() as stack, TemporaryDirectory() as folder:
        connection = connect(stack, "none", robot, 1, board=board)
        began = time.perf_counter()
        run_ticks(connection, _SEED, _IMAGE_TICKS, Path(folder) / "run.log")
        rate = _IMAGE_TICKS / (time.perf_counter() - began)
    name = "image in QEMU" if robot == "qemu" else f"image on an emulated {board}"
    bound = "bytes through QEMU's serial line" if robot == "qemu" else "Python, called for each register"
    ratio = round(rate / 50, 2)
    return Figure(name, round(rate), "ticks/s", ">= 200", "real time: 50/s", ratio, None, rate >= 200, bound)


def _vcan_figure() -> Figure:
    order = [os.fspath(_WITH_VCAN), sys.executable, "-m", "host_sim.commands.bench", "--vcan"]
    done = subprocess.run(order, capture_output=True, text=True, check=True)
    pair = json.loads(done.stdout)
    return _against(
        ("lockstep over vcan, with physics", pair["ours"], 0.0),
        ("python-can with a C echo", pair["reference"], 0.8),
        "two trips through the kernel's CAN stack a tick, and Python's",
    )


def _against(ours: tuple[str, float, float], reference: tuple[str, float, float], bound: str) -> Figure:
    """A figure in ticks a second, against a reference in the same unit; each with its bar."""
    name, value, bar = ours
    reference_name, reference_value, ratio_bar = reference
    ratio = value / reference_value
    return Figure(
        name=name,
        value=round(value),
        unit="ticks/s",
        bar=f">= {bar:.0f}" if bar else "",
        reference=f"{reference_name}: {reference_value:.0f}/s",
        ratio=round(ratio, 2),
        ratio_bar=ratio_bar or None,
        reached=value >= bar and ratio >= ratio_bar,
        bound=bound,
    )


def _best(measure: Callable[[], float]) -> float:
    """The best of three: the rest is what else the machine was doing."""
    return max(measure() for _ in range(3))


def measure_all() -> list[Figure]:
    """Every figure."""
    socket_pair = _best(lambda: ticks_per_second("fd")), _best(c_rounds_per_second)
    within = _best(lambda: ticks_per_second("none")), _best(arena_ticks_per_second)
    core_ns, to_start_s = core_tick_ns(), min(start_s() for _ in range(3))
    return [
        _against(
            ("lockstep over a socket pair, with physics", socket_pair[0], 5000),
            ("C ping-pong over a socket pair", socket_pair[1], 0.4),
            "waking two processes a tick, then Python",
        ),
        _vcan_figure(),
        _against(
            ("in process, with physics and log", within[0], 50_000),
            ("the arena alone", within[1], 0.0),
            "Python: arena, codec and log in equal parts",
        ),
        Figure("the core's tick, in C", core_ns, "ns", "< 100", "", None, None, core_ns < 100, "the processor"),
        *(_image_figure("emulated", board) for board in BOARDS),
        _image_figure("qemu"),
        Figure("tools/run, to its end", round(to_start_s, 2), "s", "< 2", "", None, None, to_start_s < 2, "imports"),
    ]


def table(figures: Sequence[Figure]) -> str:
    """The figures for people."""
    rows = [("figure", "measured", "bar", "reference", "ratio", "bar", "")]
    for figure in figures:
        ratio = "" if figure.ratio is None else f"{figure.ratio:.2f}"
        ratio_bar = "" if figure.ratio_bar is None else f">= {figure.ratio_bar}"
        measured = f"{figure.value:g} {figure.unit}"
        verdict = "reached" if figure.reached else "MISSED"
        rows.append((figure.name, measured, figure.bar, figure.reference, ratio, ratio_bar, verdict))
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return "\n".join("  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)) for row in rows)


def main(arguments: Sequence[str] | None = None) -> int:
    """Measures and tells; the exit code is 1 if a bar was missed."""
    parser = argparse.ArgumentParser(prog="tools/bench", description="Measures speed, each beside a reference.")
    parser.add_argument("--json", action="store_true", help="print JSON, not a table")
    parser.add_argument("--vcan", action="store_true", help="only the pair of figures for vcan0, which must exist")
    parser.add_argument("--equality", action="store_true", help="compare long runs of all images with the host's")
    options = parser.parse_args(arguments)
    if options.equality:
        return 0 if compare_images() else 1
    if options.vcan:
        print(json.dumps(measure_vcan()))
        return 0
    figures = measure_all()
    print(json.dumps([asdict(figure) for figure in figures], indent=2) if options.json else table(figures))
    return 0 if all(figure.reached for figure in figures) else 1


if __name__ == "__main__":
    sys.exit(main())
