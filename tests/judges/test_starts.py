"""Unmodified flash images start in LabWired, an emulator that takes interrupts, whatever their flash holds."""

import struct
import zlib

import pytest

from tests.judges.labwired_board import Board

PLACE = struct.Struct("<I8s")
"""A record of the store without its CRC: its number, and eight bytes."""


def record(number: int, memory: bytes) -> bytes:
    """A record, by the description in flash_store.h."""
    data = PLACE.pack(number, memory)
    return data + struct.pack("<I", zlib.crc32(data))


def page(records: int) -> bytes:
    """A page that was erased, which its mark says, and written."""
    mark = PLACE.pack(0, bytes(8))
    written = b"".join(record(number, bytes((0, 1 + number % 2, *bytes(6)))) for number in range(1, records + 1))
    return mark + struct.pack("<I", ~zlib.crc32(mark) & 0xFFFFFFFF) + written


STORES = {
    "blue_pill": (0x0800F800, 0x0800E800, 0x0800F000, 1024),
    "feather_stm32f405": (0x08004000, 16384),
    "nucleo_g431rb": (0x0801F000, 2048),
}
"""The first page of each store of a board, and the size of a page."""
FILLS = {"blank": 0, "full": -1, "roomy": 3}
IMAGES = [
    *(("blue_pill", link) for link in ("bxcan", "slcan", "pins", "mute", "body")),
    *(("feather_stm32f405", link) for link in ("bxcan", "slcan")),
    ("nucleo_g431rb", "slcan"),
]
GPIOB_ODR, INFRARED = 0x40010C0C, 13
"""The pin that lights the sensors in one of four beats."""
BOOT_STEPS = 2000
"""In steps of 250 us: at an eighth of the clock, a look at each record of an F405 takes long."""


def fill(board: Board, name: str, fill: str) -> None:
    """Fills the stores."""
    *pages, size = STORES[name]
    for at in pages if fill != "blank" else ():
        board.flash(at, page(size // 16 - 1 if fill == "full" else 3))


def is_alive(board: Board, link: str) -> bool:
    """Whether the robot says that it has started, or that it senses; one without CAN lights its sensors."""
    lit = set()
    for _ in range(BOOT_STEPS):
        if board.listen("250us"):
            return True
        if link == "mute":
            lit.add(board.sim.read_u32(GPIOB_ODR) >> INFRARED & 1)
        if lit == {0, 1}:
            return True
    return False


@pytest.mark.parametrize("fills", FILLS)
@pytest.mark.parametrize(("name", "link"), IMAGES)
def test_an_image_starts(name, link, fills, tmp_path):
    board = Board(name, link, tmp_path)
    fill(board, name, fills)

    assert is_alive(board, link)


@pytest.mark.parametrize("fills", ["blank", "full"])
@pytest.mark.parametrize("link", ["pins", "mute", "body"])
def test_a_stand_alone_robot_survives_a_beat_in_an_erase(link, fills, tmp_path):
    """LabWired erases in no time, so the beat is made pending in each erase, as it would be after 5 of its 20 ms."""
    board = Board("blue_pill", link, tmp_path)
    fill(board, "blue_pill", fills)
    erases = was = 0

    for _ in range(20_000):
        board.sim.run_for("1us")
        control = board.sim.read_u32(0x40022010) & 0x42
        if control == 0x42 != was:
            erases += 1
            board.sim.write_u32(0xE000E200, 1 << 25)
        was = control

    assert erases > 0
    assert is_alive(board, link)
