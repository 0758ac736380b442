"""Runs a flash image with slcan on its UART in a third-party emulator: an STM32F405 in QEMU."""

import os
import shutil
import socket
import subprocess
import time
from collections.abc import Sequence
from pathlib import Path

from host_sim.base.errors import OctetError, RobotError
from host_sim.base.paths import image_path
from host_sim.transport.bus_process import LinkedProcess
from host_sim.transport.slcan_link import SlcanLink

PROGRAM = "qemu-system-arm"
MACHINE = "netduinoplus2"
"""A board with an STM32F405 that QEMU emulates."""
IMAGE = "feather_stm32f405", "slcan"
"""Board and link of the image for it."""

_READY_S = 60.0  # a busy machine takes long to start an emulator
_PAUSE_S = 0.05
"""Gap that marks the end of the robot's first reports, s."""


class SerialEmulator(LinkedProcess):
    """A running emulator. It ends with `close`, or when this process ends.

    Attributes:
        link: Carries frames to the image and back.
        pid: Process id.
    """

    def __init__(self, name: str, command: Sequence[str], *, by_number: bool = False, held: bool = False) -> None:
        """Starts it and waits for the robot's first reports, which it sends once a second without being asked.

        Args:
            name: Its name, for messages.
            command: The command line, whose program is installed; `setpriv` ends it even if this process is killed.
            by_number: Whether the serial port is the file descriptor that replaces `FD` in the command line;
                otherwise it is standard input and output.
            held: Whether the image begins only when a debugger says so; its first reports are then not waited for.

        Raises:
            OctetError: It cannot be started.
            RobotError: It ended, or the robot did not report in time.
        """
        self._name = name
        ours, theirs = socket.socketpair()
        with theirs:
            words = [word.replace("FD", str(theirs.fileno())) if by_number else word for word in command]
            stream = subprocess.DEVNULL if by_number else theirs.fileno()
            try:
                self._process = subprocess.Popen(
                    ["setpriv", "--pdeathsig", "KILL", *words],
                    pass_fds=[theirs.fileno()],
                    stdin=stream,
                    stdout=stream,
                    stderr=subprocess.PIPE,
                )
            except OSError as error:
                ours.close()
                raise OctetError(f"cannot start {command[0]}: {error}") from error
        self.link = SlcanLink(ours)
        self.pid = self._process.pid
        try:
            if not held:
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
            return f"is running in {self._name}"
        assert self._process.stderr is not None
        printed = self._process.stderr.read().decode(errors="replace").strip().replace("\n", " / ")
        raise RobotError(f"{self._name} ended with exit code {code} and printed: {printed or 'nothing'}")

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
            raise RobotError(f"the robot in {self._name} sent nothing for {_READY_S:g} s; it {self.status()}")
        give_up_s = time.monotonic() + _READY_S
        while self.link.receive(_PAUSE_S) is not None and time.monotonic() < give_up_s:
            continue


class Qemu(SerialEmulator):
    """A running QEMU."""

    def __init__(self, image: Path | None = None, machine: str = MACHINE, gdb: Path | None = None) -> None:
        """Starts it.

        Args:
            image: The `.elf` file; None for the one that was built here.
            machine: The machine that QEMU emulates.
            gdb: A socket that it makes for gdb, which then begins the image; None for none.

        Raises:
            OctetError: QEMU is not installed, or the image is not built.
            RobotError: As in `SerialEmulator`.
        """
        image = image or image_path(*IMAGE)
        if shutil.which(PROGRAM) is None:
            raise OctetError(f"{PROGRAM} is not installed: run tools/setup images")
        options = ["-M", machine, "-display", "none", "-monitor", "none", "-kernel", os.fspath(image)]
        command = [PROGRAM, *options, "-chardev", "socket,id=uart,fd=FD", "-serial", "chardev:uart"]
        if gdb:
            command += ["-S", "-chardev", f"socket,id=gdb,path={gdb},server=on,wait=off", "-gdb", "chardev:gdb"]
        super().__init__("QEMU", command, by_number=True, held=gdb is not None)
