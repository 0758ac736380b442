"""Robots as processes: the host build of the firmware, or a user's program, which is restarted when it ends."""

import os
import re
import select
import signal
import subprocess
import time
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from host_sim.base.errors import BrainError, LinkDownError, OctetError, RobotError, UsageError
from host_sim.base.paths import BUILD
from host_sim.transport.bus_process import BusProcess, LinkedProcess, start_on_socket_pair
from host_sim.transport.link import Frame, LineStats, Link
from host_sim.transport.socket_pair import SocketPairLink

PROGRAM = BUILD / "host" / "hal" / "port" / "posix" / "octet-robot"
_READY_S = 10.0
_PRINTED_CHARS = 400
_REPORT_FOLLOWS = re.compile(r"^own: -?\d+ ,", re.MULTILINE)  # and is whole only when the robot has ended
_OF_PROGRAM = "> "  # before a line that the robot's program prints


class RobotProcess(LinkedProcess):
    """A running robot. It ends with `close`, or when this process ends.

    Attributes:
        pid: Process id.
        mistake: Finds the mistake of a user's behaviour in what it has printed; empty if there is none.
    """

    def __init__(
        self, link: str, node: int, pass_fds: Sequence[int] = (), program: Sequence[Path | str] = (PROGRAM,)
    ) -> None:
        """Starts the robot and waits until it listens.

        Args:
            link: Its link, as on the firmware's command line: `socketcan:vcan0`, `fd:5`.
            node: Node number, 1..31.
            pass_fds: File descriptors that it inherits.
            program: The firmware, and its first arguments.

        Raises:
            OctetError: The program is missing.
            RobotError: The process ended, or was not ready in time; the message has what it printed.
        """
        command = [*map(str, program), "--with-parent", "--node", str(node), link]
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
        self.pid, self._node = self._process.pid, node
        self._printed = b""
        self.mistake: Callable[[str], str] = lambda _: ""
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
            BrainError: Its user's behaviour has made a mistake, which ends it.
        """
        code = self._process.poll()
        self._read()
        printed = self._printed.decode(errors="replace")
        if (code is not None or not _REPORT_FOLLOWS.search(printed)) and (mistake := self.mistake(printed)):
            raise BrainError.from_failure(mistake, self._node)
        if code is None:
            return f"is running and {self._quoted()}"
        how = f"was killed by signal {_signal_name(-code)}" if code < 0 else f"ended with exit code {code}"
        raise RobotError(f"the robot {how} and {self._quoted()}")

    def printed(self) -> str:
        """As in `Connection`."""
        self._read()
        lines = self._printed.decode(errors="replace").splitlines(keepends=True)
        return "".join(line[len(_OF_PROGRAM) :] for line in lines if line.startswith(_OF_PROGRAM))

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
        lines = self._printed.decode(errors="replace").split("\n")
        text = " / ".join(line for line in lines if not line.startswith(_OF_PROGRAM)).strip(" /")
        if len(text) > _PRINTED_CHARS:
            text = f"{text[: _PRINTED_CHARS * 3 // 4]} ... {text[-_PRINTED_CHARS // 4 :]}"
        return f"printed: {text}" if text else "printed nothing"


def _signal_name(number: int) -> str:
    """A signal by number and name, such as 9 (SIGKILL)."""
    with suppress(ValueError):  # a real-time signal has no name
        return f"{number} ({signal.Signals(number).name})"
    return f"{number}"


BOOT_S = 10.0
"""Time within which a robot must send its first frame, s."""

_SLICE_S = 0.1


@dataclass
class OwnRobot:
    """A user's program, as a robot.

    Attributes:
        command: Program and arguments.
        node: The robot's node number.
        process: The running program; None before the first start.
        was_there: Whether it has ever sent a frame.
    """

    command: str
    node: int
    process: BusProcess | None = None
    was_there: bool = False

    def __post_init__(self) -> None:
        self._variables = {"OCTET_NODE": str(self.node)}

    def on_socket_pair(self, stats: LineStats) -> SocketPairLink:
        """Starts or restarts it, and waits for its first frame.

        Raises:
            UsageError: It has never sent a frame.
            LinkDownError: It has ended again, or stays silent.
        """
        self.close()
        link, self.process = start_on_socket_pair(self.command, self._variables, stats)
        try:
            link.put_back(self._first_word(link.receive))
        except BaseException:
            link.close()
            raise
        return link

    def on_bus(self, bus: str, link: Link) -> None:
        """Starts it on a bus, and waits for its first frame.

        Raises:
            UsageError: It has never sent a frame.
            LinkDownError: As for `on_socket_pair`.
        """
        self.process = BusProcess(self.command, bus, self._variables)
        self._first_word(link.receive)

    def status(self) -> str:
        """As in `Connection`."""
        assert self.process is not None
        return self.process.status()

    def close(self) -> None:
        """Kills it."""
        if self.process is not None:
            self.process.close()

    def _first_word(self, receive: Callable[[float], Frame | None]) -> Frame:
        for _ in range(round(BOOT_S / _SLICE_S)):
            try:
                frame = receive(_SLICE_S)
                self.status()
            except LinkDownError as error:
                if self.was_there:
                    raise
                raise UsageError(f"the robot {error}") from None
            if frame is not None:
                self.was_there = True
                return frame
        silent = f"the robot {self.command!r} says nothing within {BOOT_S:g} s: at power-up it sends BOOT"
        raise LinkDownError(silent) if self.was_there else UsageError(silent)


@dataclass
class WatchedLink:
    """A link over a bus that restarts the robot's program when it has ended: a bus does not report that."""

    link: Link
    robot: OwnRobot
    bus: str
    stats: LineStats

    def send(self, frame: Frame) -> None:
        """As in `Link`."""
        self.link.send(frame)

    def receive(self, timeout_s: float) -> Frame | None:
        """As in `Link`."""
        frame = self.link.receive(timeout_s)
        if frame is None:
            try:
                self.robot.status()
            except LinkDownError as error:
                self.stats.outages, self.stats.reason = self.stats.outages + 1, str(error)
                self.robot.close()
                with suppress(LinkDownError):  # it has ended again or is silent; the next start may succeed
                    self.robot.on_bus(self.bus, self.link)
        return frame

    def close(self) -> None:
        """As in `Link`."""
        self.link.close()
