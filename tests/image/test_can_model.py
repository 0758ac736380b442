"""The model of the CAN controller (bxCAN), register by register."""

import pytest

from host_sim.emulator.can import BxCan, CanFaults, CanFrame
from host_sim.emulator.clock import SECOND
from host_sim.emulator.registers import BoardError
from tests.image.support import read, write


def controller(clock, heard, timing):
    """A controller on its way from initialization to the bus."""
    can = BxCan(clock, lambda: 42_000_000, 14, CanFaults(), heard.append)
    write(can, 0x00, 1)
    clock.skip(SECOND // 10_000)
    write(can, 0x1C, timing)
    write(can, 0x00, 4)
    return can


def test_the_model_of_can_sends_and_receives_frames_of_any_kind(clock):
    heard = []
    can = controller(clock, heard, 9 << 16 | 2 << 20 | 5)
    for offset, value in ((0x20C, 1), (0x240, 0), (0x244, 0), (0x21C, 1), (0x200, 0)):  # let everything pass
        write(can, offset, value)
    can.put(CanFrame(0x1ABCDEF0, b"\x01\x02", extended=True))

    clock.skip(SECOND // 1000)
    for offset, value in ((0x194, 2), (0x198, 0xBBAA), (0x19C, 0), (0x190, 0x81 << 21 | 3)):
        write(can, offset, value)
    clock.skip(SECOND // 1000)

    assert (read(can, 0x0C), read(can, 0x1B0), read(can, 0x1B8)) == (1, 0x1ABCDEF0 << 3 | 4, 0x0201)
    assert heard == [CanFrame(0x81, bytes(2), remote=True)]


def test_what_the_model_of_can_refuses_is_an_error_at_once_or_when_time_passes(clock):
    can = controller(clock, [], 9 << 16 | 2 << 20 | 6)

    with pytest.raises(BoardError, match="428571 bit/s"):
        clock.skip(SECOND // 1000)
    with pytest.raises(BoardError, match="FIFO 0 was read, but the FIFO is empty"):
        read(can, 0x1B0)
    with pytest.raises(BoardError, match="interrupts"):
        write(can, 0x14, 1)
