"""A board that runs an image, joined to the simulator as a link."""

import time
from collections import deque
from pathlib import Path

from host_sim.emulator.can_frame import CanFrame
from host_sim.emulator.chips import Chip
from host_sim.emulator.clock import NEVER, SECOND
from host_sim.emulator.elf import load_segments
from host_sim.emulator.errors import PowerCut
from host_sim.emulator.hardware import Faults, Hardware
from host_sim.protocol.codec import Frame
from host_sim.transport.slcan_link import encode

_BOOT_S = 0.05


class EmulatedBoard:
    """A `Link` to a board. Time on the board passes within `receive` and `pass_time`, and only there.

    Attributes:
        hardware: Its parts.
        resets: Cause of each reset so far, after that of power-up.
    """

    def __init__(self, chip: Chip, image: Path, faults: Faults | None = None, *, serial: bool = False) -> None:
        """Flashes the image, and lets it run until it has settled.

        Args:
            chip: What to build.
            image: The `.elf`.
            faults: How the hardware misbehaves.
            serial: Its frames go over the serial line, as slcan text, rather than over the bus.

        Raises:
            OctetError: There is no such image.
            BoardError: It does what the hardware does not allow.
        """
        self.resets: list[str] = []
        self._serial = serial
        self._said: deque[CanFrame] = deque()
        self._reset_cause: str | None = None
        self._deadline = NEVER
        self.hardware = Hardware(chip, faults or Faults(), self._receive, self._ask_reset)
        self.hardware.flash_image(load_segments(image))
        self._clock = self.hardware.clock
        self._clock.add(self._due)
        self._run_until(round(_BOOT_S * SECOND))

    def send(self, frame: Frame) -> None:
        """As in `Link`."""
        if self._serial:
            self.hardware.usart.feed(encode(frame))
        else:
            self.put(CanFrame(frame.id, frame.data))

    def put(self, frame: CanFrame) -> None:
        """Whoever is on the bus wants to send a frame of any kind."""
        self.hardware.wire.put(frame)

    def receive(self, timeout_s: float) -> Frame | None:
        """As in `Link`. The time is the board's: it goes no faster than the wall's, but may go more slowly.

        Raises:
            BoardError: The image does what the hardware does not allow.
        """
        began = time.monotonic()
        self._run_until(self._clock.now + round(timeout_s * SECOND))
        if self._said:
            frame = self._said.popleft()
            return Frame(-1, b"") if frame.extended or frame.remote else Frame(frame.id, frame.data)
        time.sleep(max(timeout_s - (time.monotonic() - began), 0.0))
        return None

    def pass_time(self, span_s: float) -> list[Frame]:
        """Lets so much time pass on the board, without waiting for it.

        Returns:
            What it sent meanwhile.
        """
        end = self._clock.now + round(span_s * SECOND)
        heard: list[Frame] = []
        while self._clock.now < end:
            self._run_until(end)
            heard.extend(Frame(frame.id, frame.data) for frame in self._said)
            self._said.clear()
        return heard

    def cut_power(self) -> None:
        """Off and on again: only the flash is as before."""
        self._restart("power")

    def status(self) -> str:
        """How the board is, in a few words."""
        return f"is an emulated {self.hardware.chip.name}, and was reset {len(self.resets)} times"

    def close(self) -> None:
        """As in `Link`."""
        self._said.clear()

    def _run_until(self, moment: int) -> None:
        """Runs until the board says something, at the latest until then."""
        self._deadline = moment
        self._clock.expect(moment)
        while not self._said and self._clock.now < moment:
            try:
                self.hardware.core.run()
            except PowerCut:
                self.cut_power()
            if self._reset_cause is not None:
                self._restart(self._reset_cause)

    def _due(self) -> int:
        if self._deadline <= self._clock.now:
            self._deadline = NEVER
            self.hardware.core.stop()
        return self._deadline

    def _receive(self, frame: CanFrame) -> None:
        self._said.append(frame)
        self.hardware.core.stop()

    def _ask_reset(self, cause: str) -> None:
        self._reset_cause = cause
        self.hardware.core.stop()

    def _restart(self, cause: str) -> None:
        self.resets.append(cause)
        self._reset_cause = None
        self.hardware.restart(cause)
