"""An emulated board: its hardware, the image that it runs, and a link to the simulator."""

import struct
import time
from abc import ABC, abstractmethod
from collections import deque
from collections.abc import Callable
from pathlib import Path

from host_sim.base.errors import OctetError, UsageError
from host_sim.base.paths import image_path
from host_sim.emulator.can import CanFrame
from host_sim.emulator.chips import CHIPS, Chip
from host_sim.emulator.clock import NEVER, SECOND
from host_sim.emulator.hardware import Faults, Hardware
from host_sim.emulator.registers import PowerCut
from host_sim.protocol.codec import Frame
from host_sim.transport.slcan_link import encode
from host_sim.transport.socket_pair import EXTENDED

_BOOT_S = 0.6
"""Enough time to erase a page of flash."""

_ELF_HEADER, _PROGRAM_HEADER = struct.Struct("<4s5B7x2H5I3H"), struct.Struct("<8I")
_ELF_32_BITS, _ELF_ARM, _ELF_LOADED = 1, 40, 1


class TimedBoard(ABC):
    """A `Link` to a board. Time on the board passes within `receive` and `pass_time`, and only there.

    Attributes:
        drift: Fraction by which its time runs faster than the simulator's: 0.02 for 2 %, negative if slower.
    """

    drift = 0.0

    def __init__(self) -> None:
        """It has said nothing yet."""
        self._said: deque[CanFrame] = deque()

    @property
    @abstractmethod
    def _moment(self) -> int:
        """The board's time since power-up, in `SECOND`."""

    @abstractmethod
    def _run_until(self, moment: int) -> None:
        """Runs until the board sends something, at most until a moment."""

    @abstractmethod
    def _stop(self) -> None:
        """Ends `_run_until`."""

    @abstractmethod
    def send(self, frame: Frame) -> None:
        """As in `Link`."""

    @abstractmethod
    def status(self) -> str:
        """The state of the board in a few words."""

    def now(self) -> float:
        """The board's time since power-up, s. Lockstep timeouts use it, so that they do not depend on host load."""
        return self._moment / SECOND

    def receive(self, timeout_s: float) -> Frame | None:
        """As in `Link`. The timeout is in board time, which, apart from drift, never runs faster than the wall clock.

        Raises:
            BoardError: The image does what the hardware does not allow.
        """
        began = time.monotonic()
        self._run_until(self._moment + round(timeout_s * (1 + self.drift) * SECOND))
        if self._said:
            frame = self._said.popleft()
            return Frame(-1, b"") if frame.extended or frame.remote else Frame(frame.id, frame.data)
        time.sleep(max(timeout_s - (time.monotonic() - began), 0.0))
        return None

    def pass_time(self, span_s: float) -> list[Frame]:
        """Lets time pass on the board, without waiting for the wall clock.

        Returns:
            The frames that it sent meanwhile; a 29-bit identifier is flagged `EXTENDED`.
        """
        said = self._listen(round(span_s * SECOND))
        return [Frame(frame.id | (EXTENDED if frame.extended else 0), frame.data) for frame in said]

    def close(self) -> None:
        """As in `Link`."""
        self._said.clear()

    def _listen(self, span: int) -> list[CanFrame]:
        """Advances time by a span; returns the frames sent by then."""
        end = self._moment + span
        heard: list[CanFrame] = []
        while self._moment < end:
            self._run_until(end)
            heard.extend(self._said)
            self._said.clear()
        return heard

    def _has_news(self) -> bool:
        return bool(self._said)

    def _receive(self, frame: CanFrame) -> None:
        self._said.append(frame)
        self._stop()


