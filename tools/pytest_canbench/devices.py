"""Devices under test: a shared library or a C file, a process, or an image on an emulated chip."""

import os
import shutil
import subprocess
import tempfile
import time
from collections import deque
from pathlib import Path
from typing import Any, Protocol

import can
import cffi

from host_sim.base.errors import LinkDownError, UsageError
from host_sim.transport.bus_link import BusLink
from host_sim.transport.bus_process import BusProcess, start_on_socket_pair
from host_sim.transport.link import Frame
from host_sim.transport.socket_pair import ERROR, EXTENDED, FLAGS, REMOTE, SocketPairLink

SEAM = """
struct frame { uint32_t id; uint8_t len; uint8_t data[8]; };  /* a 29-bit id has bit 31 set, as in Linux */
void receive(const struct frame *frame);
int tick(uint32_t now_ms, struct frame frames[16]);
"""
"""The functions of a library: `tick` is called every ms, from 0 on, and returns its number of frames to send."""

START_S = 5.0
"""How long to wait for a program's first frame; without one, its time begins anyway."""

_FRAMES_MAX, _SLICE_S, _LATE_S, _ID_MAX = 16, 0.1, 0.005, 0x7FF


class Device(Protocol):
    """A link to a device; each `tick` is 1 ms of its time."""

    def send(self, frame: Frame) -> None:
        """Sends a frame to the device."""

    def receive(self, timeout_s: float) -> Frame | None:
        """The next frame that the device has sent, if there is one."""

    def tick(self, now_ms: int) -> None:
        """Advances the device's time to `now_ms`."""

    def close(self) -> None:
        """Switches the device off."""


class LibraryDevice:
    """A shared library, loaded anew for each device so that its variables are as at power-up."""

    def __init__(self, source: Path) -> None:
        """Loads a library, or a C file, which is compiled.

        Raises:
            UsageError: It cannot be compiled or loaded.
        """
        self._folder = tempfile.TemporaryDirectory()
        library = Path(self._folder.name) / "device.so"
        self._library: Any
        self._ffi = cffi.FFI()
        self._ffi.cdef(SEAM)
        try:
            _build(source, library)
            self._library = self._ffi.dlopen(os.fspath(library))
            self._receive: Any = self._library.receive
            self._tick: Any = self._library.tick
        except OSError as error:
            self._folder.cleanup()
            raise UsageError(f"cannot load {source}: {error.strerror or error}") from None
        except UsageError:
            self._folder.cleanup()
            raise
        except AttributeError:
            self.close()
            raise UsageError(f"{source} does not have both of receive and tick; they are declared\n{SEAM}") from None
        self._in: Any = self._ffi.new("struct frame *")
        self._out: Any = self._ffi.new(f"struct frame[{_FRAMES_MAX}]")
        self._said: deque[Frame] = deque()

    def send(self, frame: Frame) -> None:
        """As in `Device`."""
        self._in.id, self._in.len, self._in.data = frame.id, len(frame.data), frame.data.ljust(8, b"\0")
        self._receive(self._in)

    def receive(self, timeout_s: float) -> Frame | None:  # noqa: ARG002 - as in `Device`
        """As in `Device`."""
        return self._said.popleft() if self._said else None

    def tick(self, now_ms: int) -> None:
        """As in `Device`."""
        count = self._tick(now_ms, self._out)
        if not 0 <= count <= _FRAMES_MAX:
            raise LinkDownError(f"tick has returned {count}, which is no number of frames from 0 to {_FRAMES_MAX}")
        for i in range(count):
            out = self._out[i]
            self._said.append(Frame(_identified(out.id), bytes(out.data)[: out.len]))

    def close(self) -> None:
        """As in `Device`."""
        self._ffi.dlclose(self._library)
        self._folder.cleanup()


def _identified(can_id: int) -> int:
    """The identifier as the bench has it: one over 11 bits needs no flag; remote and error frames are no messages."""
    if can_id & (REMOTE | ERROR):
        return -1
    return can_id | EXTENDED if can_id & ~FLAGS > _ID_MAX else can_id


