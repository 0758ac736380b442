"""The models beside bxCAN, against the reference manuals."""

import pytest

from host_sim.emulated.address_space import AddressSpace
from host_sim.emulated.can_frame import CanFrame
from host_sim.emulated.chips import STM32F103, STM32F405
from host_sim.emulated.clock import SECOND, Clock
from host_sim.emulated.core import PAGE, Core
from host_sim.emulated.elf import load_segments
from host_sim.emulated.errors import BoardError, PowerCut
from host_sim.emulated.flash import FlashFaults
from host_sim.emulated.flash_f1 import FlashF1
from host_sim.emulated.flash_f4 import FlashF4
from host_sim.emulated.gpio import gpio_f1, gpio_f4
from host_sim.emulated.rcc import RccFaults
from host_sim.emulated.registers import Peripheral, Register
from host_sim.emulated.slcan_line import SlcanLine
from host_sim.emulated.system_control import SystemControl
from host_sim.emulated.systick import SysTick
from host_sim.emulated.usart import Usart
from host_sim.emulated.watchdog import Watchdog
from host_sim.errors import OctetError
from host_sim.robots.robot_process import PROGRAM

KEYR, SR, CR = 0x04, 0x0C, 0x10
KEYS = (0x45670123, 0xCDEF89AB)


@pytest.fixture
def clock():
    return Clock(8_000_000)


def write(peripheral, offset, value):
    peripheral.registers[offset].write(value)


def read(peripheral, offset):
    return peripheral.registers[offset].read()


def unlocked(flash):
    for key in KEYS:
        write(flash, KEYR, key)
    return flash


def f1(clock, **faults):
    return unlocked(FlashF1(clock, FlashFaults(**faults)))


def f4(clock, **faults):
    return unlocked(FlashF4(clock, FlashFaults(**faults)))


def test_an_f1_page_is_erased_and_nothing_else(clock):
    flash = f1(clock)
    flash.memory[:] = bytes(len(flash.memory))

    write(flash, CR, 1 << 1)
    write(flash, 0x14, 0x08000000 + 63 * 1024)
    write(flash, CR, 1 << 1 | 1 << 6)

    assert flash.memory[63 * 1024 :] == b"\xff" * 1024
    assert not any(flash.memory[: 63 * 1024])
    assert clock.now >= SECOND // 50


def test_an_f1_half_word_is_written_once(clock):
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


@pytest.mark.parametrize(("programming", "width"), [(0, 2), (1, 4), (1, 1)])
def test_an_f1_refuses_other_writes(clock, programming, width):
    flash = f1(clock)
    write(flash, CR, programming)

    flash.write(0x100, width, 0x12)

    assert read(flash, SR) == 1 << 2
    assert flash.read(0x100, 2) == 0xFFFF


def test_an_f4_sector_is_erased_and_nothing_else(clock):
    flash = f4(clock)
    flash.memory[:] = bytes(len(flash.memory))

    write(flash, CR, 1 << 1 | 4 << 3 | 1 << 16)

    assert flash.memory.count(0xFF) == 64 << 10
    assert set(flash.memory[64 << 10 : 128 << 10]) == {0xFF}


def test_an_f4_write_clears_bits_and_sets_none(clock):
    flash = f4(clock)
    write(flash, CR, 1 | 2 << 8)

    flash.write(0x4000, 4, 0xFFFF0F0F)
    flash.write(0x4000, 4, 0x0FFFFFFF)

    assert flash.read(0x4000, 4) == 0x0FFF0F0F
    assert read(flash, SR) == 0


@pytest.mark.parametrize(("control", "flag"), [(0, 1 << 7), (1, 1 << 6)])
def test_an_f4_refuses_writes_of_another_size_or_without_consent(clock, control, flag):
    flash = f4(clock)
    write(flash, CR, control)

    flash.write(0x4000, 4, 0)

    assert read(flash, SR) == flag
    assert flash.read(0x4000, 4) == 0xFFFFFFFF


