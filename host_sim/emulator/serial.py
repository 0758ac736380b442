"""USART1 (RM0090 30, RM0008 27), polled, on a line at 115,200 baud (8N1) that carries frames as slcan text."""

from collections import deque
from collections.abc import Callable

from host_sim.emulator.can import CanFrame
from host_sim.emulator.clock import NEVER, SECOND, Clock
from host_sim.emulator.registers import BoardError, Peripheral, Register, ignore
from host_sim.transport.slcan_link import decode

BAUD = 115_200
_BYTE_SPAN = 10 * SECOND // BAUD
_RATE_TOLERANCE = 0.02
_ORE, _RXNE, _TC, _TXE = 1 << 3, 1 << 5, 1 << 6, 1 << 7
_RE, _UE, _INTERRUPTS = 1 << 2, 1 << 13, 0x1F0
_NAMES = {0x08: "BRR", 0x10: "CR2", 0x14: "CR3", 0x18: "GTPR"}
_LINE_END = ord("\r")
_UNDER_WAY_MAX = 2
"""Bytes on their way out: one on the line, one behind it."""


class Usart(Peripheral):
    """Bytes in and out, one at a time."""

    def __init__(self, clock: Clock, bus_hz: Callable[[], int], heard: Callable[[int], None]) -> None:
        """At rest.

        Args:
            clock: The board's.
            bus_hz: Gives the speed of its clock.
            heard: Takes each byte that the board sends.
        """
        self._clock, self._bus_hz, self._heard = clock, bus_hz, heard
        self._coming: deque[int] = deque()
        self._came_at = self._left_at = 0
        self._cr1 = Register("CR1", on_write=self._write_cr1)
        super().__init__(
            "USART1",
            {offset: Register(name) for offset, name in _NAMES.items()}
            | {
                0x00: Register("SR", on_read=self._read_sr, on_write=ignore),
                0x04: Register("DR", on_read=self._accept, on_write=self._put),
                0x0C: self._cr1,
            },
        )
        self._alarm = clock.add(self._due)
        self.reset()

    def reset(self) -> None:
        """As in `Peripheral`."""
        super().reset()
        self._received: int | None = None
        self._overrun = False
        self._leaving: deque[int] = deque()
        self._alarm.set(self._next())

    def feed(self, text: bytes) -> None:
        """The far end of the line sends that, as fast as it goes."""
        if not self._coming:
            self._came_at = max(self._came_at, self._clock.now) + _BYTE_SPAN
        self._coming.extend(text)
        self._alarm.set(self._next())

    def _due(self) -> int:
        while self._coming and self._came_at <= self._clock.now:
            self._receive(self._coming.popleft())
            self._came_at += _BYTE_SPAN if self._coming else 0
        while self._leaving and self._left_at <= self._clock.now:
            self._heard(self._leaving.popleft())
            self._left_at += _BYTE_SPAN
        return self._next()

    def _next(self) -> int:
        return min(self._came_at if self._coming else NEVER, self._left_at if self._leaving else NEVER)

    def _receive(self, byte: int) -> None:
        """Without a receiver it is lost, and so it is where the one before was not taken."""
        if not self._cr1.value & _UE or not self._cr1.value & _RE:
            return
        self._overrun = self._overrun or self._received is not None
        if self._received is None:
            self._received = byte

    def _read_sr(self) -> int:
        value = _ORE if self._overrun else 0
        value |= 0 if self._received is None else _RXNE
        value |= 0 if self._leaving else _TC
        return value | (_TXE if len(self._leaving) < _UNDER_WAY_MAX else 0)

    def _accept(self) -> int:
        byte, self._received = self._received, None
        self._overrun = False
        return byte or 0

    def _put(self, value: int) -> None:
        if len(self._leaving) == _UNDER_WAY_MAX:
            raise BoardError("USART1 DR was written while TXE is 0")
        if not self._leaving:
            self._left_at = self._clock.now + _BYTE_SPAN
        self._leaving.append(value & 0xFF)
        self._alarm.set(self._next())

    def _write_cr1(self, value: int) -> None:
        if value & _INTERRUPTS:
            raise BoardError("USART1 interrupts were enabled, which are not modelled")
        rate = self._bus_hz() / max(self.registers[0x08].value, 1)
        if value & _UE and abs(rate - BAUD) > BAUD * _RATE_TOLERANCE:
            raise BoardError(f"USART1 was set up for {rate:.0f} baud, on a line of {BAUD}")
        self._cr1.value = value


class SlcanLine:
    """Puts together what the board sends byte by byte."""

    def __init__(self, heard: Callable[[CanFrame], None]) -> None:
        """At the beginning of a line.

        Args:
            heard: Takes each frame.
        """
        self._heard = heard
        self._text = bytearray()

    def take(self, byte: int) -> None:
        """The board has sent a byte. A line that is not a frame is dropped."""
        if byte != _LINE_END:
            self._text.append(byte)
            return
        frame = decode(bytes(self._text))
        self._text.clear()
        if frame is not None:
            self._heard(CanFrame(frame.id, frame.data))
