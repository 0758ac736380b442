"""The models of the serial line and of the CAN controller (bxCAN), register by register."""

import pytest

from host_sim.emulator.can import BxCan, CanFaults, CanFrame
from host_sim.emulator.clock import SECOND, Clock
from host_sim.emulator.registers import BoardError
from host_sim.emulator.serial import SlcanLine, Usart, UsartG4
from tests.image.support import read, write


class Port:
    """USART1 by itself, set up for 115200 baud from 72 MHz."""

    def __init__(self):
        self.clock, self.heard = Clock(72_000_000), []
        self.usart = Usart(self.clock, lambda: 72_000_000, self.heard.append)
        write(self.usart, 0x08, 625)
        write(self.usart, 0x0C, 1 << 13 | 3 << 2)

    def pass_us(self, us):
        self.clock.skip(us * SECOND // 10**6)

    def status(self):
        return read(self.usart, 0x00)


def test_bytes_arrive_at_the_speed_of_the_line():
    port = Port()
    port.usart.feed(b"ab")

    port.pass_us(86)
    early = port.status()
    port.pass_us(1)
    first = port.status(), read(port.usart, 0x04)
    port.pass_us(87)

    assert (early, first, read(port.usart, 0x04)) == (0xC0, (0xE0, ord("a")), ord("b"))
    assert port.status() == 0xC0


def test_unread_byte_causes_an_overrun():
    port = Port()
    port.usart.feed(b"abc")

    port.pass_us(200)
    status, byte = port.status(), read(port.usart, 0x04)
    port.pass_us(87)

    assert (status & 8, byte, port.status() & 8, read(port.usart, 0x04)) == (8, ord("a"), 0, ord("c"))


def test_transmitter_holds_two_bytes():
    port = Port()
    write(port.usart, 0x04, ord("x"))
    one = port.status()
    write(port.usart, 0x04, ord("y"))
    two = port.status()

    with pytest.raises(BoardError, match="TXE"):
        write(port.usart, 0x04, ord("z"))
    port.pass_us(87)
    assert (one & 0xC0, two & 0xC0, port.status() & 0xC0) == (0x80, 0, 0x80)
    port.pass_us(87)
    assert (bytes(port.heard), port.status() & 0xC0) == (b"xy", 0xC0)


def fifo_port(heard, setup=1 << 29 | 0xD):
    usart = UsartG4(Clock(80_000_000), lambda: 80_000_000, heard.append)
    write(usart, 0x0C, 694)
    write(usart, 0x00, setup)
    return usart


def test_fifo_keeps_eight_bytes_and_flags_an_overrun():
    usart = fifo_port([])
    usart.feed(b"abcdefghi")

    usart._clock.skip(SECOND // 1000)
    status = read(usart, 0x1C)
    taken = bytes(read(usart, 0x24) for _ in range(8))
    write(usart, 0x20, 8)

    assert (status & 0x28, taken, read(usart, 0x1C) & 0x28) == (0x28, b"abcdefgh", 0)


def test_transmitter_holds_nine_bytes_with_a_fifo():
    heard = []
    for setup, count in ((1 << 29 | 0xD, 9), (0xD, 2)):
        usart = fifo_port(heard, setup)
        for _ in range(count):
            assert read(usart, 0x1C) & 0x80
            write(usart, 0x28, ord("x"))
        with pytest.raises(BoardError, match="TXE is 0"):
            write(usart, 0x28, ord("x"))
        usart._clock.skip(SECOND // 1000)

    assert bytes(heard) == b"x" * 11


def test_invalid_fifo_setup_is_refused():
    usart = fifo_port([])

    with pytest.raises(BoardError, match="FIFOEN was changed while UE"):
        write(usart, 0x00, 0xD)
    with pytest.raises(BoardError, match="PRESC"):
        write(usart, 0x2C, 1)


def test_bytes_are_lost_without_the_receiver():
    port = Port()
    write(port.usart, 0x0C, 0)

    port.usart.feed(b"a")
    port.pass_us(100)

    assert port.status() == 0xC0


def test_wrong_baud_rate_or_interrupts_are_refused():
    usart = Usart(Clock(1), lambda: 8_000_000, lambda _byte: None)
    write(usart, 0x08, 625)

    with pytest.raises(BoardError, match="12800 baud"):
        write(usart, 0x0C, 1 << 13)
    with pytest.raises(BoardError, match="interrupts"):
        write(usart, 0x0C, 1 << 5)


def test_write_without_a_transmitter_is_refused():
    port = Port()
    for setup in (3 << 2, 1 << 13 | 1 << 2):
        write(port.usart, 0x0C, setup)
        with pytest.raises(BoardError, match="transmitter"):
            write(port.usart, 0x04, ord("x"))


def test_clock_change_makes_the_baud_rate_wrong():
    hz = [8_000_000]
    usart = Usart(Clock(1), lambda: hz[0], lambda _byte: None)
    write(usart, 0x08, 69)
    write(usart, 0x0C, 1 << 13 | 3 << 2)
    hz[0] = 72_000_000

    with pytest.raises(BoardError, match="1043478 baud"):
        write(usart, 0x04, ord("x"))


@pytest.mark.parametrize(("offset", "value"), [(0x0C, 1 << 12), (0x0C, 1 << 10), (0x10, 2 << 12), (0x14, 1 << 3)])
def test_unsupported_byte_format_is_refused(offset, value):
    with pytest.raises(BoardError, match="not modelled"):
        write(Port().usart, offset, value | (1 << 13 | 3 << 2) * (offset == 0x0C))


def test_malformed_slcan_lines_are_dropped():
    heard = []
    line = SlcanLine(heard.append)

    for byte in b"z\rt0811AB\r\r":
        line.take(byte)

    assert heard == [CanFrame(0x81, b"\xab")]


def controller(clock, heard, timing):
    """A controller on its way from initialization to the bus."""
    can = BxCan(clock, lambda: 42_000_000, CanFaults(), heard.append)
    write(can, 0x00, 1)
    clock.skip(SECOND // 10_000)
    write(can, 0x1C, timing)
    write(can, 0x00, 4)
    return can


def test_can_model_errors_are_raised_at_once_or_with_time(clock):
    can = controller(clock, [], 9 << 16 | 2 << 20 | 6)

    with pytest.raises(BoardError, match="428571 bit/s"):
        clock.skip(SECOND // 1000)
    with pytest.raises(BoardError, match="FIFO 0 was read, but the FIFO is empty"):
        read(can, 0x1B0)
    with pytest.raises(BoardError, match="interrupts"):
        write(can, 0x14, 1)
