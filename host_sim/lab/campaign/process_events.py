"""The events of a robot's process, and of the simulator's own."""

import os
import signal
import subprocess
import threading
from collections.abc import Callable, Mapping
from contextlib import suppress


def process_events(pid: Callable[[], int]) -> Mapping[str, Callable[[int], None]]:
    """The events of a process on this host.

    Args:
        pid: Gives the process.
    """
    return {
        "kill": lambda _: os.kill(pid(), signal.SIGKILL),
        "crash": lambda _: os.kill(pid(), signal.SIGSEGV),
        "hang": lambda span_ms: hang(pid(), span_ms),
        "hold-up": hold_up,
    }


def hang(pid: int, span_ms: int) -> None:
    """SIGSTOP, and after a while SIGCONT."""
    os.kill(pid, signal.SIGSTOP)

    def go_on() -> None:
        with suppress(ProcessLookupError):
            os.kill(pid, signal.SIGCONT)

    timer = threading.Timer(span_ms / 1000, go_on)
    timer.daemon = True
    timer.start()


def hold_up(span_ms: int) -> None:
    """SIGSTOP to this process itself; another one, which is not its robot, wakes it up."""
    pid = os.getpid()
    with subprocess.Popen(["/bin/sh", "-c", f"sleep {span_ms / 1000}; kill -CONT {pid}"]):
        os.kill(pid, signal.SIGSTOP)
