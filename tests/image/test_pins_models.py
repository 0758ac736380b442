"""The models of what a robot of its own uses on an STM32F1: ports, timers, the converter, interrupts that wake."""

import pytest

from host_sim.emulator.board_pins import read_pins
from host_sim.emulator.clock import SECOND
from host_sim.emulator.converter import ConverterF1, ConverterG4, Dma, Multiplexer
from host_sim.emulator.hardware import Interrupts
from host_sim.emulator.ports import GpioF1, GpioG4
from host_sim.emulator.registers import BoardError, Register
from host_sim.emulator.robot_on_pins import Wiring
from host_sim.emulator.timers import MotorTimer, Timer
from tests.image.support import read, write

CRL, IDR, ODR, BSRR = 0x00, 0x08, 0x0C, 0x10
HZ = 8_000_000


def test_open_input_reads_its_pull_and_driven_input_its_level():
    port = GpioF1("GPIOA")
    write(port, CRL, 0x44444488)
    write(port, BSRR, 1)
    write(port, CRL, 0x44444488)
    assert read(port, IDR) == 1
    port.drive(0, high=False)
    port.drive(1, high=True)
    assert read(port, IDR) == 2
    assert not port.drives(0)


def test_output_reads_back_and_alternate_pin_is_not_driven():
    port = GpioF1("GPIOA")
    write(port, CRL, 0x444444B2)
    write(port, BSRR, 3)
    assert (port.drives(0), port.drives(1)) == (True, False)
    assert read(port, IDR) == 3


def test_open_drain_output_drives_only_low():
    f1, g4 = GpioF1("GPIOA"), GpioG4("GPIOC")
    write(f1, CRL, 0x44444462)
    write(f1, BSRR, 3)
    write(g4, 0x00, 0xFFFFFFF5)
    write(g4, 0x04, 2)
    write(g4, 0x18, 3)
    assert [port.drives(pin) for port in (f1, g4) for pin in (0, 1)] == [True, False, True, False]


@pytest.fixture
def wiring():
    ports = [GpioF1(f"GPIO{letter}") for letter in "ABC"]
    return Wiring(read_pins("blue_pill"), ports, Register("MAPR")), ports


def test_f1_signal_is_connected_by_pin_mode_and_remap(wiring):
    wires, ports = wiring
    mapr = wires._mapr
    write(ports[1], 0x04, 0x444444B8)
    assert not wires.meets("CAN_RX")
    mapr.write(2 << 13)
    assert wires.meets("CAN_RX")
    assert wires.meets("CAN_TX")
    write(ports[1], 0x04, 0x44444428)
    assert not wires.meets("CAN_TX")
    wires.rewire("CAN_RX", "PA11")
    assert not wires.meets("CAN_RX")


def test_g4_signal_is_connected_by_its_alternate_function():
    ports = [GpioG4(f"GPIO{letter}") for letter in "ABC"]
    wires = Wiring(read_pins("nucleo_g431rb"), ports, None)
    write(ports[0], 0x24, 9 << 12 | 9 << 16)
    analogue = wires.meets("CAN_RX")
    write(ports[0], 0x00, 0xABFFFFFF & ~(5 << 22))
    alternate = wires.meets("CAN_RX", "CAN_TX")
    write(ports[0], 0x24, 9 << 12 | 7 << 16)
    assert (analogue, alternate, wires.meets("CAN_RX"), wires.meets("CAN_TX")) == (False, True, True, False)
    wires.rewire("CAN_RX", "PB9")
    assert not wires.meets("CAN_RX")


def test_g4_pin_starts_analogue_and_input_reads_its_pull():
    port = GpioG4("GPIOC")
    assert port.measures(3)
    write(port, 0x00, 0xFFFFFFF1)
    write(port, 0x0C, 0b0101)
    write(port, 0x18, 1)
    assert (read(port, 0x10), port.drives(0), port.measures(1)) == (3, True, False)


def test_jtag_pins_are_free_only_with_jtag_disabled(wiring):
    wires, _ = wiring
    wires._mapr.write(1 << 8)
    assert not wires.meets("BEACON")
    wires._mapr.write(1 << 8 | 2 << 24)
    assert wires.meets("BEACON")


def test_sensor_needs_an_analogue_pin(wiring):
    wires, ports = wiring
    assert not wires.meets("BATTERY")
    write(ports[0], CRL, 0x44044444)
    assert wires.meets("BATTERY")