class EmulatedBoard(TimedBoard):
    """A board whose chip is emulated here.

    Attributes:
        image: The `.elf` file.
        hardware: Core, memories and peripherals.
        resets: Cause of each reset so far, after that of power-up.
    """

    def __init__(
        self,
        chip: Chip,
        image: Path,
        faults: Faults | None = None,
        *,
        serial: bool = False,
    ) -> None:
        """Flashes the image and runs it until startup is complete.

        Args:
            chip: The chip on the board.
            image: The `.elf` file.
            faults: Hardware faults to simulate.
            serial: Whether frames go over the serial line as slcan text instead of over the bus.

        Raises:
            OctetError: The image cannot be read.
            BoardError: The image did something that the hardware does not allow.
        """
        super().__init__()
        self.image = image
        self.resets: list[str] = []
        self._serial = serial
        self._reset_cause: str | None = None
        self._deadline = NEVER
        self.hardware = Hardware(chip, faults or Faults(), self._receive, self._ask_reset)
        self.hardware.flash_image(load_segments(image))
        self._clock = self.hardware.clock
        self._set_alarm = self._clock.add(self._due)
        self._said.extend(self._listen(round(_BOOT_S * SECOND)))

    def send(self, frame: Frame) -> None:
        """As in `Link`."""
        if self._serial:
            self.hardware.feed_line(encode(frame))
        else:
            self.put(CanFrame(frame.id & ~EXTENDED, frame.data, extended=bool(frame.id & EXTENDED)))

    def put(self, frame: CanFrame) -> None:
        """Queues a frame of any kind from another node on the bus."""
        if self.hardware.on_bus:
            self.hardware.can.put(frame)

    def cut_power(self) -> None:
        """Switches the board off and on again; only the flash keeps its contents."""
        self.restart("power")

    def restart(self, cause: str) -> None:
        """Resets the chip; the causes are those of `Hardware.restart`."""
        self.resets.append(cause)
        self._reset_cause = None
        self.hardware.restart(cause)

    def status(self) -> str:
        """The state of the board in a few words."""
        return f"is an emulated {self.hardware.chip.name}, and was reset {len(self.resets)} times"

    @property
    def _moment(self) -> int:
        return self._clock.now

    def _run_until(self, moment: int) -> None:
        """Runs until the board sends something, at most until a moment."""
        self._deadline = moment
        self._set_alarm(moment)
        while not self._has_news() and self._clock.now < moment:
            try:
                self.hardware.core.run()
            except PowerCut:
                self.cut_power()
            if self._reset_cause is not None:
                self.restart(self._reset_cause)

    def _due(self) -> int:
        if self._deadline <= self._clock.now:
            self._deadline = NEVER
            self.hardware.core.stop()
        return self._deadline

    def _stop(self) -> None:
        self.hardware.core.stop()

    def _ask_reset(self, cause: str) -> None:
        self._reset_cause = cause
        self.hardware.core.stop()


def start_board(
    name: str, faults: Faults | None = None, link: str = "", image: Callable[[str, str], Path] = image_path
) -> EmulatedBoard:
    """Starts a board with its built image.

    Args:
        name: One of `CHIPS`.
        faults: Hardware faults to simulate.
        link: The link of the image, such as `bxcan` or `slcan`; by default that for the board's CAN controller.
        image: Names the image, given board and link.

    Raises:
        UsageError: No board has that name.
        OctetError: The image is not built.
        BoardError: The image does what the hardware does not allow.
    """
    if name not in CHIPS:
        raise UsageError(f"no board {name!r}; there are {', '.join(CHIPS)}")
    link = link or CHIPS[name].link
    serial = link == "slcan"
    return EmulatedBoard(CHIPS[name], image(name, link), faults, serial=serial)


def load_segments(path: Path) -> list[tuple[int, bytes]]:
    """The segments of an image, (address, bytes), as a probe writes them.

    Args:
        path: The `.elf` file.

    Raises:
        OctetError: The file is not an image for an ARM core.
    """
    try:
        data = path.read_bytes()
        magic, bits, *_, machine, _, _, table, _, _, _, _, count = _ELF_HEADER.unpack_from(data)
        if magic != b"\x7fELF" or bits != _ELF_32_BITS or machine != _ELF_ARM:
            raise OctetError(f"cannot read the image {path}: not a 32-bit ELF file for ARM")
        headers = [_PROGRAM_HEADER.unpack_from(data, table + i * _PROGRAM_HEADER.size) for i in range(count)]
    except (OSError, struct.error) as error:
        raise OctetError(f"cannot read the image {path}: {error}") from error
    return [
        (at, data[offset : offset + size])
        for kind, offset, _, at, size, *_ in headers
        if kind == _ELF_LOADED and size
    ]
