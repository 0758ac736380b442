"""The STM32F405 image with slcan on its UART, in QEMU."""

import os
import shutil
import socket
import subprocess
import time
from contextlib import suppress
from pathlib import Path

from host_sim.base.errors import OctetError, RobotError
from host_sim.base.paths import image_path
from host_sim.transport.slcan_link import SlcanLink

PROGRAM = "qemu-system-arm"
MACHINE = "netduinoplus2"
"""A board with an STM32F405 that QEMU emulates."""

_READY_S = 10.0
_END_S = 2.0
_PAUSE_S = 0.05
"""Gap that marks the end of the robot's first reports, s."""


class Qemu:
    """A running QEMU. It ends with `close`, or when this process ends.

    Attributes:
        link: Carries frames to the image and back.
        pid: Process id.
    """

    def __init__(self, image: Path | None = None) -> None:
        """Starts QEMU and waits for the robot's first reports, which it sends once a second without being asked.

        Args:
            image: The `.elf` file; None for the one that was built here.

        Raises:
            OctetError: QEMU is not installed, or the image is not built.
            RobotError: QEMU ended, or the robot did not report in time.
        """
        image = image or image_path("feather_stm32f405", "slcan")
        if shutil.which(PROGRAM) is None:
            raise OctetError(f"{PROGRAM} is not installed: run tools/setup images")
        ours, theirs = socket.socketpair()
        with theirs:
            try:
                self._process = subprocess.Popen(
                    _command_line(image, theirs.fileno()),
                    pass_fds=[theirs.fileno()],
                    stdin=subprocess.DEVNULL,
                    stdout=subprocess.DEVNULL,
                    stderr=subprocess.PIPE,
                )
            except OSError as error:
                ours.close()
                raise OctetError(f"cannot start {PROGRAM}: {error}") from error
        self.link = SlcanLink(ours)
        self.pid = self._process.pid
        try:
            self._await_ready()
        except BaseException:
            self.close()
            raise

    def status(self) -> str:
        """The state of the process, in a few words.

        Raises:
            RobotError: It has ended; the message has what it printed.
        """
        code = self._process.poll()
        if code is None:
            return "is running in QEMU"
        assert self._process.stderr is not None
        printed = self._process.stderr.read().decode(errors="replace").strip().replace("\n", " / ")
        raise RobotError(f"QEMU ended with exit code {code} and printed: {printed or 'nothing'}")

    def account_for_silence(self) -> None:
        """Waits a moment for the end of a process whose line is closed.

        Raises:
            RobotError: The process has ended; the message says how.
        """
        with suppress(subprocess.TimeoutExpired):
            self._process.wait(_END_S)
        self.status()

    def close(self) -> None:
        """Kills the process, which has nothing to save."""
        self._process.kill()
        self._process.wait()
        self.link.close()
        if self._process.stderr is not None:
            self._process.stderr.close()

    def _await_ready(self) -> None:
        try:
            frame = self.link.receive(_READY_S)
        except RobotError:
            self.account_for_silence()
            raise
        if frame is None:
            raise RobotError(f"the robot in QEMU sent nothing for {_READY_S:g} s; it {self.status()}")
        give_up_s = time.monotonic() + _READY_S
        while self.link.receive(_PAUSE_S) is not None and time.monotonic() < give_up_s:
            continue


def _command_line(image: Path, serial: int) -> list[str]:
    """The command line; `setpriv` ends QEMU even if this process is killed."""
    return [
        *("setpriv", "--pdeathsig", "KILL", PROGRAM, "-M", MACHINE, "-display", "none", "-monitor", "none"),
        *("-chardev", f"socket,id=uart,fd={serial}", "-serial", "chardev:uart", "-kernel", os.fspath(image)),
    ]
