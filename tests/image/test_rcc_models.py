"""The models of the clocks (RCC), against the reference manuals: what they can make, and what they refuse."""

import pytest

from host_sim.emulator.board import start_board
from host_sim.emulator.chips import STM32F103, STM32F405, STM32G431
from host_sim.emulator.clock import SECOND
from host_sim.emulator.rcc import RccFaults
from host_sim.emulator.registers import BoardError
from tests.image.support import read, write


def rcc_of(chip, clock, faults=None, flash_hz=10**9):
    return chip.rcc(clock, chip.oscillators, lambda: flash_hz, faults or RccFaults())


def start(rcc, clock, bit):
    write(rcc, 0x00, read(rcc, 0x00) | 1 << bit)
    clock.skip(SECOND // 100)
    return bool(read(rcc, 0x00) >> bit & 2)


def start_pll(rcc, clock, setup):
    """From the crystal."""
    assert start(rcc, clock, 16)
    write(rcc, 0x04, setup)
    assert start(rcc, clock, 24)


def test_f4_runs_at_168_mhz(clock):
    rcc = rcc_of(STM32F405, clock)

    start_pll(rcc, clock, 7 << 24 | 1 << 22 | 336 << 6 | 12)
    write(rcc, 0x08, 5 << 10 | 4 << 13)
    write(rcc, 0x08, 5 << 10 | 4 << 13 | 2)

    assert read(rcc, 0x08) >> 2 & 3 == 2
    assert (clock.model.period_fs, rcc.core_hz()) == (SECOND // 168_000_000, 168_000_000)
    assert (rcc.apb1_hz(), rcc.apb2_hz()) == (42_000_000, 84_000_000)
    assert rcc.follows_crystal()


def test_g4_runs_at_80_mhz_with_a_selectable_can_clock(clock):
    rcc = rcc_of(STM32G431, clock)
    reset = read(rcc, 0x00), read(rcc, 0x08), rcc.core_hz(), rcc.can_hz()

    start(rcc, clock, 16)
    write(rcc, 0x0C, 1 << 24 | 40 << 8 | 5 << 4 | 3)
    start(rcc, clock, 24)
    write(rcc, 0x08, 3)
    speeds = []
    for choice in range(3):
        write(rcc, 0x88, choice << 24)
        speeds.append(rcc.can_hz())

    assert reset == (0x500, 5, 16_000_000, 0)
    assert (read(rcc, 0x08), rcc.core_hz(), rcc.usart_hz()) == (15, 80_000_000, 80_000_000)
    assert speeds == [24_000_000, 0, 80_000_000]
    assert rcc.follows_crystal()


@pytest.mark.parametrize(
    ("before", "switch", "name"),
    [
        (5 << 10 | 4 << 13, 4 << 10 | 4 << 13, "APB1 runs at 84000000 Hz, where 42000000"),
        (5 << 10 | 4 << 13, 5 << 10, "APB2 runs at 168000000 Hz, where 84000000"),
        (0, 5 << 10 | 4 << 13, "APB1 runs at 168000000 Hz"),
    ],
    ids=["APB1", "APB2", "all in one write"],
)
def test_momentarily_too_fast_bus_clock_is_refused(clock, before, switch, name):
    rcc = rcc_of(STM32F405, clock)
    start_pll(rcc, clock, 7 << 24 | 1 << 22 | 336 << 6 | 12)
    write(rcc, 0x08, before)

    with pytest.raises(BoardError, match=name):
        write(rcc, 0x08, switch | 2)


@pytest.mark.parametrize(
    ("chip", "setup"),
    [
        (STM32G431, 1 << 24 | 10 << 8 | 5 << 4 | 3),
        (STM32G431, 40 << 8 | 5 << 4 | 3),
        (STM32F405, 1 << 22 | 336 << 6 | 6),
        (STM32F405, 1 << 22 | 336 << 6 | 24),
        (STM32F405, 1 << 22 | 440 << 6 | 12),
        (STM32F405, 1 << 22 | 90 << 6 | 12),
        (STM32F103, 1 << 16 | 8 << 18),
    ],
)
def test_impossible_pll_setup_is_refused(clock, chip, setup):
    rcc = rcc_of(chip, clock)
    start(rcc, clock, 16)
    write(rcc, 0x0C if chip is STM32G431 else 0x04, setup)

    with pytest.raises(BoardError, match="start the PLL"):
        start(rcc, clock, 24)


def test_lowering_flash_wait_states_below_the_clock_is_refused():
    board = start_board("blue_pill")

    with pytest.raises(BoardError, match="wait states, runs at 72000000 Hz, where 24000000"):
        write(board.hardware.flash, 0x00, 0)


def test_f1_runs_at_72_mhz(clock):
    rcc = rcc_of(STM32F103, clock)

    start_pll(rcc, clock, 4 << 8 | 1 << 16 | 7 << 18)
    write(rcc, 0x04, 4 << 8 | 1 << 16 | 7 << 18 | 2)

    assert (clock.model.period_fs, rcc.apb1_hz()) == (SECOND // 72_000_000, 36_000_000)


def test_switch_to_a_stopped_oscillator_is_ignored(clock):
    rcc = rcc_of(STM32F405, clock, RccFaults(crystal_dead=True))

    assert not start(rcc, clock, 16)
    write(rcc, 0x08, 1)

    assert read(rcc, 0x08) >> 2 & 3 == 0


def test_clock_too_fast_for_flash_wait_states_is_refused(clock):
    rcc = rcc_of(STM32F405, clock, flash_hz=30_000_000)
    start_pll(rcc, clock, 1 << 22 | 336 << 6 | 12)
    write(rcc, 0x08, 5 << 10 | 4 << 13)

    with pytest.raises(BoardError, match="flash's wait states, runs at 168000000 Hz, where 30000000"):
        write(rcc, 0x08, 5 << 10 | 4 << 13 | 2)


@pytest.mark.parametrize(("chip", "setup"), [(STM32F405, 1 << 22 | 336 << 6 | 12), (STM32F103, 1 << 16 | 7 << 18)])
def test_pll_start_from_a_stopped_crystal_is_refused(clock, chip, setup):
    rcc = rcc_of(chip, clock)
    write(rcc, 0x04, setup)

    with pytest.raises(BoardError, match="start the PLL from an oscillator that does not run"):
        start(rcc, clock, 24)


def test_running_pll_cannot_be_set_up(clock):
    f4, f1 = rcc_of(STM32F405, clock), rcc_of(STM32F103, clock)
    for rcc in (f4, f1):
        start(rcc, clock, 24)

    with pytest.raises(BoardError, match="PLLCFGR was written while the PLL is on"):
        write(f4, 0x04, 0)
    write(f1, 0x04, 4 << 8 | 1 << 16 | 7 << 18)

    assert read(f1, 0x04) == 4 << 8


@pytest.mark.parametrize("stopped", [16, 24])
def test_clock_source_of_the_core_cannot_be_stopped(clock, stopped):
    rcc = rcc_of(STM32F103, clock)
    start_pll(rcc, clock, 4 << 8 | 1 << 16 | 7 << 18)
    write(rcc, 0x04, 4 << 8 | 1 << 16 | 7 << 18 | 2)

    with pytest.raises(BoardError, match="stop the clock that the core runs from"):
        write(rcc, 0x00, read(rcc, 0x00) & ~(1 << stopped))
    write(rcc, 0x04, 4 << 8 | 1 << 16 | 7 << 18)
    write(rcc, 0x00, 1)


def test_reset_flags_are_kept_until_cleared(clock):
    rcc = rcc_of(STM32F405, clock)
    rcc.restart("watchdog")
    noted = read(rcc, 0x74)

    write(rcc, 0x74, 1 << 24)
    rcc.restart("software")

    assert noted == 1 << 29 | 1 << 27 | 1 << 26 | 1 << 25
    assert read(rcc, 0x74) == 1 << 28 | 1 << 26
