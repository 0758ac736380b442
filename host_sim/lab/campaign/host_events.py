"""Events of a robot's process, of the simulator's process, and of the wall clock as read by the latter."""

import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Mapping
from contextlib import ExitStack, suppress
from itertools import chain, repeat

from host_sim.lab.campaign.setup import Happen


def process_events(pid: Callable[[], int]) -> Mapping[str, Callable[[int], None]]:
    """The events of a process on this host, given by a function that returns its process ID."""
    return {
        "kill": lambda _: os.kill(pid(), signal.SIGKILL),
        "crash": lambda _: os.kill(pid(), signal.SIGSEGV),
        "hang": lambda span_ms: hang(pid(), span_ms),
        "hold-up": hold_up,
    }


def hang(pid: int, span_ms: int) -> None:
    """Sends SIGSTOP, and SIGCONT after a span."""
    os.kill(pid, signal.SIGSTOP)

    def go_on() -> None:
        with suppress(ProcessLookupError):
            os.kill(pid, signal.SIGCONT)

    timer = threading.Timer(span_ms / 1000, go_on)
    timer.daemon = True
    timer.start()


def hold_up(span_ms: int) -> None:
    """A helper process sends this one SIGSTOP, and SIGCONT after a span: in this order, however busy the host is."""
    stopped = f"kill -STOP {os.getpid()}; sleep {span_ms / 1000}; kill -CONT {os.getpid()}"
    subprocess.run(["/bin/sh", "-c", stopped], check=True)


CLOCK_EVENTS = frozenset({"clock-ahead", "clock-back"})
"""The events of the wall clock, by name."""


def clock_events(undo: ExitStack) -> Mapping[str, Happen]:
    """Events that set the clock ahead or back by some seconds; `undo` restores it."""
    return {"clock-ahead": lambda span_s: _step(span_s, undo), "clock-back": lambda span_s: _step(-span_s, undo)}


def _step(span_s: int, undo: ExitStack) -> None:
    """Shifts the clock for all modules, including libraries: after the next reading, as if during a wait."""
    seconds, nanoseconds = time.time, time.time_ns
    shift_s, shift_ns = chain([0], repeat(span_s)), chain([0], repeat(span_s * 10**9))
    _replace(seconds, lambda: seconds() + next(shift_s), undo)
    _replace(nanoseconds, lambda: nanoseconds() + next(shift_ns), undo)


def _replace(old: Callable[[], object], new: Callable[[], object], undo: ExitStack) -> None:
    for module in tuple(sys.modules.values()):
        names = [name for name, value in vars(module).items() if value is old]
        for name in names:
            undo.callback(setattr, module, name, old)
            setattr(module, name, new)
