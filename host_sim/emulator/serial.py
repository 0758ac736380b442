"""The serial port (F1: RM0008 27, F4: RM0090 30, G4: RM0440 37), polled, with slcan text at 115,200 baud (8N1)."""

from collections import deque
from collections.abc import Callable

from host_sim.emulator.can import CanFrame
from host_sim.emulator.clock import NEVER, SECOND, Clock
from host_sim.emulator.registers import BoardError, Peripheral, Register, ignore
from host_sim.transport.slcan_link import decode

BAUD = 115_200
_BYTE_SPAN = 10 * SECOND // BAUD
_RATE_TOLERANCE = 0.02
_ORE, _RXNE, _TC, _TXE, _RE, _TE = 1 << 3, 1 << 5, 1 << 6, 1 << 7, 1 << 2, 1 << 3
_LINE_END = ord("\r")
_FIFO, _FIFO_ON = 8, 1 << 29


def _always_0(name: str) -> Register:
    """A register whose functions are not modelled."""

    def write(value: int) -> None:
        if value:
            raise BoardError(f"USART {name} was written 0x{value:X}, which is not modelled")

    return Register(name, on_write=write)


class Usart(Peripheral):
    """The serial port of F1 and F4, which handles one byte at a time.

    Attributes:
        depth: Capacity of the receive buffer, and of the transmit buffer behind the shift register, bytes.
    """

    on_bit, baud_at, others = 13, 0x08, 0
    """Bit UE of CR1, the offset of BRR, and further bits of CR1 that are modelled."""

    def __init__(self, clock: Clock, bus_hz: Callable[[], int], heard: Callable[[int], None]) -> None:
        """At rest.

        Args:
            clock: The board's clock.
            bus_hz: Returns its clock frequency, Hz.
            heard: Called with each byte that the board sends.
        """
        self._clock, self._bus_hz, self._heard = clock, bus_hz, heard
        self._coming: deque[int] = deque()
        self._came_at = self._left_at = 0
        self._cr1 = Register("CR1", on_write=self._write_cr1)
        super().__init__("USART", self.layout())
        self._set_alarm = clock.add(self._due)
        self.reset()

    def layout(self) -> dict[int, Register]:
        """The registers by offset."""
        return {offset: _always_0(name) for offset, name in ((0x10, "CR2"), (0x14, "CR3"), (0x18, "GTPR"))} | {
            0x08: Register("BRR"),
            0x00: Register("SR", on_read=self._read_status, on_write=ignore),
            0x04: Register("DR", on_read=self._accept_and_clear, on_write=self._put),
            0x0C: self._cr1,
        }

    def reset(self) -> None:
        """As in `Peripheral`."""
        super().reset()
        self.depth = 1
        self._received: deque[int] = deque()
        self._overrun = False
        self._leaving: deque[int] = deque()
        self._set_alarm(self._next())

    def feed(self, text: bytes) -> None:
        """Queues text from the far end of the line, which arrives at the line's full speed."""
        if not self._coming:
            self._came_at = max(self._came_at, self._clock.now) + _BYTE_SPAN
        self._coming.extend(text)
        self._set_alarm(self._next())

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
        """Receives a byte; it is lost if the receiver is off or the buffer is full."""
        if not self._cr1.value >> self.on_bit & 1 or not self._cr1.value & _RE:
            return
        self._check_rate()
        self._overrun = self._overrun or len(self._received) == self.depth
        if len(self._received) < self.depth:
            self._received.append(byte)

    def _read_status(self) -> int:
        value = _ORE if self._overrun else 0
        value |= _RXNE if self._received else 0
        value |= 0 if self._leaving else _TC
        return value | (_TXE if len(self._leaving) <= self.depth else 0)

    def _accept(self) -> int:
        return self._received.popleft() if self._received else 0

    def _accept_and_clear(self) -> int:
        self._overrun = False
        return self._accept()

    def _put(self, value: int) -> None:
        if len(self._leaving) > self.depth:
            raise BoardError("USART was written a byte to send while TXE is 0")
        if not self._cr1.value >> self.on_bit & 1 or not self._cr1.value & _TE:
            raise BoardError("USART was written a byte to send while its transmitter is off")
        self._check_rate()
        if not self._leaving:
            self._left_at = self._clock.now + _BYTE_SPAN
        self._leaving.append(value & 0xFF)
        self._set_alarm(self._next())

    def _write_cr1(self, value: int) -> None:
        if value & ~(1 << self.on_bit | _TE | _RE | self.others):
            raise BoardError(
                f"USART CR1 was written 0x{value:X}: interrupts and other bytes than 8N1 are not modelled"
            )
        if value >> self.on_bit & 1:
            self._check_rate()
        self._cr1.value = value

    def _check_rate(self) -> None:
        rate = self._bus_hz() / max(self.registers[self.baud_at].value, 1)
        if abs(rate - BAUD) > BAUD * _RATE_TOLERANCE:
            raise BoardError(f"USART was set up for {rate:.0f} baud, on a line of {BAUD}")


class UsartG4(Usart):
    """The serial port of the G4, with FIFOs and a flag clear register."""

    on_bit, baud_at, others = 0, 0x0C, _FIFO_ON

    def layout(self) -> dict[int, Register]:
        """As in `Usart`."""
        names = {0x04: "CR2", 0x08: "CR3", 0x10: "GTPR", 0x14: "RTOR", 0x18: "RQR", 0x2C: "PRESC"}
        return {offset: _always_0(name) for offset, name in names.items()} | {
            0x00: self._cr1,
            0x0C: Register("BRR"),
            0x1C: Register("ISR", on_read=self._read_status, on_write=ignore),
            0x20: Register("ICR", on_write=self._clear),
            0x24: Register("RDR", on_read=self._accept, on_write=ignore),
            0x28: Register("TDR", on_write=self._put),
        }

    def _write_cr1(self, value: int) -> None:
        if value & self._cr1.value & 1 and (value ^ self._cr1.value) & _FIFO_ON:
            raise BoardError("USART CR1.FIFOEN was changed while UE is 1")
        super()._write_cr1(value)
        self.depth = _FIFO if value & _FIFO_ON else 1

    def _clear(self, value: int) -> None:
        self._overrun = self._overrun and not value & _ORE


class SlcanLine:
    """Assembles lines from the bytes that the board sends."""

    def __init__(self, heard: Callable[[CanFrame], None]) -> None:
        """Starts at the beginning of a line.

        Args:
            heard: Called with each frame.
        """
        self._heard = heard
        self._text = bytearray()

    def take(self, byte: int) -> None:
        """Takes a byte that the board has sent. A line that is not a frame is dropped."""
        if byte != _LINE_END:
            self._text.append(byte)
            return
        frame = decode(bytes(self._text))
        self._text.clear()
        if frame is not None:
            self._heard(CanFrame(frame.id, frame.data))
