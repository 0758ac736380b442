"""The models of timers, pins, the core and its system control, against the reference manuals."""

from functools import partial

import pytest

from host_sim.base.errors import OctetError
from host_sim.emulator.board import load_segments
from host_sim.emulator.c_models import c_models
from host_sim.emulator.chips import STM32F103
from host_sim.emulator.clock import SECOND
from host_sim.emulator.core import PAGE, Core
from host_sim.emulator.hardware import Faults, Hardware
from host_sim.emulator.ports import GpioF1, GpioF4, GpioG4
from host_sim.emulator.registers import BoardError
from host_sim.emulator.system import SystemControl, SysTick, Watchdog
from host_sim.sim.robot_process import PROGRAM
from tests.image.support import read, write


@pytest.mark.parametrize(("divided", "counts"), [(False, 8000), (True, 1000)])
def test_systick_counts_down_and_wraps(clock, divided, counts):
    systick = SysTick(clock)
    write(systick, 0x4, counts - 1)
    write(systick, 0x8, 0)
    write(systick, 0x0, 1 if divided else 5)

    clock.execute(8)
    early = read(systick, 0x8), read(systick, 0x0) >> 16
    clock.skip(SECOND // 1000)

    assert early == (counts - (1 if divided else 8), 0)
    assert read(systick, 0x8) == early[0]
    assert (read(systick, 0x0) >> 16, read(systick, 0x0) >> 16) == (1, 0)


def test_stopped_systick_does_not_count(clock):
    systick = SysTick(clock)

    clock.execute(100)

    assert (read(systick, 0x8), read(systick, 0x0)) == (0, 0)


def test_systick_interrupt_is_not_modelled(clock):
    with pytest.raises(BoardError, match="interrupt"):
        write(SysTick(clock), 0x0, 3)


def two_seconds(clock, bite):
    """A watchdog that is set up and waits for its start."""
    watchdog = Watchdog(clock, 32_000, bite)
    clock.skip(100 * SECOND)
    for offset, value in ((0x0, 0x5555), (0x4, 3), (0x8, 1999)):
        write(watchdog, offset, value)
    return watchdog


def test_watchdog_resets_when_it_is_not_fed_in_time(clock):
    bites = []
    watchdog = two_seconds(clock, lambda: bites.append(clock.now))
    write(watchdog, 0x0, 0xCCCC)

    for _ in range(3):
        clock.skip(19 * SECOND // 10)
        write(watchdog, 0x0, 0xAAAA)
    fed = list(bites)
    clock.skip(2 * SECOND)

    assert fed == []
    assert len(bites) == 1


@pytest.mark.parametrize("register", [0x4, 0x8])
def test_locked_watchdog_cannot_be_set_up(clock, register):
    watchdog = Watchdog(clock, 32_000, lambda: None)

    with pytest.raises(BoardError, match="locked"):
        write(watchdog, register, 5)

    assert read(watchdog, 0x8) == 0xFFF


def test_watchdog_reports_its_period(clock):
    watchdog = two_seconds(clock, lambda: None)
    stopped = watchdog.period_s()
    write(watchdog, 0x0, 0xCCCC)

    assert (stopped, watchdog.period_s()) == (0, 2)


@pytest.mark.parametrize("make", [GpioF1, GpioF4, GpioG4])
def test_bsrr_sets_and_clears_a_pin(make):
    port = make("GPIOC")
    bsrr = next(offset for offset, register in port.registers.items() if register.name == "BSRR")

    write(port, bsrr, 1 << 13)
    high = port.level(13)
    write(port, bsrr, 1 << 13 + 16)

    assert (high, port.level(13), port.level(12)) == (True, False, False)


def test_system_reset_needs_its_key():
    resets, moved = [], []
    scb = SystemControl(0, lambda: resets.append(1), moved.append)
    write(scb, 0x08, 0x08005100)

    with pytest.raises(BoardError, match="key"):
        write(scb, 0x0C, 4)
    write(scb, 0x0C, 0x05FA0004)

    assert (resets, moved) == ([1], [0x08005100])


def test_fault_in_the_fault_handler_locks_up_the_core(clock):
    core = Core(clock, vectors=0x20000000)
    core.add_ram(0x20000000, PAGE)  # all handlers are at 0, where nothing is
    core.reset()

    with pytest.raises(BoardError, match="locked up: a fault at 0x00000000"):
        core.run()


def test_ram_holds_noise_after_a_power_cut():
    board = Hardware(STM32F103, Faults(), lambda _frame: None, lambda _cause: None)
    board.flash_image([(0x08000000, bytes(8))])
    read_ram = partial(board.core._uc.mem_read, *STM32F103.ram[0])
    noise = read_ram()
    board.core.write(STM32F103.ram[0][0], bytes(PAGE))
    board.restart("software")
    kept = read_ram()
    board.restart("power")

    assert kept[:PAGE] == bytes(PAGE) != noise[:PAGE]
    assert read_ram() == noise


def test_fault_status_is_cleared_by_writing_ones():
    scb = SystemControl(0, lambda: None, lambda _address: None)
    scb.note_fault(1 << 9 | 1 << 12, 0x60000000)

    write(scb, 0x28, 1 << 9)

    assert (read(scb, 0x28), read(scb, 0x2C), read(scb, 0x38)) == (1 << 15 | 1 << 12, 1 << 30, 0x60000000)


def test_invalid_arm_image_is_reported(tmp_path):
    other = tmp_path / "robot.elf"
    other.write_bytes(b"not even that")

    for image, said in (
        (tmp_path / "none.elf", "cannot read the image"),
        (other, "cannot read the image"),
        (PROGRAM, "not a 32-bit ELF file for ARM"),
    ):
        with pytest.raises(OctetError, match=said):
            load_segments(image)


def test_missing_models_are_reported_with_the_setup_command(monkeypatch, tmp_path):
    monkeypatch.setattr("host_sim.emulator.c_models.LIBRARY", tmp_path / "none.so")
    c_models.cache_clear()

    with pytest.raises(OctetError, match="build them with tools/setup"):
        c_models()