def _build(source: Path, library: Path) -> None:
    if source.suffix != ".c":
        shutil.copyfile(source, library)  # a copy, since a loaded library is not loaded again
        return
    command = ["cc", "-shared", "-fPIC", "-O1", "-o", os.fspath(library), os.fspath(source)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise UsageError(f"cannot compile {source}: {next(iter(done.stderr.splitlines()), '')}")


class ProcessDevice:
    """A program on a socket pair or on a bus such as vcan, in real time.

    Its time begins with its first frame, or after `START_S`. If this machine falls behind, so does the bench's time:
    the program does not get a burst of frames.
    """

    def __init__(self, command: str, folder: Path, bus: str) -> None:
        """Starts it.

        Args:
            command: Program and arguments. It finds its bus in CAN_INTERFACE and CAN_CHANNEL.
            folder: Its working folder.
            bus: `fd` for a socket pair, else python-can's `INTERFACE:CHANNEL`.

        Raises:
            UsageError: It cannot be started, or there is no such bus.
        """
        self._link: BusLink | SocketPairLink
        if bus == "fd":
            self._link, self._process = start_on_socket_pair(command, {}, folder=folder)
        else:
            interface, _, channel = bus.partition(":")
            try:
                opened = can.Bus(interface=interface, channel=channel)
            except (can.CanError, can.CanInterfaceNotImplementedError, OSError, ValueError) as error:
                raise UsageError(f"cannot open the bus {bus}: {error}") from None
            self._link = BusLink(opened, is_socket=interface == "socketcan")
            try:
                self._process = BusProcess(command, bus, {}, folder)
            except UsageError:
                self._link.close()
                raise
        self._link.takes_extended = True
        try:
            self._await_first_frame()
        except LinkDownError as error:
            self.close()
            raise UsageError(f"the device {error}") from None
        self._begun_s = time.monotonic()

    def _await_first_frame(self) -> None:
        """Waits for its first frame, where its time begins: a busy machine may take long to start a program."""
        for _ in range(round(START_S / _SLICE_S)):
            frame = self._link.receive(_SLICE_S)
            self._process.status()
            if frame is not None:
                self._link.put_back(frame)
                return

    def send(self, frame: Frame) -> None:
        """As in `Device`."""
        self._link.send(frame)

    def receive(self, timeout_s: float) -> Frame | None:
        """As in `Device`."""
        return self._link.receive(timeout_s)

    def tick(self, now_ms: int) -> None:
        """As in `Device`.

        Raises:
            LinkDownError: The program has ended.
        """
        self._process.status()
        early_s = self._begun_s + now_ms / 1000 - time.monotonic()
        time.sleep(max(early_s, 0.0))
        self._begun_s += max(-early_s - _LATE_S, 0.0)

    def close(self) -> None:
        """As in `Device`."""
        self._process.close()
        self._link.close()


class ImageDevice:
    """An image on an emulated chip, with Octet's emulator; its time is simulated.

    Attributes:
        board: The emulated board.
    """

    def __init__(self, chip: str, image: Path) -> None:
        """Flashes it and lets it boot.

        Raises:
            UsageError: There is no emulator here, no such chip, or no such image.
        """
        try:
            from host_sim.emulator.board import EmulatedBoard  # noqa: PLC0415 - of Octet itself, not of the plug-in
            from host_sim.emulator.chips import CHIPS  # noqa: PLC0415 - see above
        except ImportError as error:
            raise UsageError(f"images need Octet's emulator: tools/setup emulator, in its folder ({error})") from None
        if chip not in CHIPS:
            raise UsageError(f"no emulated chip {chip!r}; there are {', '.join(CHIPS)}")
        if not image.is_file():
            raise UsageError(f"there is no image {image}")
        self.board = EmulatedBoard(CHIPS[chip], image)
        self._said: deque[Frame] = deque()

    @property
    def error_counters(self) -> tuple[int, int]:
        """The transmit and the receive error counter of the chip's CAN controller."""
        return self.board.hardware.can.node.tec, self.board.hardware.can.node.rec

    @property
    def is_bus_off(self) -> bool:
        """Whether the controller is off the bus."""
        return bool(self.board.hardware.can.node.bus_off)

    def short_bus(self, is_shorted: bool) -> None:
        """Destroys all frames that the controller sends while shorted: it goes bus-off."""
        self.board.hardware.can.wire.shorted = is_shorted

    def send(self, frame: Frame) -> None:
        """As in `Device`."""
        self.board.send(frame)

    def receive(self, timeout_s: float) -> Frame | None:  # noqa: ARG002 - as in `Device`
        """As in `Device`."""
        return self._said.popleft() if self._said else None

    def tick(self, now_ms: int) -> None:  # noqa: ARG002 - the board counts for itself
        """As in `Device`."""
        self._said.extend(self.board.pass_time(0.001))

    def close(self) -> None:
        """As in `Device`."""
        self.board.close()


def open_device(what: str, folder: Path, bus: str = "fd") -> Device:
    """Opens the device that the command line names.

    Args:
        what: A library (.so) or a C file (.c), `image:CHIP:FILE.elf`, or else a command.
        folder: Base of relative paths, and working folder of a command.
        bus: Bus of a command, as for `ProcessDevice`.

    Raises:
        UsageError: There is no such device.
    """
    if what.startswith("image:"):
        _, chip, image = [*what.split(":", 2), "", ""][:3]
        return ImageDevice(chip, folder / image)
    if what.endswith((".so", ".c")) and " " not in what:
        return LibraryDevice(folder / what)
    return ProcessDevice(what, folder, bus)
