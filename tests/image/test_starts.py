"""Every image starts, whatever its stores hold, with interrupts taken as ARMv7-M takes them."""

import struct
from zlib import crc32

import pytest

from host_sim.base.paths import BUILD
from host_sim.emulator.board import EmulatedBoard, load_segments
from host_sim.emulator.chips import CHIPS
from tests.image.calibrate_cuts import RECORD, STORES

IMAGES = [(board, kind) for board, chip in CHIPS.items() for kind in (chip.link, "slcan")] + [
    (board, kind) for board, chip in CHIPS.items() if chip.converter for kind in ("pins", "mute", "body")
]
MEMORY = bytes((0, 2, 0, 0, 0, 0, 0, 0))
INTERRUPTS = {"blue_pill": 43, "feather_stm32f405": 82, "nucleo_g431rb": 102}
"""Of the chips, by RM0008 10.1.2, RM0090 12.2 and RM0440 14.3."""

STORE_COUNT = 3
"""One of the memory, two of a body on pins."""

STARTED_S = 2.0
"""Longer than the longest erases take."""


def record(number: int, data: bytes, *, mark: bool = False) -> bytes:
    """One of the store's, or the mark that a completed erase leaves (flash_store.h)."""
    held = struct.pack("<I8s", number, data)
    return held + struct.pack("<I", crc32(held) ^ (0xFFFFFFFF if mark else 0))


def page(kind: str, size: int, first: int) -> bytes:
    """A page of the store that is blank, full, or has room."""
    if kind == "blank":
        return b"\xff" * size
    count = size // RECORD - 1 if kind == "full" else 1
    return (record(0, bytes(8), mark=True) + b"".join(record(first + i, MEMORY) for i in range(count))).ljust(
        size, b"\xff"
    )


def fill(board: EmulatedBoard, kind: str) -> None:
    """Gives the memory, and the traits of a body, stores of that kind."""
    flash, chip = board.hardware.flash, board.hardware.chip
    begin, end = STORES[chip.name]
    size = (end - begin) // 2
    for at in range(begin - (4 * size if chip.converter else 0), end, 2 * size):
        other = "blank" if kind == "roomy" else kind
        flash.memory[at : at + 2 * size] = page(kind, size, 10_000) + page(other, size, 1)


@pytest.mark.parametrize("kind", ["blank", "full", "roomy"])
@pytest.mark.parametrize(("name", "link"), IMAGES)
def test_images_start_and_erase_no_page_twice(name, link, kind):
    image = BUILD / name / f"octet-{name}-{link}.elf"
    board = EmulatedBoard(CHIPS[name], image, serial=link == "slcan")
    fill(board, kind)
    board.cut_power()
    erased = board.hardware.flash.erasures

    board.pass_time(STARTED_S)

    assert (board.resets, board.hardware.faults) == (["power"], [])
    assert board.hardware.flash.erasures - erased <= (0 if kind == "roomy" else STORE_COUNT)


@pytest.mark.parametrize(("name", "link"), IMAGES)
def test_interrupt_vectors_lead_to_the_crash_handler(name, link):
    image = load_segments(BUILD / name / f"octet-{name}-{link}.elf")[0][1]
    _, _, _, hard_fault, *_ = vectors = struct.unpack_from(f"<{16 + INTERRUPTS[name]}I", image)

    assert hard_fault & 1
    assert set(vectors[16:]) == {hard_fault}