def test_a_locked_flash_takes_no_orders(clock):
    flash = FlashF4(clock, FlashFaults())

    with pytest.raises(BoardError, match="locked"):
        write(flash, CR, 1)
    with pytest.raises(BoardError, match="wrong key"):
        write(flash, KEYR, KEYS[1])


def test_the_image_cannot_change_itself(clock):
    flash = f4(clock)
    flash.code_end = 0x4000
    write(flash, CR, 1 | 2 << 8)

    with pytest.raises(BoardError, match="change itself at 0x08001000"):
        flash.write(0x1000, 4, 0)
    with pytest.raises(BoardError, match="change itself"):
        write(flash, CR, 1 << 1 | 1 << 16)


def test_a_page_that_does_not_exist_is_named(clock):
    flash = f1(clock)
    write(flash, 0x14, 0x08010000)

    write(flash, CR, 2)
    with pytest.raises(BoardError, match="page 64"):
        write(flash, CR, 2 | 1 << 6)


def test_a_write_can_be_made_to_fail(clock):
    flash = f4(clock, failing=frozenset({2}))
    write(flash, CR, 1 | 2 << 8)

    for offset in (0x4000, 0x4004, 0x4008):
        flash.write(offset, 4, 0)

    assert [flash.read(offset, 4) for offset in (0x4000, 0x4004, 0x4008)] == [0, 0xFFFFFFFF, 0]
    assert read(flash, SR) == 1 << 1


def test_a_write_can_be_cut_in_the_middle(clock):
    flash = f1(clock, cut_at=1)
    write(flash, CR, 1)

    with pytest.raises(PowerCut):
        flash.write(0x100, 2, 0)

    assert flash.read(0x100, 2) == 0x0F0F


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


def test_a_watchdog_that_is_locked_keeps_its_time(clock):
    watchdog = Watchdog(clock, 32_000, lambda: None)

    write(watchdog, 0x8, 5)

    assert read(watchdog, 0x8) == 0xFFF


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
    write(rcc, 0x08, 5 << 10 | 4 << 13 | 2)

    assert read(rcc, 0x08) >> 2 & 3 == 2
    assert (clock.period, rcc.apb1_hz()) == (SECOND // 168_000_000, 42_000_000)


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

    with pytest.raises(BoardError, match="flash's wait states, runs at 168000000 Hz, where 30000000"):
        write(rcc, 0x08, 5 << 10 | 4 << 13 | 2)


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
    with pytest.raises(OctetError, match="for another machine: EM_X86_64"):
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


def test_bytes_come_one_by_one_at_the_lines_speed():
    port = Port()
    port.usart.feed(b"ab")

    port.pass_us(86)
    early = port.status()
    port.pass_us(1)
    first = port.status(), read(port.usart, 0x04)
    port.pass_us(87)

    assert (early, first, read(port.usart, 0x04)) == (0xC0, (0xE0, ord("a")), ord("b"))
    assert port.status() == 0xC0


def test_a_byte_that_is_not_taken_costs_the_next():
    port = Port()
    port.usart.feed(b"abc")

    port.pass_us(200)
    status, byte = port.status(), read(port.usart, 0x04)
    port.pass_us(87)

    assert (status & 8, byte, port.status() & 8, read(port.usart, 0x04)) == (8, ord("a"), 0, ord("c"))


def test_two_bytes_can_be_on_their_way_out():
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


def test_without_its_receiver_bytes_are_lost():
    port = Port()
    write(port.usart, 0x0C, 0)

    port.usart.feed(b"a")
    port.pass_us(100)

    assert port.status() == 0xC0


def test_another_speed_than_the_lines_is_an_error():
    usart = Usart(Clock(1), lambda: 8_000_000, lambda _byte: None)
    write(usart, 0x08, 625)

    with pytest.raises(BoardError, match="12800 baud"):
        write(usart, 0x0C, 1 << 13)
    with pytest.raises(BoardError, match="interrupts"):
        write(usart, 0x0C, 1 << 5)


def test_a_line_that_is_no_frame_is_dropped():
    heard = []
    line = SlcanLine(heard.append)

    for byte in b"z\rt0811AB\r\r":
        line.take(byte)

    assert heard == [CanFrame(0x81, b"\xab")]
