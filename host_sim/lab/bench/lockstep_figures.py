"""Speed of lockstep over a socket pair, over vcan, and in one process."""

import json
import os
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

import can

from host_sim.base.paths import BUILD, ROOT
from host_sim.client.frame_log import FrameLog
from host_sim.lab.bench.figure import ROUNDS, Figure, Rate, best, most_figure, rate_figure
from host_sim.protocol.generated import PARAMETERS
from host_sim.recording.run_recorder import RunRecorder
from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig
from host_sim.sim.simulation import Simulation
from host_sim.world.physics_names import FAST, PHYSICS, PYMUNK

_REFERENCE = BUILD / "host" / "tools" / "reference"
_VCAN = "socketcan:vcan0"
_TURNS, _VCAN_TURNS = 20_000, 2_000
_VCAN_LIMIT_S, _WHOLE_S = 60.0, 600.0
_SEED = 1


def lockstep_figures() -> list[Figure]:
    """All figures for lockstep, for the core alone, and for the start of a run."""
    return [
        _socket_pair_figure(),
        *_vcan_figures(),
        _in_process_figure(),
        most_figure("a tick in process, one per call", _lone_tick_us(), "us", 5, "what Python does per block"),
        most_figure("the core's tick, in C", _core_tick_ns(), "ns", 100, "the processor"),
        most_figure("tools/run, one robot second, to its end", _start_s(), "s", 2, "importing Python's packages"),
        most_figure(
            "tools/setup with nothing to do",
            _shortest_s(f"{ROOT}/tools/setup"),
            "s",
            0.3,
            "asking ninja, and hashes of a few files",
        ),
    ]


def _socket_pair_figure() -> Figure:
    """Both measured in turn on one processor: across processors, idle states would dominate a frame's time."""
    with on_one_processor():
        pairs = [(_c_turns_per_second(), _ticks_per_second("fd", _WHOLE_S)) for _ in range(ROUNDS)]
    return rate_figure(
        Rate("lockstep over a socket pair", max(ours for _, ours in pairs), 5000),
        Rate("C ping-pong over a socket pair", max(reference for reference, _ in pairs), 0.7),
        "waking two processes a tick",
    )


@contextmanager
def on_one_processor() -> Iterator[None]:
    """Keeps this process, and those that it starts, on one processor."""
    before = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {max(before)})
    try:
        yield
    finally:
        os.sched_setaffinity(0, before)


def measure_vcan() -> dict[str, float]:
    """Ticks per second on vcan0 of python-can and of our loop with each physics: the best of `ROUNDS`, in turn."""
    rounds = [
        {
            "reference": _python_can_turns_per_second(),
            **{physics: _ticks_per_second(_VCAN, _VCAN_LIMIT_S, physics=physics) for physics in PHYSICS},
        }
        for _ in range(ROUNDS)
    ]
    return {name: max(one[name] for one in rounds) for name in rounds[0]}


def _in_process_figure() -> Figure:
    """The loop in C compared with the one in Python, measured in turn."""
    pairs = [
        [_ticks_per_second("none", _WHOLE_S, _recorded(native)) for native in (True, False)] for _ in range(ROUNDS)
    ]
    return rate_figure(
        Rate("in process, with log and trajectory", max(in_c for in_c, _ in pairs), 500_000),
        Rate("the same in Python", max(in_python for _, in_python in pairs), 12),
        "recording",
    )


def _lone_tick_us() -> float:
    """The shortest time of a tick in blocks of one, as for a page that follows each decision, us."""

    def prepare(simulation: Simulation) -> None:
        _recorded(True)(simulation)
        simulation.block_ticks = 1

    return 1e6 / best(lambda: _ticks_per_second("none", 60.0, prepare))


def _recorded(native: bool) -> Callable[[Simulation], object]:
    def prepare(simulation: Simulation) -> None:
        simulation.native = native
        RunRecorder.of(simulation, PARAMETERS["boredom_limit"].default)

    return prepare


