"""The host build of the firmware as a process of its own."""

import contextlib
import os
import select
import signal
import subprocess
import time
from collections.abc import Sequence
from pathlib import Path

from host_sim.base.errors import OctetError, RobotError
from host_sim.base.paths import BUILD

PROGRAM = BUILD / "host" / "hal" / "port" / "posix" / "octet-robot"
_READY_S = 10.0
_END_S = 2.0
_PRINTED_CHARS = 400


class RobotProcess:
    """A running robot. It ends with `close`, or when this process ends.

    Attributes:
        pid: Process id.
    """

    def __init__(
        self, link: str, node: int, pass_fds: Sequence[int] = (), program: Path = PROGRAM, brain: str = ""
    ) -> None:
        """Starts the robot and waits until it listens.

        Args:
            link: Its link, as on the firmware's command line: `socketcan:vcan0`, `fd:5`.
            node: Node number, 1..31.
            pass_fds: File descriptors that it inherits.
            program: The firmware.
            brain: The file with the program that is its brain; empty for the firmware's own.

        Raises:
            OctetError: The program is missing.
            RobotError: The process ended, or was not ready in time; the message has what it printed.
        """
        command = [os.fspath(program), *([brain] if brain else []), "--with-parent", "--node", str(node), link]
        try:
            self._process = subprocess.Popen(
                command,
                pass_fds=pass_fds,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                start_new_session=True,  # Ctrl-C in the terminal must not reach the robot: it is stopped in order
            )
        except OSError as error:
            raise OctetError(f"cannot start the firmware: {error}; build it with tools/setup") from error
        self.pid = self._process.pid
        self._printed = b""
        assert self._process.stdout is not None
        self._output = self._process.stdout
        os.set_blocking(self._output.fileno(), False)
        try:
            self._await_ready()
        except BaseException:
            self.close()
            raise

    def status(self) -> str:
        """The state of the process in a few words, with what it printed.

        Raises:
            RobotError: The process has ended.
        """
        code = self._process.poll()
        if code is None:
            return f"is running and {self._quoted()}"
        how = f"was killed by signal {_signal_name(-code)}" if code < 0 else f"ended with exit code {code}"
        raise RobotError(f"the robot {how} and {self._quoted()}")

    def account_for_silence(self) -> None:
        """Waits a moment for the end of a robot whose link is closed: the link closes before the process has ended.

        Raises:
            RobotError: The process has ended; the message says how.
        """
        with contextlib.suppress(subprocess.TimeoutExpired):
            self._process.wait(_END_S)
        self.status()

    def close(self) -> None:
        """Kills the process, which has nothing to save."""
        self._process.kill()
        self._process.wait()
        self._output.close()

    def _await_ready(self) -> None:
        give_up = time.monotonic() + _READY_S
        while b"listens" not in self._printed:
            left_s = give_up - time.monotonic()
            if not select.select([self._output], [], [], max(left_s, 0.0))[0]:
                raise RobotError(f"the robot was not ready within {_READY_S:g} s and {self._quoted()}")
            self._read()
            if self._process.poll() is not None:
                self._read()
                break
        self.status()

    def _read(self) -> None:
        try:
            self._printed += os.read(self._output.fileno(), 65536)
        except BlockingIOError:
            return

    def _quoted(self) -> str:
        self._read()
        text = " / ".join(self._printed.decode(errors="replace").split("\n")).strip(" /")
        if len(text) > _PRINTED_CHARS:
            text = f"{text[: _PRINTED_CHARS * 3 // 4]} ... {text[-_PRINTED_CHARS // 4 :]}"
        return f"printed: {text}" if text else "printed nothing"


def _signal_name(number: int) -> str:
    """A signal by number and name, such as 9 (SIGKILL)."""
    with contextlib.suppress(ValueError):  # a real-time signal has no name
        return f"{number} ({signal.Signals(number).name})"
    return f"{number}"
