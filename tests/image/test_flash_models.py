"""The models of both kinds of flash, against the reference manuals."""

import pytest

from host_sim.emulator.clock import SECOND
from host_sim.emulator.flash import FlashF1, FlashF4, FlashFaults, FlashG4
from host_sim.emulator.registers import BoardError, PowerCut
from tests.image.support import read, write

KEYR, SR, CR = 0x04, 0x0C, 0x10
G4_SR, G4_CR, ECCR, TWO_BITS = 0x10, 0x14, 0x18, 1 << 31
KEYS = (0x45670123, 0xCDEF89AB)


def unlocked(flash):
    for key in KEYS:
        write(flash, KEYR, key)
    return flash


def f1(clock, **faults):
    return unlocked(FlashF1(clock, FlashFaults(**faults)))


def f4(clock, **faults):
    return unlocked(FlashF4(clock, FlashFaults(**faults)))


def g4(clock, **faults):
    flash = FlashG4(clock, FlashFaults(**faults))
    for key in KEYS:
        write(flash, 0x08, key)
    write(flash, G4_CR, 1)
    write(flash, 0x00, 0)  # no data cache
    return flash


def write_double(flash, offset, low, high):
    flash.write(offset, 4, low)
    flash.write(offset + 4, 4, high)


def test_f1_erase_clears_its_page_only(clock):
    flash = f1(clock)
    flash.memory[:] = bytes(len(flash.memory))

    write(flash, CR, 1 << 1)
    write(flash, 0x14, 0x08000000 + 63 * 1024)
    write(flash, CR, 1 << 1 | 1 << 6)

    assert flash.memory[63 * 1024 :] == b"\xff" * 1024
    assert not any(flash.memory[: 63 * 1024])
    assert clock.now >= SECOND // 50


def test_f1_half_word_is_written_once(clock):
    flash = f1(clock)
    write(flash, CR, 1)

    flash.write(0x100, 2, 0x1234)
    first = read(flash, SR)
    flash.write(0x100, 2, 0x1200)

    assert (first, read(flash, SR)) == (0, 1 << 2)
    assert flash.read(0x100, 2) == 0x1234
    write(flash, SR, 1 << 2)
    flash.write(0x100, 2, 0)
    assert (flash.read(0x100, 2), read(flash, SR)) == (0, 0)


@pytest.mark.parametrize(
    ("make", "control", "width", "flag"),
    [(f1, 0, 2, 1 << 2), (f1, 1, 4, 1 << 2), (f1, 1, 1, 1 << 2), (f4, 0, 4, 1 << 7), (f4, 1, 4, 1 << 6)],
)
def test_writes_of_wrong_size_or_without_pg_bit_are_refused(clock, make, control, width, flag):
    flash = make(clock)
    write(flash, CR, control)

    flash.write(0x4000, width, 0x12)

    assert read(flash, SR) == flag
    assert flash.read(0x4000, 4) == 0xFFFFFFFF


def test_f4_erase_clears_its_sector_only(clock):
    flash = f4(clock)
    flash.memory[:] = bytes(len(flash.memory))

    write(flash, CR, 1 << 1 | 4 << 3 | 1 << 16)

    assert flash.memory.count(0xFF) == 64 << 10
    assert set(flash.memory[64 << 10 : 128 << 10]) == {0xFF}


def test_f4_write_only_clears_bits(clock):
    flash = f4(clock)
    write(flash, CR, 1 | 2 << 8)

    flash.write(0x4000, 4, 0xFFFF0F0F)
    flash.write(0x4000, 4, 0x0FFFFFFF)

    assert flash.read(0x4000, 4) == 0x0FFF0F0F
    assert read(flash, SR) == 0


@pytest.mark.parametrize(("make", "cr", "erase"), [(f4, CR, 1 << 1 | 1 << 16), (g4, G4_CR, 1 << 1 | 1 << 16)])
def test_erase_behind_an_enabled_data_cache_is_refused(clock, make, cr, erase):
    flash = make(clock)
    write(flash, 0x00, 1 << 10)

    with pytest.raises(BoardError, match="data cache"):
        write(flash, cr, erase)
    write(flash, 0x00, 0)
    write(flash, cr, erase)


def test_g4_data_cache_is_on_after_a_reset(clock):
    assert read(FlashG4(clock, FlashFaults()), 0x00) == 0x40600


def test_locked_flash_refuses_commands(clock):
    flash = FlashF4(clock, FlashFaults())

    with pytest.raises(BoardError, match="locked"):
        write(flash, CR, 1)
    with pytest.raises(BoardError, match="wrong key"):
        write(flash, KEYR, KEYS[1])


def test_write_to_the_image_itself_is_refused(clock):
    flash = f4(clock)
    flash.code_end = 0x4000
    write(flash, CR, 1 | 2 << 8)

    with pytest.raises(BoardError, match="change itself at 0x08001000"):
        flash.write(0x1000, 4, 0)
    with pytest.raises(BoardError, match="change itself"):
        write(flash, CR, 1 << 1 | 1 << 16)