def test_encoder_counts_down_and_wraps():
    timer = Timer("TIM3")
    assert not timer.follows_encoder()
    for offset, value in ((0x18, 0x3131), (0x08, 3), (0x00, 1)):
        write(timer, offset, value)
    assert timer.follows_encoder()
    assert not timer.counts_input_1()
    timer.count(-1)
    assert read(timer, 0x24) == 0xFFFF


def test_timer_counts_bursts_at_its_first_input():
    timer = Timer("TIM2")
    for offset, value in ((0x18, 0x31), (0x08, 7 | 5 << 4), (0x00, 1)):
        write(timer, offset, value)
    assert timer.counts_input_1()


@pytest.fixture
def motors(clock):
    pended = []
    timer = MotorTimer(clock, lambda: HZ, lambda: pended.append(clock.now))
    for offset, value in ((0x2C, 399), (0x30, 99), (0x18, 0x6800), (0x38, 100), (0x20, 1 << 6), (0x44, 9 << 12)):
        write(timer, offset, value)
    return timer, pended


def test_update_event_follows_the_repetition_counter(clock, motors):
    timer, pended = motors
    write(timer, 0x0C, 1)
    write(timer, 0x00, 1)
    clock.skip(SECOND // 50)
    assert len(pended) == 4
    assert read(timer, 0x10) & 1
    timer.registers[0x10].value &= ~1
    clock.skip(SECOND // 400)
    assert not read(timer, 0x10) & 1


def test_duty_is_zero_unless_channel_runs_enabled_and_unbroken(motors):
    timer, _ = motors
    assert timer.duty("ch2n") == 0
    write(timer, 0x00, 1)
    assert timer.duty("ch2n") == 0.25
    assert timer.duty("ch3n") == 0
    timer.break_at(low=False)
    assert timer.duty("ch2n") == 0.25
    timer.break_at(low=True)
    assert timer.duty("ch2n") == 0
    assert read(timer, 0x10) & 1 << 7


@pytest.fixture
def converter(clock):
    dma = Dma()
    made = ConverterF1(0x40012400, lambda: 12_000_000, dma, clock)
    for offset, value in ((0x08, 0x5A1), (0x0C, 2), (0x10, 0x4001244C), (0x14, 0x20000100)):
        write(dma, offset, value)
    for offset, value in ((0x2C, 1 << 20), (0x34, 3 | 5 << 5), (0x04, 1 << 8), (0x08, 1)):
        write(made, offset, value)
    return made, dma


SET_UP, BEGIN, RESET_CALIBRATION, CALIBRATE_F1 = 1 | 2 | 1 << 8 | 15 << 17, 1 << 22, 1 << 3, 1 << 2


def begin(made):
    for calibration in (RESET_CALIBRATION, CALIBRATE_F1):
        write(made, 0x08, 1 | calibration)
        assert read(made, 0x08) & calibration
        assert read(made, 0x08) == 1
    write(made, 0x08, SET_UP)
    write(made, 0x08, SET_UP | BEGIN)


def test_f1_adc_converts_its_sequence_in_order(converter):
    made, _ = converter
    assert made.convert({}) is None
    begin(made)
    assert made.convert({3: 700, 5: 9999}) == (0x20000100, (700).to_bytes(2, "little") + b"\xff\x0f")
    write(made, 0x08, 1)
    write(made, 0x08, SET_UP | BEGIN)  # at once, and what it is to do is not set up yet
    assert made.convert({3: 700}) is None
    made.reset()
    write(made, 0x08, 1)
    with pytest.raises(BoardError, match="started before it was calibrated"):
        write(made, 0x08, SET_UP | BEGIN)


@pytest.mark.parametrize(
    ("words", "why"),
    [
        ([0, 1 | CALIBRATE_F1], "calibrated before it was switched on"),
        ([1 | RESET_CALIBRATION, 1 | CALIBRATE_F1], "while it was still calibrating"),
        ([1 | CALIBRATE_F1, None, None, SET_UP, SET_UP | BEGIN], "started before it was calibrated"),
        ([1 | CALIBRATE_F1, None, None, 1 | RESET_CALIBRATION, None, None, SET_UP | BEGIN], "started before it was"),
    ],
)
def test_invalid_f1_adc_setup_is_refused(converter, words, why):
    made, _ = converter
    for value in words[:-1]:
        if value is None:
            read(made, 0x08)
        else:
            write(made, 0x08, value)
    with pytest.raises(BoardError, match=why):
        write(made, 0x08, words[-1])


def test_adc_samples_without_dma_are_lost(converter):
    made, dma = converter
    begin(made)
    write(dma, 0x08, 0)
    assert made.convert({3: 700}) is None


def test_adc_with_wrong_dma_length_or_fast_clock_is_refused(converter):
    made, dma = converter
    begin(made)
    write(dma, 0x0C, 3)
    with pytest.raises(BoardError, match="converts 2 channels in a scan, but DMA1 transfers 3"):
        made.convert({})
    fast = ConverterF1(0x40012400, lambda: 36_000_000, dma, made._clock)
    with pytest.raises(BoardError, match="36000000 Hz, where 14000000 is allowed"):
        write(fast, 0x08, 1)


ON, START, REGULATOR, CALIBRATE = 1, 4, 1 << 28, 1 << 31


@pytest.fixture
def converter_g4(clock):
    before = Multiplexer()
    dma = Dma(before)
    made = ConverterG4(0x50000000, lambda: 80_000_000, dma, clock)
    for offset, value in ((0x08, 0x5A1), (0x0C, 6), (0x10, 0x50000040), (0x14, 0x20000100)):
        write(dma, offset, value)
    write(before, 0, 5)
    order = (9, 8, 7, 6, 1, 2)
    write(made, 0x30, 5 | sum(channel << 6 * place for place, channel in enumerate(order[:4], 1)))
    write(made, 0x34, order[4] | order[5] << 6)
    write(made, 0x0C, 1 << 13 | 3)
    write(made, 0x308, 3 << 16)
    return made, before


def switched_on(made):
    for value in (0, CALIBRATE, ON, ON | START):
        write(made, 0x08, REGULATOR | value)
        made._clock.skip(20 * SECOND // 10**6)
        assert read(made, 0x08) & CALIBRATE == 0
    assert read(made, 0x00) == ON
    return made


def test_g4_adc_converts_its_sequence_over_two_registers(converter_g4):
    made, before = converter_g4
    assert made.convert({}) is None
    at, data = switched_on(made).convert({9: 9, 8: 8, 7: 7, 6: 6, 1: 1, 2: 2, 3: 3})
    assert (at, data[::2]) == (0x20000100, bytes((9, 8, 7, 6, 1, 2)))
    write(before, 0, 6)
    assert made.convert({}) is None


@pytest.mark.parametrize(
    ("words", "why"),
    [
        ([ON], "before its regulator"),
        ([0, REGULATOR, REGULATOR | CALIBRATE], "before its regulator"),
        ([REGULATOR, REGULATOR | ON, REGULATOR | CALIBRATE], "calibrated while it was on"),
    ],
)
def test_invalid_g4_adc_setup_is_refused(converter_g4, words, why):
    made, _ = converter_g4
    for value in words[:-1]:
        write(made, 0x08, value)
        made._clock.skip((19 if words[0] == 0 else 20) * SECOND // 10**6)
    with pytest.raises(BoardError, match=why):
        write(made, 0x08, words[-1])


@pytest.mark.parametrize(("divisor", "hz"), [(0, 0), (1, 80_000_000)])
def test_g4_adc_with_a_wrong_clock_is_refused(converter_g4, divisor, hz):
    made, _ = converter_g4
    write(made, 0x308, divisor << 16)
    write(made, 0x08, REGULATOR)
    made._clock.skip(20 * SECOND // 10**6)
    with pytest.raises(BoardError, match=f"at {hz} Hz, where 60000000 is allowed"):
        write(made, 0x08, REGULATOR | ON)


def test_status_bits_are_cleared_by_writing_zeros():
    timer = Timer("TIM3")
    timer.registers[0x10].value = 0x81
    write(timer, 0x10, 0xFFFFFFFE)
    assert read(timer, 0x10) == 0x80


def test_enabled_pending_interrupt_wakes_the_core():
    interrupts = Interrupts()
    interrupts.pend(25)
    assert not interrupts.wakes
    write(interrupts, 0x00, 1 << 25)
    assert interrupts.wakes
    assert read(interrupts, 0x100) == 1 << 25
    write(interrupts, 0x180, 1 << 25)
    assert not interrupts.wakes
    interrupts.pend(33)
    write(interrupts, 0x04, 2)
    assert interrupts.wakes
