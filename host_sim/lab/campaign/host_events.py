"""Events of processes and of the wall clock, and a run in a process of its own that is killed midway."""

import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Mapping
from contextlib import ExitStack, suppress
from itertools import chain, repeat
from multiprocessing import Pipe, get_context
from multiprocessing.connection import Connection
from pathlib import Path
from types import FrameType
from typing import Any

from host_sim.base.errors import RobotError

Trigger = Callable[[int], None]
"""Triggers an event of a given size."""


def process_events(pid: Callable[[], int]) -> Mapping[str, Trigger]:
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


def clock_events(undo: ExitStack) -> Mapping[str, Trigger]:
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


_TRACED = (str(Path(__file__).parents[2]), tempfile.__file__)


def before_each_instruction(action: Callable[[], None]) -> None:
    """Calls a function before each Python instruction of this package, from now on and in this thread.

    Functions already running are not traced, but those that they call are. `sys.settrace(None)` ends tracing.
    """

    def trace(frame: FrameType, event: str, _: Any) -> Any:
        if event == "opcode":
            action()
        elif event == "call":
            if not frame.f_code.co_filename.startswith(_TRACED):
                return None
            frame.f_trace_opcodes = True
        return trace

    sys.settrace(trace)


SILENT_S = 60.0
"""A run without a report for this time, s, is taken to hang."""

ASK = "ask"
"""First word of a report by which a run requests an event from its parent process."""

Report = Callable[..., None]
"""Sends a report from a run that may be killed at any time: numbers, strings and lists of them."""


def kill_at(number: int) -> None:
    """Sends SIGKILL to this process before the nth of its Python instructions from now on, counted from 1."""
    left = number

    def count() -> None:
        nonlocal left
        left -= 1
        if left <= 0:
            os.kill(os.getpid(), signal.SIGKILL)

    before_each_instruction(count)


def run_killable(run: Callable[[Report], None], perform: Callable[[str, int], None]) -> tuple[bool, list[list[Any]]]:
    """Runs a function in a process of its own.

    Args:
        run: The function. Its reports must not be further apart than `SILENT_S`.
        perform: Called in this process with the other words of each report that begins with `ASK`.

    Returns:
        Whether it was killed, and its reports; the last one says if it hung.
    """
    ours, its = Pipe(duplex=False)
    child = get_context("fork").Process(target=_run_to_the_end, args=(run, its))
    child.start()
    its.close()
    reports: list[list[Any]] = []
    with ours, suppress(EOFError):
        while ours.poll(SILENT_S):
            words = ours.recv()
            if words[0] == ASK:
                perform(*words[1:])
            else:
                reports.append(words)
        reports.append(["broke", f"the simulator hung for {SILENT_S:g} s"])
        assert child.pid is not None
        os.kill(child.pid, signal.SIGABRT)  # not the signal of an event
    child.join()
    return child.exitcode == -signal.SIGKILL, reports


def _run_to_the_end(run: Callable[[Report], None], pipe: Connection) -> None:
    """Runs the function. A report is sent by one system call, so that it is complete or missing."""

    def report(*words: object) -> None:
        pipe.send([*words])

    try:
        run(report)
    except Exception as error:
        report("ended" if isinstance(error, RobotError) else "broke", f"{type(error).__name__}: {error}")
