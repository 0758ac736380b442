"""The model of bxCAN against the reference manuals: what the drivers are tested on must be right itself."""

import pytest

from host_sim.emulator.bxcan import BxCan, CanFaults
from host_sim.emulator.can_frame import CanFrame
from host_sim.emulator.can_wire import CanWire
from host_sim.emulator.clock import SECOND, Clock
from host_sim.emulator.errors import BoardError

MCR, MSR, TSR, RF0R, RF1R, ESR, BTR = 0x00, 0x04, 0x08, 0x0C, 0x10, 0x18, 0x1C
FMR, FM1R, FS1R, FFA1R, FA1R, BANK_0 = 0x200, 0x204, 0x20C, 0x214, 0x21C, 0x240
INRQ, SLEEP, TXFP, RFLM, ABOM = 1, 2, 4, 8, 0x40
INAK, SLAK = 1, 2
RQCP, TXOK, ABRQ, TME_ALL = 0x01, 0x02, 0x80, 7 << 26
FULL, FOVR, RFOM = 8, 0x10, 0x20
EWGF, EPVF, BOFF = 1, 2, 4
BUS_HZ = 42_000_000


class Rig:
    """A controller by itself, set up for 500 kbit/s unless told otherwise."""

    def __init__(self, faults=None, mcr=TXFP, joined=True):
        self.clock = Clock(BUS_HZ)
        self.said = []
        self.wire = CanWire(self.clock, self.said.append)
        self.can = BxCan(self.clock, self.wire, lambda: BUS_HZ, 14, faults)
        if joined:
            self.join(mcr)

    def join(self, mcr=TXFP):
        self.write(MCR, INRQ)
        self.pass_us(30)
        self.write(BTR, 9 << 16 | 2 << 20 | 5)  # 42 MHz / 6 / (1 + 10 + 3) quanta
        self.write(FA1R, 0)
        self.accept(0, 0)
        self.write(MCR, mcr)
        self.pass_us(30)

    def accept(self, *banks, scale=1, is_list=0, fifo=0):
        """Filters: the two registers of each bank, all of one kind."""
        self.write(FMR, 1)
        pairs = list(zip(banks[::2], banks[1::2], strict=True))
        every = (1 << len(pairs)) - 1
        for register, on in ((FS1R, scale), (FM1R, is_list), (FFA1R, fifo)):
            self.write(register, every if on else 0)
        for i, pair in enumerate(pairs):
            for half in range(2):
                self.write(BANK_0 + 8 * i + 4 * half, pair[half])
        self.write(FA1R, every)
        self.write(FMR, 0)

    def read(self, offset):
        return self.can.registers[offset].read()

    def write(self, offset, value):
        self.can.registers[offset].write(value)

    def pass_us(self, us):
        self.clock.skip(us * SECOND // 10**6)

    def request(self, mailbox, frame_id, data=b"12345678"):
        base = 0x180 + 0x10 * mailbox
        self.write(base + 0x4, len(data))
        self.write(base + 0x8, int.from_bytes(data[:4], "little"))
        self.write(base + 0xC, int.from_bytes(data[4:], "little"))
        self.write(base, frame_id << 21 | 1)

    def bring(self, *frames):
        for frame in frames:
            self.wire.put(frame)
            self.pass_us(300)

    def take(self, fifo=0):
        base = 0x1B0 + 0x10 * fifo
        frame_id = self.read(base) >> 21
        self.write(RF0R + 4 * fifo, RFOM)
        return frame_id


@pytest.fixture
def rig():
    return Rig()


def ids(frames):
    return [frame.id for frame in frames]


def test_it_sleeps_after_a_reset():
    assert Rig(joined=False).read(MSR) & (INAK | SLAK) == SLAK


def test_set_up_is_acknowledged_but_not_at_once():
    rig = Rig(joined=False)

    rig.write(MCR, INRQ)
    before = rig.read(MSR)
    rig.pass_us(30)

    assert (before & INAK, rig.read(MSR) & (INAK | SLAK)) == (0, INAK)


def test_set_up_can_be_asked_for_in_vain():
    rig = Rig(CanFaults(inak_stuck=True), joined=False)

    rig.write(MCR, INRQ)
    rig.pass_us(1_000_000)

    assert not rig.read(MSR) & INAK


def test_it_joins_the_bus_eleven_bits_after_set_up():
    rig = Rig(joined=False)
    rig.write(MCR, INRQ)
    rig.pass_us(30)
    rig.write(BTR, 9 << 16 | 2 << 20 | 5)

    rig.write(MCR, 0)
    rig.pass_us(21)
    early = rig.read(MSR) & INAK
    rig.pass_us(2)

    assert (early, rig.read(MSR) & INAK) == (INAK, 0)


def test_another_speed_than_the_bus_is_an_error():
    rig = Rig(joined=False)
    rig.write(MCR, INRQ)
    rig.pass_us(30)
    rig.write(BTR, 9 << 16 | 2 << 20 | 6)
    rig.write(MCR, 0)

    with pytest.raises(BoardError, match="428571 bit/s"):
        rig.pass_us(30)


def test_bit_timing_can_be_written_in_set_up_only(rig):
    with pytest.raises(BoardError, match="BTR"):
        rig.write(BTR, 0)


def test_a_frame_takes_its_bits_to_leave(rig):
    rig.request(0, 0x81)

    rig.pass_us(220)
    early = list(rig.said)
    rig.pass_us(3)

    assert early == []
    assert rig.said == [CanFrame(0x81, b"12345678")]


def test_what_became_of_a_frame_is_cleared_by_writing_ones(rig):
    rig.request(1, 0x81)
    rig.pass_us(300)
    done = rig.read(TSR)

    rig.write(TSR, 0)
    untouched = rig.read(TSR)
    rig.write(TSR, RQCP << 8)

    assert done >> 8 & 0xFF == untouched >> 8 & 0xFF == RQCP | TXOK
    assert rig.read(TSR) >> 8 & 0xFF == 0


def test_mailboxes_leave_in_the_order_of_request_with_txfp(rig):
    for mailbox, frame_id in ((2, 0x300), (0, 0x200), (1, 0x100)):
        rig.request(mailbox, frame_id)
    rig.pass_us(1000)

    assert ids(rig.said) == [0x300, 0x200, 0x100]


def test_the_lowest_identifier_leaves_first_without_txfp():
    rig = Rig(mcr=0)
    for mailbox, frame_id in ((2, 0x300), (0, 0x200), (1, 0x100)):
        rig.request(mailbox, frame_id)
    rig.pass_us(1000)

    # All three were there before the first could begin.
    assert ids(rig.said) == [0x100, 0x200, 0x300]


def test_equal_identifiers_leave_by_mailbox_number_without_txfp():
    rig = Rig(mcr=0)
    for mailbox, data in ((2, b"c"), (1, b"b"), (0, b"a")):
        rig.request(mailbox, 0x100, data)
    rig.pass_us(1000)

    assert [frame.data for frame in rig.said] == [b"a", b"b", b"c"]


def test_a_mailbox_is_free_again_when_its_frame_has_left(rig):
    rig.request(0, 0x81)

    assert rig.read(TSR) & TME_ALL == 6 << 26
    rig.pass_us(300)
    assert rig.read(TSR) & TME_ALL == TME_ALL


def test_a_pending_mailbox_must_not_be_written(rig):
    rig.request(0, 0x81)

    with pytest.raises(BoardError, match="mailbox 0"):
        rig.request(0, 0x82)


def test_a_request_is_given_up_unless_it_is_on_the_wire(rig):
    rig.request(0, 0x81)
    rig.request(1, 0x82)
    rig.pass_us(10)

    rig.write(TSR, ABRQ | ABRQ << 8)
    rig.pass_us(1000)

    assert ids(rig.said) == [0x81]
    assert (rig.read(TSR) & 0xFF, rig.read(TSR) >> 8 & 0xFF) == (RQCP | TXOK, RQCP)


def test_a_stuck_mailbox_neither_sends_nor_gives_up():
    rig = Rig(CanFaults(stuck_mailboxes=frozenset({0})))
    rig.request(0, 0x81)
    rig.request(1, 0x82)

    rig.write(TSR, ABRQ)
    rig.pass_us(1000)

    assert ids(rig.said) == [0x82]
    assert rig.read(TSR) & TME_ALL == 6 << 26


def test_a_frame_of_lower_identifier_wins_the_bus(rig):
    rig.wire.put(CanFrame(0x100))
    rig.request(0, 0x81)
    rig.request(1, 0x200)

    rig.pass_us(230)  # 0x81 has left, and 0x100 is on the wire

    assert (ids(rig.said), rig.read(RF0R) & 3) == ([0x81], 0)
    rig.pass_us(100)
    assert (ids(rig.said), rig.read(RF0R) & 3) == ([0x81], 1)


def test_a_frame_that_lost_the_bus_can_be_given_up(rig):
    rig.wire.put(CanFrame(0x100, b"12345678"))
    rig.request(0, 0x200)
    rig.pass_us(50)  # 0x100 is on the wire

    rig.write(TSR, ABRQ)
    rig.pass_us(1000)

    assert rig.said == []


def test_three_frames_wait_in_their_order(rig):
    rig.bring(CanFrame(1), CanFrame(2), CanFrame(3))

    assert rig.read(RF0R) == 3 | FULL
    assert [rig.take() for _ in range(3)] == [1, 2, 3]
    assert rig.read(RF0R) == FULL  # stays until it is cleared


def test_the_flags_of_a_fifo_are_cleared_by_writing_ones(rig):
    rig.bring(*(CanFrame(i) for i in range(1, 5)))

    rig.write(RF0R, 0)
    assert rig.read(RF0R) & (FULL | FOVR) == FULL | FOVR
    rig.write(RF0R, FOVR)
    assert rig.read(RF0R) & (FULL | FOVR) == FULL
    rig.write(RF0R, FULL)
    assert rig.read(RF0R) == 3


def test_an_overrun_replaces_the_last_frame_unless_locked(rig):
    frames = [CanFrame(i) for i in range(1, 6)]
    locked = Rig(mcr=TXFP | RFLM)

    rig.bring(*frames)
    locked.bring(*frames)

    assert [rig.take() for _ in range(3)] == [1, 2, 5]
    assert [locked.take() for _ in range(3)] == [1, 2, 3]
    assert rig.can.fifos[0].overruns == locked.can.fifos[0].overruns == 2


def test_an_empty_fifo_must_not_be_read(rig):
    with pytest.raises(BoardError, match="FIFO 0"):
        rig.read(0x1B0)


def test_a_received_frame_reads_as_it_was_sent(rig):
    rig.bring(CanFrame(0x1ABCDEF0, b"\x01\x02\x03\x04\x05", extended=True))

    assert rig.read(0x1B0) == 0x1ABCDEF0 << 3 | 4
    assert rig.read(0x1B4) & 0xF == 5
    assert (rig.read(0x1B8), rig.read(0x1BC)) == (0x04030201, 0x05)


STANDARD, EXTENDED, REMOTE = CanFrame(0xC1), CanFrame(0xC1 << 18, extended=True), CanFrame(0xC1, remote=True)
FILTERS = {
    "32-bit mask of the identifier": ({"scale": 1}, (0xC1 << 21, 0x7FF << 21), [1, 1, 1, 0]),
    "32-bit mask with kind": ({"scale": 1}, (0xC1 << 21, 0x7FF << 21 | 6), [1, 0, 0, 0]),
    "32-bit list": ({"scale": 1, "is_list": 1}, (0xC1 << 21 | 2, 0xC2 << 21), [0, 0, 1, 1]),
    "16-bit list": ({"scale": 0, "is_list": 1}, (0xC1 << 5 | 0x700 << 21, 0x700 << 5 | 0xC2 << 21), [1, 0, 0, 1]),
    "16-bit mask": ({"scale": 0}, (0xC0 << 5 | 0x7FC << 21, 0x7FF << 5 | 0x7FF << 21), [1, 1, 1, 1]),
    "16-bit mask of the kind": ({"scale": 0}, (8 | 8 << 16, 8 | 8 << 16), [0, 1, 0, 0]),
    "16-bit mask with kind": ({"scale": 0}, (0xC1 << 5 | 0xFFF8 << 16, 0x700 << 5 | 0xFFE0 << 16), [1, 0, 0, 0]),
}


@pytest.mark.parametrize("name", FILTERS)
def test_filters_let_through(rig, name):
    kind, bank, expected = FILTERS[name]
    rig.accept(*bank, **kind)

    passed = []
    for frame in (STANDARD, EXTENDED, REMOTE, CanFrame(0xC2)):
        rig.bring(frame)
        passed.append(rig.read(RF0R) & 3)
        if passed[-1]:
            rig.take()

    assert passed == expected


def test_a_filter_names_its_fifo(rig):
    rig.accept(0, 0, fifo=1)

    rig.bring(CanFrame(5))

    assert (rig.read(RF0R) & 3, rig.read(RF1R) & 3) == (0, 1)


def test_nothing_passes_without_an_active_filter(rig):
    rig.write(FA1R, 0)

    rig.bring(CanFrame(5))

    assert rig.read(RF0R) & 3 == 0


def test_filters_in_use_must_not_be_changed(rig):
    with pytest.raises(BoardError, match="F0R1"):
        rig.write(BANK_0, 1)
    with pytest.raises(BoardError, match="FM1R"):
        rig.write(FM1R, 1)


def test_a_lone_node_becomes_passive_and_never_goes_bus_off(rig):
    rig.wire.alone = True

    rig.request(0, 0x81)
    rig.pass_us(100_000)

    assert rig.read(ESR) & (EWGF | EPVF | BOFF) == EWGF | EPVF
    assert rig.read(ESR) >> 16 & 0xFF == 128
    assert rig.read(TSR) & TME_ALL == 6 << 26


def shorted(mcr=TXFP):
    rig = Rig(mcr=mcr)
    rig.wire.shorted = True
    rig.request(0, 0x81)
    rig.pass_us(32 * 80 + 1)
    return rig


def test_the_thirty_second_destroyed_frame_means_bus_off():
    rig = Rig()
    rig.wire.shorted = True
    rig.request(0, 0x81)

    rig.pass_us(31 * 80 + 1)
    before = rig.read(ESR) & BOFF
    rig.pass_us(80)

    assert (before, rig.read(ESR) & BOFF) == (0, BOFF)


def test_bus_off_lasts_until_set_up_and_128_times_11_bits():
    rig = shorted()
    rig.wire.shorted = False
    rig.pass_us(1_000_000)
    alone = rig.read(ESR) & BOFF

    rig.write(MCR, TXFP | INRQ)
    rig.pass_us(30)
    rig.write(MCR, TXFP)
    rig.pass_us(22 + 128 * 22 - 1)
    late = rig.read(ESR) & BOFF
    rig.pass_us(2)

    assert (alone, late, rig.read(ESR)) == (BOFF, BOFF, 0)
    rig.pass_us(300)
    assert ids(rig.said) == [0x81]


def test_bus_off_ends_by_itself_with_abom():
    rig = shorted(TXFP | ABOM)
    rig.wire.shorted = False

    rig.pass_us(128 * 22 + 1)

    assert rig.read(ESR) & BOFF == 0


def test_nobody_hears_a_node_that_is_bus_off_and_it_hears_nobody():
    rig = shorted()
    rig.wire.shorted = False

    rig.bring(CanFrame(5))

    assert (rig.said, rig.read(RF0R) & 3) == ([], 0)


def test_a_frame_waits_for_a_node_that_is_in_set_up(rig):
    rig.write(MCR, TXFP | INRQ)
    rig.pass_us(30)
    rig.bring(CanFrame(5))
    deaf = rig.read(RF0R) & 3

    rig.write(MCR, TXFP)
    rig.pass_us(300)

    assert (deaf, rig.read(RF0R) & 3) == (0, 1)


def test_successes_make_up_for_errors():
    rig = Rig()
    rig.wire.shorted = True
    rig.request(0, 0x81)
    rig.pass_us(5 * 80 + 1)
    rig.wire.shorted = False
    rig.pass_us(400)

    assert rig.read(ESR) >> 16 & 0xFF == 5 * 8 - 1


@pytest.mark.parametrize(("offset", "value", "named"), [(0x14, 1, "interrupts"), (BTR, 1 << 30, "loop back")])
def test_what_is_not_modelled_is_named(rig, offset, value, named):
    rig.write(MCR, INRQ)
    rig.pass_us(30)

    with pytest.raises(BoardError, match=named):
        rig.write(offset, value)


def test_received_frames_are_read_only(rig):
    with pytest.raises(BoardError, match="read-only"):
        rig.write(0x1B0, 0)


def test_a_master_reset_empties_everything_and_sleeps(rig):
    rig.wire.shorted = True
    rig.can.clocked = True
    rig.request(0, 0x81)
    rig.pass_us(100)

    rig.write(MCR, 1 << 15)

    assert (rig.read(MCR), rig.read(MSR) & SLAK, rig.read(ESR)) == (0x00010002, SLAK, 0)
    assert rig.read(TSR) & TME_ALL == TME_ALL
    assert rig.can.clocked


def test_the_last_error_is_told_until_it_is_written_over(rig):
    rig.wire.alone = True
    rig.request(0, 0x81)
    rig.pass_us(300)
    told = rig.read(ESR) >> 4 & 7

    rig.write(ESR, 7 << 4)

    assert (told, rig.read(ESR) >> 4 & 7) == (3, 7)


def test_asking_for_the_mode_that_is_changes_nothing(rig):
    rig.write(MCR, TXFP | RFLM)
    rig.pass_us(30)

    assert rig.read(MSR) & (INAK | SLAK) == 0


def test_without_a_second_try_a_destroyed_frame_is_over():
    rig = Rig(mcr=TXFP | 1 << 4)
    rig.wire.shorted = True

    rig.request(0, 0x81)
    rig.pass_us(300)

    assert rig.read(TSR) & 0xFF == RQCP | 8
    assert rig.read(ESR) >> 16 & 0xFF == 8