def test_missing_page_is_named(clock):
    flash = f1(clock)
    write(flash, 0x14, 0x08010000)

    write(flash, CR, 2)
    with pytest.raises(BoardError, match="page 64"):
        write(flash, CR, 2 | 1 << 6)


def test_injected_write_failure_sets_the_error_flag(clock):
    flash = f4(clock, failing=frozenset({2}))
    write(flash, CR, 1 | 2 << 8)

    for offset in (0x4000, 0x4004, 0x4008):
        flash.write(offset, 4, 0)

    assert [flash.read(offset, 4) for offset in (0x4000, 0x4004, 0x4008)] == [0, 0xFFFFFFFF, 0]
    assert read(flash, SR) == 1 << 1


def test_injected_power_cut_leaves_a_partial_write(clock):
    flash = f1(clock, cut_at=1)
    write(flash, CR, 1)

    with pytest.raises(PowerCut):
        flash.write(0x100, 2, 0)

    assert flash.read(0x100, 2) == 0x0F0F


@pytest.mark.parametrize("make", [f1, f4])
def test_page_with_an_interrupted_erase_takes_only_zeros(clock, make):
    flash = make(clock)
    flash.erasure_cuts.add(1)
    page, size = 3, flash.pages[3]
    start = sum(flash.pages[:page])
    flash.memory[start : start + size] = bytes(size)
    if make is f1:
        write(flash, CR, 1 << 1)
        write(flash, 0x14, 0x08000000 + start)
    erase = (1 << 1 | 1 << 6) if make is f1 else (1 << 1 | page << 3 | 1 << 16)

    with pytest.raises(PowerCut):
        write(flash, CR, erase)

    assert (flash.read(start + 12, 4), flash.read(start + 16, 4)) == (0, 0xFFFFFFFF)
    with pytest.raises(BoardError, match="cut short"):
        flash.write(start + 16, 2, 1)
    flash.write(start + 16, 2, 0)


def test_g4_writes_two_words_at_once(clock):
    flash = g4(clock)

    flash.write(0x1F000, 4, 1)
    before = flash.read(0x1F000, 4)
    flash.write(0x1F004, 4, 2)

    assert before == 0xFFFFFFFF
    assert (flash.read(0x1F000, 4), flash.read(0x1F004, 4), read(flash, G4_SR)) == (1, 2, 0)
    assert flash.operations == 1


@pytest.mark.parametrize(
    ("writes", "flag"),
    [
        ([(0x1F004, 4)], 1 << 5),
        ([(0x1F000, 4), (0x1F008, 4)], 1 << 5),
        ([(0x1F000, 2)], 1 << 6),
        ([(0x1F000, 4), (0x1F004, 4), (0x1F000, 4), (0x1F004, 4)], 1 << 3),
        ([(0x1F000, 2), (0x1F000, 4)], 1 << 6 | 1 << 7),
    ],
    ids=["second half", "another pair", "half-word", "twice", "after an error"],
)
def test_g4_refuses_other_writes(clock, writes, flag):
    flash = g4(clock)

    for offset, size in writes:
        flash.write(offset, size, 0x12)

    assert read(flash, G4_SR) == flag


def test_g4_refuses_writes_without_pg_bit_and_takes_zeros(clock):
    flash = g4(clock)
    write_double(flash, 0x1F000, 1, 2)
    write_double(flash, 0x1F000, 0, 0)
    zeroed = flash.read(0x1F000, 4), flash.read(0x1F004, 4), read(flash, G4_SR)
    write(flash, G4_CR, 0)

    write_double(flash, 0x1F008, 1, 2)

    assert zeroed == (0, 0, 0)
    assert (flash.read(0x1F008, 4), read(flash, G4_SR)) == (0xFFFFFFFF, 1 << 7)


def test_g4_interrupted_write_is_an_uncorrectable_ecc_error(clock):
    flash, told = g4(clock, cut_at=1), []
    flash.on_unreadable = lambda: told.append(read(flash, ECCR))

    with pytest.raises(PowerCut):
        write_double(flash, 0x1F010, 1, 2)
    flash.read(0x1F008, 4)
    calm = list(told)
    flash.read(0x1F014, 4)
    write(flash, ECCR, TWO_BITS)

    assert (calm, told, read(flash, ECCR)) == ([], [TWO_BITS | 0x1F010], 0)
    write_double(flash, 0x1F010, 3, 4)
    assert read(flash, G4_SR) == 1 << 3
    write(flash, G4_SR, 1 << 3)
    write_double(flash, 0x1F010, 0, 0)
    assert flash.read(0x1F010, 4) == 0
    assert len(told) == 1


def test_g4_erase_clears_ecc_errors_up_to_a_cut(clock):
    flash = g4(clock)
    flash.unreadable = {0x1F000, 0x1F800, 0x1F808, 0x1F810}
    write(flash, G4_CR, 2 | 62 << 3 | 1 << 16)
    flash.erasure_cuts.add(2)

    with pytest.raises(PowerCut):
        write(flash, G4_CR, 2 | 63 << 3 | 1 << 16)

    assert flash.unreadable == {0x1F800, 0x1F808}
