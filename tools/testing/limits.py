"""Runs commands with time limits."""

import math
import os
import signal
import subprocess
import time
from collections.abc import Generator, Iterable, Sequence
from contextlib import ExitStack, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

T = TypeVar("T")
Steps = Generator[None, None, T]
"""A generator that yields to let others run, and returns a result."""

NO_LIMIT = math.inf
_LOOK_S = 0.2
_END_S = 10.0
_OVER = object()
_HOW = (signal.SIGINT, signal.SIGTERM, signal.SIGKILL)


class Ended(NamedTuple):
    """How a command ended.

    Attributes:
        well: Whether its exit code was 0.
        why: The limit that stopped it, in words; empty if none did.
    """

    well: bool
    why: str = ""


@dataclass(frozen=True)
class Limits:
    """Time limits.

    Attributes:
        total_min: Minutes for the whole run, from `begun` on; infinite for no limit.
        stall_min: Minutes in which at least one test must begin or end.
        begun: Start of the run, s on the monotonic clock.
    """

    total_min: float
    stall_min: float
    begun: float

    def passed(self, quiet_s: float = 0.0) -> str:
        """The limit that has been reached, in words; empty if none has.

        Args:
            quiet_s: Seconds since a test last began or ended.
        """
        if time.monotonic() - self.begun >= 60 * self.total_min:
            return f"the time limit of {self.total_min:g} min was reached (--time-limit)"
        if quiet_s >= 60 * self.stall_min:
            return f"no test began or ended for {self.stall_min:g} min (--stall-limit)"
        return ""


def run_within(limits: Limits, command: Sequence[str], reports: Iterable[Path], **options: Any) -> Steps[Ended]:
    """Runs a command in its own process group, and stops the group at a limit or when the generator is closed.

    Args:
        limits: Its time limits.
        command: Program and arguments.
        reports: Files that grow as tests begin and end; without any, there is no stall limit.
        options: For `subprocess.Popen`.

    Yields:
        Nothing, while it runs.

    Returns:
        How it ended.
    """
    watched = list(reports)
    process = subprocess.Popen(command, start_new_session=True, **options)
    try:
        last, sizes = time.monotonic(), _sizes(watched)
        while process.poll() is None:
            yield
            if (now := _sizes(watched)) != sizes or not watched:
                last, sizes = time.monotonic(), now
            if why := limits.passed(time.monotonic() - last):
                return Ended(False, why)
        return Ended(process.returncode == 0)
    finally:
        if process.returncode is None:
            _stop(process)


def side_by_side(*lanes: Steps[None]) -> None:
    """Runs generators in turn, each up to its next `yield`, until the last has ended."""
    with ExitStack() as stack:
        for lane in lanes:
            stack.callback(lane.close)
        going = list(lanes)
        while going := [lane for lane in going if next(lane, _OVER) is not _OVER]:
            time.sleep(_LOOK_S)


def _sizes(files: Sequence[Path]) -> list[int]:
    return [file.stat().st_size if file.exists() else -1 for file in files]


def _stop(process: "subprocess.Popen[bytes]") -> None:
    """Stops a process group: by SIGINT, else by SIGTERM, else by SIGKILL."""
    for number in _HOW:
        os.killpg(process.pid, number)
        with suppress(subprocess.TimeoutExpired):
            process.wait(_END_S)
            break
    with suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
