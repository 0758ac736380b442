"""The core with the registers: programs of a few instructions, clocks for peripherals, time that is skipped."""

import struct

import pytest

from host_sim.emulator.chips import CAN_BASE, STM32F103, WATCHDOG_BASE
from host_sim.emulator.clock import NEVER, SECOND
from host_sim.emulator.flash import BASE
from host_sim.emulator.hardware import Faults, Hardware
from host_sim.emulator.registers import AddressSpace, BoardError, Peripheral, Register
from tests.image.support import write

LOAD, LOAD_BYTE, STORE = 0x6801, 0x7801, 0x6000  # ldr r1, [r0]; ldrb r1, [r0]; str r0, [r0]
NOP, WIDE_NOP = (0xBF00,), (0xF3AF, 0x8000)
APB1ENR, CAN_GATE = 0x1C, 1 << 25
IER, RI0R = CAN_BASE + 0x14, CAN_BASE + 0x1B0


@pytest.fixture
def hardware():
    """A chip whose core stops after a millisecond."""
    made = Hardware(STM32F103, Faults(), lambda _frame: None, lambda _cause: None)

    def due():
        if made.clock.now < SECOND // 1000:
            return SECOND // 1000
        made.core.stop()
        return NEVER

    made.clock.add(due)(SECOND // 1000)
    return made


def run(hardware, address, *instructions):
    """Points r0 to an address, executes some instructions, and then loops."""
    point_r0, loop, literal = 0x4805, 0xE7FE, 0x20
    code = struct.pack(f"<2I{len(instructions) + 2}H", 0x20001000, BASE + 9, point_r0, *instructions, loop)
    hardware.flash_image([(BASE, code.ljust(literal, b"\0") + address.to_bytes(4, "little"))])
    hardware.core.run()


@pytest.mark.parametrize(
    ("instruction", "address", "refusal"),
    [
        (LOAD, RI0R, "FIFO 0 was read, but the FIFO is empty"),
        (STORE, RI0R, "FIFO 0 was written"),
        (STORE, IER, "interrupts were enabled"),
        (LOAD_BYTE, IER, "CAN1 IER was read by 1 bytes"),
        (LOAD, IER + 0x20, "0x40006434 was read, where no register is modelled"),
    ],
)
def test_refused_register_access_ends_the_run(hardware, instruction, address, refusal):
    write(hardware.rcc, APB1ENR, CAN_GATE)

    with pytest.raises(BoardError, match=refusal):
        run(hardware, address, instruction)


@pytest.mark.parametrize(("instruction", "how"), [(LOAD, "read"), (STORE, "written")])
def test_access_to_an_unclocked_controller_is_refused(hardware, instruction, how):
    with pytest.raises(BoardError, match=f"CAN1 IER was {how}, but CAN1 has no clock"):
        run(hardware, IER, instruction)


def test_error_in_a_timed_event_ends_the_run(hardware):
    def due():
        raise BoardError("as was asked for")

    hardware.clock.add(due)

    with pytest.raises(BoardError, match="as was asked for"):
        run(hardware, BASE, LOAD)


@pytest.mark.parametrize("nop", [NOP, WIDE_NOP])
def test_instruction_takes_a_cycle_whatever_its_length(hardware, nop):
    counts = []
    status = hardware.watchdog.registers[0xC]
    status.on_read = lambda: counts.append((hardware.core.instructions, hardware.clock.cycles)) or 0

    run(hardware, WATCHDOG_BASE + 0xC, *nop, *nop, LOAD)

    assert counts == [(5, 5)]  # of the whole block
    assert hardware.core.instructions == hardware.clock.cycles
    assert hardware.clock.now == hardware.clock.cycles * hardware.clock.model.period_fs


@pytest.fixture
def space(clock):
    made = AddressSpace(clock)
    counter = Register("COUNT", on_read=lambda: clock.cycles, steady=False)
    made.attach(0x40000000, Peripheral("THING", {0x0: Register("A"), 0x4: Register("B"), 0x8: counter}, clocked=True))
    made.attach(0x40001000, Peripheral("SLEEPER", {0x0: Register("C")}))
    return made


def test_unmodelled_register_is_named(space):
    with pytest.raises(BoardError, match=r"0x4000000C was read, .* \(0x40000008 is THING COUNT\)"):
        space.read(0x4000000C, 4)
    with pytest.raises(BoardError, match="0x3FFFFFFC was written"):
        space.write(0x3FFFFFFC, 4, 0)


def test_unclocked_peripheral_is_named(space):
    with pytest.raises(BoardError, match="SLEEPER has no clock"):
        space.read(0x40001000, 4)


def test_partial_register_write_is_refused(space):
    with pytest.raises(BoardError, match="THING A was written by 1 bytes"):
        space.write(0x40000000, 1, 0)


def test_skipped_time_runs_events_in_order(clock):
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
    clock.execute(0)
    clock.skip(10)

    assert seen == [("a", 3), ("b", 5), ("a", 9)]


TIM1_UP, ICSR = 25, 0xE000ED04
SELF, RETURN, MASK = 0xE7FE, 0x4770, 0xB672  # b .; bx lr; cpsid i
HANDLER = BASE + 0x108


def handled(hardware, first, vector=HANDLER + 1):
    """Executes an instruction, then loops, and an interrupt comes; returns ICSR for each time that it is handled."""
    active = []
    hardware.watchdog.registers[0xC].on_read = lambda: active.append(hardware.space.read(ICSR, 4)) or 0

    def due():
        if hardware.clock.now < SECOND // 2000:
            return SECOND // 2000
        hardware.interrupts.pend(TIM1_UP)
        return NEVER

    hardware.clock.add(due)(SECOND // 2000)
    vectors = [0x20001000, *[BASE + 0x101] * 15, *[0] * TIM1_UP, vector]
    load_r0 = 0x4801
    code = struct.pack("<8HI", first, SELF, *NOP, *NOP, load_r0, LOAD, RETURN, *NOP, WATCHDOG_BASE + 0xC)
    hardware.flash_image([(BASE, struct.pack("<42I", *vectors).ljust(0x100, b"\0") + code)])
    write(hardware.interrupts, 0x00, 1 << TIM1_UP)
    hardware.core.run()
    while hardware.clock.now < SECOND // 1000:
        hardware.core.run()
    return active


def test_interrupt_is_taken_once_and_its_handler_returns(hardware):
    assert handled(hardware, *NOP) == [16 + TIM1_UP]
    assert (hardware.space.read(ICSR, 4), hardware.interrupts.wakes, hardware.faults) == (0, False, [])


def test_masked_interrupt_stays_pending(hardware):
    assert handled(hardware, MASK) == []
    assert hardware.interrupts.wakes


def test_vector_without_thumb_bit_is_a_fault(hardware):
    assert handled(hardware, *NOP, vector=0x4903BF38) == []
    assert [fault.cause for fault in hardware.faults] == [1 << 17]  # INVSTATE
