"""Something happens between two Python instructions of the simulator."""

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
