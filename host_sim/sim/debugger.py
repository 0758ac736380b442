"""gdb, in this terminal."""

import os
import shutil
import signal
import subprocess
import sys
import termios
from collections.abc import Sequence
from contextlib import suppress

from host_sim.base.errors import OctetError, RobotError
from host_sim.base.paths import BUILD, ROOT
from host_sim.transport.bus_process import LinkedProcess

OCTET_DEBUG, OCTET_ROBOT = "tools/debug/octet-debug", "hal/port/posix/octet-robot"
"""Programs of the host build for debuggers: the robot of a log, and a robot on a bus."""

LOG_SCRIPT = os.fspath(ROOT / "tools" / "debug" / "log.gdb")

_SCRIPT = os.fspath(ROOT / "tools" / "debug" / "octet.gdb")


def debug_program(name: str) -> str:
    """A program of the host build for debuggers.

    Raises:
        OctetError: It is not built.
    """
    path = BUILD / "host-debug" / name
    if not path.exists():
        raise OctetError(f"{path} is not built: run tools/setup debug")
    return os.fspath(path)


def gdb_command(arguments: Sequence[str], program: str = "gdb") -> list[str]:
    """The command line of a gdb with these arguments."""
    return [program, "-q", "-nx", "-x", _SCRIPT, *arguments]


class Gdb(LinkedProcess):
    """A gdb that owns this terminal, with its Ctrl-C, until it ends. It ends with `close`."""

    def __init__(self, arguments: Sequence[str], program: str = "gdb", pass_fds: Sequence[int] = ()) -> None:
        """Starts it.

        Args:
            arguments: Its arguments.
            program: `gdb` or `gdb-multiarch`.
            pass_fds: File descriptors that it and the debugged program inherit.

        Raises:
            OctetError: It is not installed.
        """
        if shutil.which(program) is None:
            raise OctetError(f"{program} is not installed: run tools/setup debug")
        self._terminal = termios.tcgetattr(sys.stdin) if sys.stdin.isatty() else None
        self._process = subprocess.Popen(
            gdb_command(arguments, program),
            pass_fds=pass_fds,
            preexec_fn=os.setpgrp,  # noqa: PLW1509 - no thread runs here; process_group is of Python 3.11
        )
        self._take_terminal(self._process.pid)

    def status(self) -> str:
        """Says that it runs.

        Raises:
            RobotError: It has ended.
        """
        if self._process.poll() is not None:
            raise RobotError("the debugger was left before the run had ended")
        return "is in the debugger"

    def wait(self) -> int:
        """Waits for its end, and returns its exit code."""
        return self._process.wait()

    def close(self) -> None:
        """Ends it, and with it the debugged program."""
        self._process.kill()
        self._process.wait()
        self._take_terminal(os.getpgrp())
        if self._terminal:
            termios.tcsetattr(sys.stdin, termios.TCSADRAIN, self._terminal)

    @staticmethod
    def _take_terminal(group: int) -> None:
        """Gives the terminal to a group of processes, as a shell does: others are stopped when they read from it."""
        before = signal.signal(signal.SIGTTOU, signal.SIG_IGN)
        with suppress(OSError):
            os.tcsetpgrp(sys.stdin.fileno(), group)
        signal.signal(signal.SIGTTOU, before)
