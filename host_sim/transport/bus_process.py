"""A user's own program on a bus: a process that finds the bus in its environment, in python-can's variables.

CAN_INTERFACE is `octet` and CAN_CHANNEL the number of an open socket, which carries Linux's `struct can_frame` in
datagrams, as SocketCAN does; or they are an interface and a channel of python-can's, such as `socketcan` and `vcan0`.
"""

import os
import shlex
import signal
import socket
import subprocess
import tempfile
from abc import ABC, abstractmethod
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path

from host_sim.base.errors import LinkDownError, UsageError
from host_sim.transport.link import LineStats
from host_sim.transport.socket_pair import SocketPairLink

_END_S = 2.0
_PRINTED_MAX = 300


class LinkedProcess(ABC):
    """A process at the other end of a link, which closes before the process has ended."""

    _process: subprocess.Popen[bytes]

    @abstractmethod
    def status(self) -> str:
        """The state of the process in a few words; raises if it has ended."""

    def account_for_silence(self) -> None:
        """Waits a moment for the end of a process whose link is closed; raises as `status` does if it has ended."""
        with suppress(subprocess.TimeoutExpired):
            self._process.wait(_END_S)
        self.status()


class BusProcess(LinkedProcess):
    """A running program, with all processes that it starts.

    Attributes:
        pid: Process id. All that the program starts is in a process group of this number.
    """

    def __init__(
        self, command: str, bus: str, environment: Mapping[str, str], folder: Path | None = None, fd: int = -1
    ) -> None:
        """Starts the program.

        Args:
            command: Program and arguments, as in a shell, but without one.
            bus: `INTERFACE:CHANNEL`, for the program to open.
            environment: Additional environment variables.
            folder: Working directory; by default the current one.
            fd: The socket that it inherits, if the bus is one; else -1.

        Raises:
            UsageError: The command cannot be started.
        """
        interface, _, channel = bus.partition(":")
        told = {"CAN_INTERFACE": interface, "CAN_CHANNEL": channel, **environment}
        self._command, self._output = command, tempfile.TemporaryFile()  # noqa: SIM115 - closed with the process
        try:
            self._process = subprocess.Popen(
                shlex.split(command),
                env={**os.environ, **told},
                cwd=folder,
                pass_fds=() if fd < 0 else (fd,),
                stdin=subprocess.DEVNULL,
                stdout=self._output,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )
        except (OSError, ValueError, IndexError) as error:  # IndexError: there is no word in it
            self._output.close()
            reason = error.strerror if isinstance(error, OSError) else error if command.strip() else "it is empty"
            raise UsageError(f"cannot start {command!r}: {reason}") from None
        self.pid, self._printed = self._process.pid, b""

    def status(self) -> str:
        """The state of the process in a few words.

        Raises:
            LinkDownError: It has ended; the message has what it printed last.
        """
        code = self._process.poll()
        if code is None:
            return "is running"
        how = f"was killed by signal {-code}" if code < 0 else f"ended with exit code {code}"
        raise LinkDownError(f"{self._command!r} {how} and printed {self._last_words() or 'nothing'}")

    def _last_words(self) -> str:
        if not self._output.closed:
            self._output.seek(max(self._output.seek(0, os.SEEK_END) - _PRINTED_MAX, 0))
            self._printed = self._output.read()
        return " / ".join(line for line in self._printed.decode(errors="replace").splitlines() if line)

    def close(self) -> None:
        """Kills it, and all that it has started."""
        with suppress(ProcessLookupError):
            os.killpg(self.pid, signal.SIGKILL)
        self._process.wait()
        self._last_words()
        self._output.close()


def start_on_socket_pair(
    command: str, environment: Mapping[str, str], stats: LineStats | None = None, folder: Path | None = None
) -> tuple[SocketPairLink, BusProcess]:
    """Starts a program at the other end of a socket pair.

    Args:
        command: As `BusProcess` has it.
        environment: As `BusProcess` has it.
        stats: Counts what happens to the line.
        folder: As `BusProcess` has it.

    Returns:
        The link to it, and the process; the caller closes both.

    Raises:
        UsageError: The command cannot be started.
    """
    ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    with ours, theirs:
        process = BusProcess(command, f"octet:{theirs.fileno()}", environment, folder, theirs.fileno())
        link = SocketPairLink(ours.dup(), stats)
    link.explain = process.account_for_silence
    return link, process
