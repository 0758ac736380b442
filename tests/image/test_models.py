"""The models of clocks, timers, pins and the core, against the reference manuals."""

import pytest

from host_sim.backends.robot_process import PROGRAM
from host_sim.emulator.board import start_board
from host_sim.emulator.c_models import c_models
from host_sim.emulator.can import BxCan, CanFaults, CanFrame
from host_sim.emulator.chips import STM32F103, STM32F405
from host_sim.emulator.clock import SECOND
from host_sim.emulator.core import PAGE, Core, load_segments
from host_sim.emulator.rcc import RccFaults
from host_sim.emulator.registers import AddressSpace, BoardError, Peripheral, Register
from host_sim.emulator.system import SystemControl, SysTick, Watchdog, gpio_f1, gpio_f4
from host_sim.errors import OctetError
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


def test_a_systick_at_rest_stays(clock):
    systick = SysTick(clock)

    clock.execute(100)

    assert (read(systick, 0x8), read(systick, 0x0)) == (0, 0)


def test_the_interrupt_of_systick_is_not_modelled(clock):
    with pytest.raises(BoardError, match="interrupt"):
        write(SysTick(clock), 0x0, 3)


def test_a_watchdog_bites_when_its_time_is_over(clock):
    bites = []
    watchdog = Watchdog(clock, 32_000, lambda: bites.append(clock.now))
    clock.skip(100 * SECOND)
    write(watchdog, 0x0, 0x5555)
    write(watchdog, 0x4, 3)
    write(watchdog, 0x8, 1999)
    write(watchdog, 0x0, 0xCCCC)

    for _ in range(3):
        clock.skip(19 * SECOND // 10)
        write(watchdog, 0x0, 0xAAAA)
    fed = list(bites)
    clock.skip(2 * SECOND)

    assert fed == []
    assert len(bites) == 1


@pytest.mark.parametrize("register", [0x4, 0x8])
def test_a_watchdog_that_is_locked_is_not_set_up(clock, register):
    watchdog = Watchdog(clock, 32_000, lambda: None)

    with pytest.raises(BoardError, match="locked"):
        write(watchdog, register, 5)

    assert read(watchdog, 0x8) == 0xFFF


def test_a_watchdog_tells_its_period(clock):
    watchdog = Watchdog(clock, 32_000, lambda: None)
    write(watchdog, 0x0, 0x5555)
    write(watchdog, 0x4, 3)
    write(watchdog, 0x8, 1999)
    stopped = watchdog.period_s()
    write(watchdog, 0x0, 0xCCCC)

    assert (stopped, watchdog.period_s()) == (0, 2)


@pytest.mark.parametrize("make", [gpio_f1, gpio_f4])
def test_a_pin_is_set_and_cleared(make):
    port = make("GPIOC")
    bsrr = next(offset for offset, register in port.registers.items() if register.name == "BSRR")

    write(port, bsrr, 1 << 13)
    high = port.level(13)
    write(port, bsrr, 1 << 13 + 16)

    assert (high, port.level(13), port.level(12)) == (True, False, False)


def rcc_of(chip, clock, faults=None, flash_hz=10**9):
    return chip.rcc(clock, chip.oscillators, lambda: flash_hz, faults or RccFaults())


def start(rcc, clock, bit):
    write(rcc, 0x00, read(rcc, 0x00) | 1 << bit)
    clock.skip(SECOND // 100)
    return bool(read(rcc, 0x00) >> bit & 2)


def test_an_f4_runs_at_168_mhz(clock):
    rcc = rcc_of(STM32F405, clock)

    assert start(rcc, clock, 16)
    write(rcc, 0x04, 7 << 24 | 1 << 22 | 336 << 6 | 12)
    assert start(rcc, clock, 24)
    write(rcc, 0x08, 5 << 10 | 4 << 13)
    write(rcc, 0x08, 5 << 10 | 4 << 13 | 2)

    assert read(rcc, 0x08) >> 2 & 3 == 2
    assert (clock.period, rcc.core_hz()) == (SECOND // 168_000_000, 168_000_000)
    assert (rcc.apb1_hz(), rcc.apb2_hz()) == (42_000_000, 84_000_000)
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
def test_a_bus_that_is_too_fast_even_for_a_moment_is_an_error(clock, before, switch, name):
    rcc = rcc_of(STM32F405, clock)
    start(rcc, clock, 16)
    write(rcc, 0x04, 7 << 24 | 1 << 22 | 336 << 6 | 12)
    start(rcc, clock, 24)
    write(rcc, 0x08, before)

    with pytest.raises(BoardError, match=name):
        write(rcc, 0x08, switch | 2)


@pytest.mark.parametrize(
    ("chip", "setup"),
    [
        (STM32F405, 1 << 22 | 336 << 6 | 6),
        (STM32F405, 1 << 22 | 336 << 6 | 24),
        (STM32F405, 1 << 22 | 440 << 6 | 12),
        (STM32F405, 1 << 22 | 90 << 6 | 12),
        (STM32F103, 1 << 16 | 8 << 18),
    ],
)
def test_a_pll_is_not_asked_for_what_it_cannot_make(clock, chip, setup):
    rcc = rcc_of(chip, clock)
    start(rcc, clock, 16)
    write(rcc, 0x04, setup)

    with pytest.raises(BoardError, match="start the PLL"):
        start(rcc, clock, 24)


def test_flash_that_becomes_too_slow_for_the_clock_is_an_error():
    board = start_board("blue_pill")

    with pytest.raises(BoardError, match="wait states, runs at 72000000 Hz, where 24000000"):
        write(board.hardware.flash, 0x00, 0)


def test_an_f1_runs_at_72_mhz(clock):
    rcc = rcc_of(STM32F103, clock)

    assert start(rcc, clock, 16)
    write(rcc, 0x04, 4 << 8 | 1 << 16 | 7 << 18)
    assert start(rcc, clock, 24)
    write(rcc, 0x04, 4 << 8 | 1 << 16 | 7 << 18 | 2)

    assert (clock.period, rcc.apb1_hz()) == (SECOND // 72_000_000, 36_000_000)


def test_a_clock_that_does_not_run_is_not_switched_to(clock):
    rcc = rcc_of(STM32F405, clock, RccFaults(crystal_dead=True))

    assert not start(rcc, clock, 16)
    write(rcc, 0x08, 1)

    assert read(rcc, 0x08) >> 2 & 3 == 0


def test_a_clock_too_fast_for_the_flash_is_an_error(clock):
    rcc = rcc_of(STM32F405, clock, flash_hz=30_000_000)
    start(rcc, clock, 16)
    write(rcc, 0x04, 1 << 22 | 336 << 6 | 12)
    start(rcc, clock, 24)
    write(rcc, 0x08, 5 << 10 | 4 << 13)

    with pytest.raises(BoardError, match="flash's wait states, runs at 168000000 Hz, where 30000000"):
        write(rcc, 0x08, 5 << 10 | 4 << 13 | 2)


@pytest.mark.parametrize(("chip", "setup"), [(STM32F405, 1 << 22 | 336 << 6 | 12), (STM32F103, 1 << 16 | 7 << 18)])
def test_a_pll_does_not_start_from_a_crystal_that_does_not_run(clock, chip, setup):
    rcc = rcc_of(chip, clock)
    write(rcc, 0x04, setup)

    with pytest.raises(BoardError, match="start the PLL from an oscillator that does not run"):
        start(rcc, clock, 24)


def test_a_pll_is_not_set_up_while_it_is_on(clock):
    f4, f1 = rcc_of(STM32F405, clock), rcc_of(STM32F103, clock)
    for rcc in (f4, f1):
        start(rcc, clock, 24)

    with pytest.raises(BoardError, match="PLLCFGR was written while the PLL is on"):
        write(f4, 0x04, 0)
    write(f1, 0x04, 4 << 8 | 1 << 16 | 7 << 18)

    assert read(f1, 0x04) == 4 << 8


def test_causes_of_resets_are_noted_until_cleared(clock):
    rcc = rcc_of(STM32F405, clock)
    rcc.restart("watchdog")
    noted = read(rcc, 0x74)

    write(rcc, 0x74, 1 << 24)
    rcc.restart("software")

    assert noted == 1 << 29 | 1 << 27 | 1 << 26
    assert read(rcc, 0x74) == 1 << 28 | 1 << 26


def test_a_reset_needs_its_key():
    resets = []
    scb = SystemControl(0, lambda: resets.append(1))

    with pytest.raises(BoardError, match="key"):
        write(scb, 0x0C, 4)
    write(scb, 0x0C, 0x05FA0004)

    assert resets == [1]


def test_a_core_that_faults_in_its_fault_handler_locks_up(clock):
    core = Core(clock, vectors=0x20000000)
    core.add_ram(0x20000000, PAGE)  # all handlers are at 0, where nothing is
    core.reset()

    with pytest.raises(BoardError, match="locked up: a fault at 0x00000000"):
        core.run()


def test_the_causes_of_faults_are_cleared_by_writing_ones():
    scb = SystemControl(0, lambda: None)
    scb.note_fault(1 << 9 | 1 << 12, 0x60000000)

    write(scb, 0x28, 1 << 9)

    assert (read(scb, 0x28), read(scb, 0x2C), read(scb, 0x38)) == (1 << 15 | 1 << 12, 1 << 30, 0x60000000)


def test_what_is_no_image_for_arm_is_named(tmp_path):
    other = tmp_path / "robot.elf"

    with pytest.raises(OctetError, match="cannot read the image"):
        load_segments(other)
    other.write_bytes(b"not even that")
    with pytest.raises(OctetError, match="cannot read the image"):
        load_segments(other)
    with pytest.raises(OctetError, match="not a 32-bit ELF file for ARM"):
        load_segments(PROGRAM)


@pytest.fixture
def space(clock):
    made = AddressSpace(clock)
    counter = Register("COUNT", on_read=lambda: clock.cycles, steady=False)
    made.attach(0x40000000, Peripheral("THING", {0x0: Register("A"), 0x4: Register("B"), 0x8: counter}, clocked=True))
    made.attach(0x40001000, Peripheral("SLEEPER", {0x0: Register("C")}))
    return made


def test_a_register_that_is_not_modelled_is_named(space):
    with pytest.raises(BoardError, match=r"0x4000000C was read, .* \(0x40000008 is THING COUNT\)"):
        space.read(0x4000000C, 4)
    with pytest.raises(BoardError, match="0x3FFFFFFC was written"):
        space.write(0x3FFFFFFC, 4, 0)


def test_a_peripheral_without_clock_is_named(space):
    with pytest.raises(BoardError, match="SLEEPER has no clock"):
        space.read(0x40001000, 4)


def test_a_register_is_accessed_as_a_whole(space):
    with pytest.raises(BoardError, match="THING A was written by 1 bytes"):
        space.write(0x40000000, 1, 0)


def test_time_is_skipped_for_who_waits_and_looks_at_the_time(space, clock):
    for _ in range(20):
        space.read(0x40000000, 4)
        space.read(0x40000008, 4)

    assert clock.now >= SECOND // 1000


def test_no_time_is_skipped_for_who_counts_or_works(space, clock):
    for _ in range(100):
        space.read(0x40000000, 4)
        space.read(0x40000004, 4)
    space.write(0x40000000, 4, 1)
    for i in range(100):
        space.read(0x40000008, 4)
        space.read(0x40000000, 4)
        space.write(0x40000004, 4, i)

    assert clock.now == 0


def test_events_happen_in_their_order_while_time_is_skipped(clock):
    seen = []
    moments = {"a": [3, 9], "b": [5]}

    def timed(name):
        def due():
            while moments[name] and moments[name][0] <= clock.now:
                seen.append((name, moments[name].pop(0)))
            return moments[name][0] if moments[name] else 2**127

        return due

    for name in moments:
        clock.add(timed(name))
    clock.expect(0)
    clock.settle()
    clock.skip(10)

    assert seen == [("a", 3), ("b", 5), ("a", 9)]


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


def test_models_that_are_not_built_are_named_with_how_to_build_them(monkeypatch, tmp_path):
    monkeypatch.setattr("host_sim.emulator.c_models.LIBRARY", tmp_path / "none.so")
    c_models.cache_clear()

    with pytest.raises(OctetError, match="build them with tools/setup"):
        c_models()
