"""Both sides of the wire, made from one DBC, agree bit for bit; and the DBC says all that a reader must know."""

import random

import cantools
import pytest

from host_sim.protocol.codec import DBC, NODE_MAX, crc8
from tests.firmware.octet_c import load

DATABASE = cantools.database.load_file(DBC)
MESSAGES = {message.name: message for message in DATABASE.messages}
SIGNALS = [
    pytest.param(signal, id=f"{message.name}.{signal.name}")
    for message in DATABASE.messages
    for signal in message.signals
]
RANDOM_VALUES = 1000

# Signals that are neither a quantity nor a choice: codes, bit sets, numbers that only tell one thing from another.
PLAIN = {"crc", "counter", "owner", "seed", "value", "which", "mask", "kinds", "feel", "action", "layout", "commit"}
PLAIN |= {"version_major", "version_minor", "held"}
PLAIN |= {*(f"byte_{i}" for i in range(4)), *(f"cell_{i}" for i in range(8))}

# What CANopen gives a meaning: NMT, SYNC and EMCY, TIME, PDOs and SDOs, node guarding and heartbeat, LSS.
CANOPEN = [range(0x001), range(0x080, 0x101), range(0x180, 0x680), range(0x700, 0x780), range(0x7E4, 0x7E6)]


@pytest.fixture(scope="module")
def c_side():
    return load()


def raw_range(signal):
    """The least and the greatest number that its bits can hold."""
    if signal.is_signed:
        return -(1 << (signal.length - 1)), (1 << (signal.length - 1)) - 1
    return 0, (1 << signal.length) - 1


def branches(message):
    """Each set of signals that can be in one frame, with the multiplexer's value: one set where there is none."""
    (selector,) = [signal for signal in message.signals if signal.is_multiplexer] or [None]
    if selector is None:
        yield message.signals, {}
        return
    for number in selector.choices:
        present = [s for s in message.signals if not s.multiplexer_ids or number in s.multiplexer_ids]
        yield present, {selector.name: number}


def some_values(message):
    """Every pair of extremes of each branch's signals, and many values at random."""
    dice = random.Random(message.frame_id)
    for signals, fixed in branches(message):
        ranges = {signal.name: raw_range(signal) for signal in signals}
        for all_at in range(2):
            yield {name: ends[all_at] for name, ends in ranges.items()} | fixed
            for odd_one, ends in ranges.items():
                yield {name: e[all_at] for name, e in ranges.items()} | {odd_one: ends[1 - all_at]} | fixed
        for _ in range(RANDOM_VALUES):
            yield {name: dice.randint(*ends) for name, ends in ranges.items()} | fixed


def packed_by_c(c_side, message, values):
    ffi, c = c_side
    name, data = f"octet_{message.name.lower()}", ffi.new("uint8_t[]", message.length)
    length = getattr(c, f"{name}_pack")(data, ffi.new(f"struct {name}_t *", values), message.length)
    assert length == message.length
    return bytes(data)


def unpacked_by_c(c_side, message, data, names):
    ffi, c = c_side
    name = f"octet_{message.name.lower()}"
    unpacked = ffi.new(f"struct {name}_t *")
    assert getattr(c, f"{name}_unpack")(unpacked, data, len(data)) == 0
    return {signal: getattr(unpacked, signal) for signal in names}


def packed_by_python(message, values):
    return message.encode(values, scaling=False, strict=False)


def unpacked_by_python(message, data):
    return message.decode(data, scaling=False, decode_choices=False)


@pytest.mark.parametrize("message", MESSAGES.values(), ids=MESSAGES)
def test_both_sides_pack_the_same_bytes(c_side, message):
    for values in some_values(message):
        assert packed_by_c(c_side, message, values) == packed_by_python(message, values), values


@pytest.mark.parametrize("message", MESSAGES.values(), ids=MESSAGES)
def test_python_unpacks_what_c_packed(c_side, message):
    for values in some_values(message):
        assert unpacked_by_python(message, packed_by_c(c_side, message, values)) == values


@pytest.mark.parametrize("message", MESSAGES.values(), ids=MESSAGES)
def test_c_unpacks_what_python_packed(c_side, message):
    for values in some_values(message):
        assert unpacked_by_c(c_side, message, packed_by_python(message, values), values) == values


def c_frame(c_side, frame_id, data):
    return c_side[0].new("struct frame *", {"id": frame_id, "len": len(data), "data": data})


def test_both_sides_compute_the_same_crc(c_side):
    dice = random.Random(1)
    for _ in range(RANDOM_VALUES):
        frame_id, data = dice.randrange(0x800), dice.randbytes(dice.randint(1, 8))
        frame = c_frame(c_side, frame_id, data)
        c_side[1].e2e_protect(frame)
        assert crc8(frame_id, data) == frame.data[0]


def test_identifiers_of_all_nodes_are_unique_and_avoid_canopen():
    ids = [message.frame_id + node - 1 for message in DATABASE.messages for node in range(1, NODE_MAX + 1)]
    assert len(set(ids)) == len(ids)
    assert max(ids) < 0x800
    assert not [frame_id for frame_id in ids for taken in CANOPEN if frame_id in taken]


def test_control_messages_have_priority_over_reports_of_all_nodes():
    control = [MESSAGES[name].frame_id for name in ("COMMAND", "DRIVE", "SENSES")]
    reports = [message.frame_id for message in DATABASE.messages if message.frame_id not in control]
    assert max(control) + NODE_MAX - 1 < min(reports)


@pytest.mark.parametrize("message", MESSAGES.values(), ids=MESSAGES)
def test_message_has_a_comment(message):
    assert message.comment


@pytest.mark.parametrize("signal", SIGNALS)
def test_signal_is_an_unscaled_integer(signal):
    assert (signal.scale, signal.offset, signal.is_float) == (1, 0, False)


@pytest.mark.parametrize("signal", SIGNALS)
def test_signal_has_a_comment(signal):
    assert signal.comment


@pytest.mark.parametrize("signal", SIGNALS)
def test_range_of_a_signal_fits_its_bits(signal):
    if signal.minimum is None and signal.maximum is None:  # [0|0]: a DBC says so for no range, too
        assert list(signal.choices) == [0]
        return
    least, greatest = raw_range(signal)
    assert least <= signal.minimum < signal.maximum <= greatest


@pytest.mark.parametrize("signal", SIGNALS)
def test_signal_has_either_a_unit_or_named_choices_or_is_plain(signal):
    assert [bool(signal.unit), bool(signal.choices), signal.name in PLAIN].count(True) == 1


@pytest.mark.parametrize("signal", SIGNALS)
def test_named_choices_are_within_the_range_of_their_signal(signal):
    for number in signal.choices or ():
        assert (signal.minimum or 0) <= number <= (signal.maximum or 0)
