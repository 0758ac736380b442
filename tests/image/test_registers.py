"""The address space of an emulated chip: whole registers, a clock for each peripheral, and time that is skipped."""

import pytest

from host_sim.emulator.clock import SECOND
from host_sim.emulator.registers import AddressSpace, BoardError, Peripheral, Register


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
