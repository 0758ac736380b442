"""A run in a process of its own that is killed midway, and its reports until then."""

import json
import os
import select
import signal
import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from types import FrameType
from typing import Any

from host_sim.base.errors import RobotError

_TRACED = (str(Path(__file__).parents[2]), tempfile.__file__)


def before_each_instruction(happen: Callable[[], None]) -> None:
    """Calls a function before each Python instruction of this package, from now on and in this thread.

    Functions already running are not traced, but those that they call are. `sys.settrace(None)` ends tracing.
    """

    def trace(frame: FrameType, event: str, _: Any) -> Any:
        if event == "opcode":
            happen()
        elif event == "call":
            if not frame.f_code.co_filename.startswith(_TRACED):
                return None
            frame.f_trace_opcodes = True
        return trace

    sys.settrace(trace)


SILENT_S = 60.0
"""A run that reports nothing for this long hangs."""

ASK = "ask"
"""First word of a report that asks the process that waits for the run to do something."""

_HUNG = ["broke", f"the simulator hung for {SILENT_S:g} s"]
_BLOCK = 65536

Tell = Callable[..., None]
"""Takes reports from a run that may be killed at any time: numbers, strings and lists of them."""


def kill_at(number: int) -> None:
    """Sends SIGKILL to this process before the nth of its Python instructions from now on, counted from 1."""
    left = number

    def count() -> None:
        nonlocal left
        left -= 1
        if left <= 0:
            os.kill(os.getpid(), signal.SIGKILL)

    before_each_instruction(count)


def run_to_be_killed(run: Callable[[Tell], None], asked: Callable[[str, int], None]) -> tuple[bool, list[list[Any]]]:
    """Runs a function in a process of its own.

    Args:
        run: The function. Its reports must not be further apart than `SILENT_S`.
        asked: Called in this process with the other words of each report that begins with `ASK`.

    Returns:
        Whether it was killed, and all that it reported, which tells if it hung.
    """
    ours, its = os.pipe()
    child = os.fork()
    if child == 0:
        _run_to_the_end(run, lambda *words: _write(its, words))
    os.close(its)
    told = []
    with os.fdopen(ours, "rb") as pipe:
        for words in _reports(pipe.fileno()):
            if words[0] == ASK:
                asked(*words[1:])
            else:
                told.append(words)
    if told and told[-1] == _HUNG:
        os.kill(child, signal.SIGABRT)
    _, status = os.waitpid(child, 0)
    return os.waitstatus_to_exitcode(status) == -signal.SIGKILL, told


def _reports(pipe: int) -> Iterator[list[Any]]:
    """What comes through a pipe until it is closed, or silent for too long."""
    text = b""
    while select.select([pipe], [], [], SILENT_S)[0]:
        read = os.read(pipe, _BLOCK)
        if not read:
            return
        *lines, text = (text + read).split(b"\n")
        yield from map(json.loads, lines)
    yield _HUNG


def _write(descriptor: int, words: tuple[object, ...]) -> None:
    """Writes with one system call, so that a report is complete or missing."""
    os.write(descriptor, f"{json.dumps(words)}\n".encode())


def _run_to_the_end(run: Callable[[Tell], None], tell: Tell) -> None:
    """Runs the function, then exits; does not return."""
    try:
        run(tell)
    except Exception as error:
        tell("ended" if isinstance(error, RobotError) else "broke", f"{type(error).__name__}: {error}")
    finally:
        os._exit(0)