def _vcan_figures() -> list[Figure]:
    command = [os.fspath(ROOT / "tools" / "with-vcan"), sys.executable, "-m", "host_sim.lab.bench", "--vcan"]
    rates = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
    reference, why = "python-can with a C echo", "two trips through the kernel's CAN stack a tick"
    return [
        rate_figure(
            Rate("lockstep over vcan, with pymunk", rates[PYMUNK]),
            Rate(reference, rates["reference"], 1.7),
            f"{why}, and pymunk's step",
        ),
        rate_figure(Rate("the same with --physics fast", rates[FAST]), Rate(reference, rates["reference"], 2), why),
    ]


def _ticks_per_second(
    bus: str, limit_s: float, prepare: Callable[[Simulation], object] = lambda _: None, physics: str = FAST
) -> float:
    """Ticks per second in lockstep with a log, from the first tick of each environment to its last."""
    config = RunConfig(seed=_SEED, environments=3, limit_s=limit_s, bus=bus, physics=physics)
    with TemporaryDirectory() as folder, ExitStack() as stack:
        log = FrameLog(Path(folder) / "run.log")
        stack.callback(log.close)
        simulation = stack.enter_context(make(config, log))
        prepare(simulation)
        seconds = sum(_seconds_in(simulation, number) for number in range(1, config.environments + 1))
        return simulation.tick / seconds


def _seconds_in(simulation: Simulation, number: int) -> float:
    """The time taken by the ticks of an environment, s."""
    simulation.enter(number)
    began = time.perf_counter()
    while not simulation.over:
        simulation.step(simulation.block_ticks)
    seconds = time.perf_counter() - began
    simulation.leave()
    return seconds


def _c_turns_per_second() -> float:
    """Turns per second of two C processes on a socket pair."""
    ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    program = os.fspath(_REFERENCE / "octet-pingpong")
    with ours, theirs:
        echo_command = [program, "echo", f"fd:{theirs.fileno()}"]
        with subprocess.Popen(echo_command, pass_fds=[theirs.fileno()], stdout=subprocess.DEVNULL) as echo:
            ping_command = [program, "ping", f"fd:{ours.fileno()}", str(_TURNS * 2)]
            fds = [ours.fileno()]
            ping = subprocess.run(ping_command, pass_fds=fds, capture_output=True, text=True, check=True)
            echo.terminate()
    return 1e6 / float(ping.stdout)


def _python_can_turns_per_second() -> float:
    """Turns per second of python-can and a C echo on vcan0."""
    command = [os.fspath(_REFERENCE / "octet-pingpong"), "echo", _VCAN]
    message = can.Message(arbitration_id=0x0C1, data=bytes(8), is_extended_id=False)
    with subprocess.Popen(command, stdout=subprocess.PIPE) as echo, can.Bus("vcan0", "socketcan") as bus:
        assert echo.stdout is not None
        echo.stdout.readline()
        began = time.perf_counter()
        for _ in range(_VCAN_TURNS):
            bus.send(message)
            bus.recv(5.0)
        seconds = time.perf_counter() - began
        echo.terminate()
    return _VCAN_TURNS / seconds


def _core_tick_ns() -> float:
    command = [os.fspath(_REFERENCE / "octet-core-tick")]
    return float(subprocess.run(command, capture_output=True, text=True, check=True).stdout)


def _start_s() -> float:
    """Wall-clock time of a whole run of `tools/run` with one second of robot time, s."""
    with TemporaryDirectory() as folder:
        words = ("--environments", "1", "--limit-s", "1", "--quiet", "--out")
        return _shortest_s(f"{ROOT}/tools/run", *words, f"{folder}/out")


def _shortest_s(*command: str) -> float:
    """Wall-clock time of the fastest of `ROUNDS` calls of a command, s."""
    times_s = []
    for _ in range(ROUNDS):
        began = time.perf_counter()
        subprocess.run(command, check=True)
        times_s.append(time.perf_counter() - began)
    return min(times_s)
