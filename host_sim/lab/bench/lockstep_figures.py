"""Speed of lockstep over a socket pair, over vcan, in one process and with emulated images; and of a run's start."""

import json
import os
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

import can

from host_sim.base.paths import BUILD, ROOT
from host_sim.client.frame_log import FrameLog
from host_sim.lab.bench.figure import Figure, Value, cost, rate
from host_sim.lab.bench.short_run import run_ticks
from host_sim.protocol.generated import PARAMETERS
from host_sim.recording.run_recorder import RunRecorder
from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig
from host_sim.sim.simulation import Simulation
from host_sim.world.names import FAST

_PINGPONG = os.fspath(BUILD / "host" / "tools" / "reference" / "octet-pingpong")
_VCAN = "socketcan:vcan0"
_TURNS, _VCAN_TURNS = 20_000, 2_000
_VCAN_LIMIT_S, _WHOLE_S = 60.0, 600.0
_REAL_TIME_PER_S = 50.0
_SEED, _BOARD = 1, "feather_stm32f405"
_IMAGE_TICKS = {"emulated": 10_000, "qemu": 2000}
_NUMPY = "import time, numpy; print(1000 * time.process_time())"


def lockstep_figures() -> list[Figure]:
    """The rows of one robot, without vcan."""
    with TemporaryDirectory() as folder, on_one_processor():
        first_tick = partial(_ms, "-m", "host_sim.lab.bench.first_tick", folder)
        start = Value("processor time until the first tick", first_tick)
        # On one processor: across processors, idle states would dominate a frame's time.
        pair = Value("lockstep over a socket pair", partial(_ticks_per_second, "fd", _WHOLE_S))
        rows = [
            cost(start, Value("Python with numpy", partial(_ms, "-c", _NUMPY)), 1.6),
            rate(pair, Value("C ping-pong over a socket pair", _c_turns_per_second), 0.7),
        ]
    within = Value("in process, with log and trajectory", partial(_recorded_ticks_per_second, True))
    in_python = Value("the same in Python", partial(_recorded_ticks_per_second, False))
    emulated = Value("CAN image on an emulated board", partial(_image_ticks_per_second, "emulated"))
    qemu = Value("slcan image in QEMU", partial(_image_ticks_per_second, "qemu"))
    real_time = Value("real time", lambda: _REAL_TIME_PER_S)
    return [*rows, rate(within, in_python, 12), rate(emulated, real_time, 160), rate(qemu, real_time, 4)]


def vcan_figure() -> Figure:
    """Lockstep on vcan0, which must exist."""
    ours = Value("lockstep over vcan", partial(_ticks_per_second, _VCAN, _VCAN_LIMIT_S))
    return rate(ours, Value("python-can with a C echo", _python_can_turns_per_second), 2)


def vcan_figure_elsewhere() -> Figure:
    """The same in a process that has a vcan0."""
    command = [os.fspath(ROOT / "tools" / "with-vcan"), sys.executable, "-m", "host_sim.lab.bench", "--vcan"]
    (row,) = json.loads(subprocess.run(command, stdout=subprocess.PIPE, text=True, check=False).stdout)
    return Figure(**row)


@contextmanager
def on_one_processor() -> Iterator[None]:
    """Keeps this process, and those that it starts, on one processor."""
    before = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {max(before)})
    try:
        yield
    finally:
        os.sched_setaffinity(0, before)


def _ms(*arguments: str) -> float:
    command = [sys.executable, *arguments]
    return float(subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout)


def _recorded_ticks_per_second(native: bool) -> float:
    def prepare(simulation: Simulation) -> None:
        simulation.native = native
        RunRecorder.of(simulation, PARAMETERS["boredom_limit"].default)

    return _ticks_per_second("none", _WHOLE_S, prepare)


def _image_ticks_per_second(robot: str) -> float:
    """Ticks per second of a whole run with physics and log."""
    ticks, config = _IMAGE_TICKS[robot], RunConfig(seed=_SEED, robot=robot, board=_BOARD)
    with TemporaryDirectory() as folder:
        began = time.perf_counter()
        run_ticks(config, ticks, FrameLog(Path(folder) / "run.log"))
        return ticks / (time.perf_counter() - began)


def _ticks_per_second(bus: str, limit_s: float, prepare: Callable[[Simulation], object] = lambda _: None) -> float:
    """Ticks per second in lockstep with a log, from the first tick of each environment to its last."""
    config = RunConfig(seed=_SEED, environments=3, limit_s=limit_s, bus=bus, physics=FAST)
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
    with ours, theirs:
        echo_command = [_PINGPONG, "echo", f"fd:{theirs.fileno()}"]
        with subprocess.Popen(echo_command, pass_fds=[theirs.fileno()], stdout=subprocess.DEVNULL) as echo:
            ping_command = [_PINGPONG, "ping", f"fd:{ours.fileno()}", str(_TURNS * 2)]
            fds = [ours.fileno()]
            ping = subprocess.run(ping_command, pass_fds=fds, capture_output=True, text=True, check=True)
            echo.terminate()
    return 1e6 / float(ping.stdout)


def _python_can_turns_per_second() -> float:
    """Turns per second of python-can and a C echo on vcan0."""
    message = can.Message(arbitration_id=0x0C1, data=bytes(8), is_extended_id=False)
    with (
        subprocess.Popen([_PINGPONG, "echo", _VCAN], stdout=subprocess.PIPE) as echo,
        can.Bus("vcan0", "socketcan") as bus,
    ):
        assert echo.stdout is not None
        echo.stdout.readline()
        began = time.perf_counter()
        for _ in range(_VCAN_TURNS):
            bus.send(message)
            bus.recv(5.0)
        seconds = time.perf_counter() - began
        echo.terminate()
    return _VCAN_TURNS / seconds
