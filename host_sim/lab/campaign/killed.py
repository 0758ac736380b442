"""A run in a process of its own, which is killed on the way, and what it said until then."""

import json
import os
import signal
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from types import FrameType
from typing import Any

_TRACED = (str(Path(__file__).parents[2]), tempfile.__file__)


def before_each_instruction(happen: Callable[[], None]) -> None:
    """Has a function called before each Python instruction of this package that begins from now on, in this thread.

    The functions that run already are left alone, but for what they call. `sys.settrace(None)` ends it.

    Args:
        happen: The function.
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


Tell = Callable[..., None]
"""Takes what a run wants to be known of it, though it may be killed at any time: numbers, words and lists of them."""


def kill_at(number: int) -> None:
    """SIGKILL to this process before one of its Python instructions.

    Args:
        number: How many there are until then, with that one.
    """
    left = number

    def count() -> None:
        nonlocal left
        left -= 1
        if left <= 0:
            os.kill(os.getpid(), signal.SIGKILL)

    before_each_instruction(count)


def run_to_be_killed(run: Callable[[Tell], None]) -> tuple[bool, list[list[Any]]]:
    """Runs something in a process of its own.

    Args:
        run: What is to be killed on the way.

    Returns:
        Whether it was killed, and everything it told.
    """
    ours, its = os.pipe()
    child = os.fork()
    if child == 0:
        _run_to_the_end(run, lambda *words: _write(its, words))
    os.close(its)
    with os.fdopen(ours) as pipe:
        told = [json.loads(line) for line in pipe]
    _, status = os.waitpid(child, 0)
    return os.waitstatus_to_exitcode(status) == -signal.SIGKILL, told


def _write(descriptor: int, words: tuple[object, ...]) -> None:
    """One system call: what is told is there whole, or not at all."""
    os.write(descriptor, f"{json.dumps(words)}\n".encode())


def _run_to_the_end(run: Callable[[Tell], None], tell: Tell) -> None:
    """It does not return."""
    try:
        run(tell)
    except Exception as error:
        tell("end", f"{type(error).__name__}: {error}")
    finally:
        os._exit(0)
