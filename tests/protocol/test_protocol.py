"""The Python side of the wire, by itself; that it agrees with the C side is test_wire_golden.py's.

The two halves of a memory on the wire, and frames of any node.
"""

import cantools
import pytest
from hypothesis import given
from hypothesis import strategies as st

from host_sim.protocol.codec import DBC, DecodedFrame, Frame, MemoryReport, MessageLayout, Protocol, crc8, node_of
from host_sim.protocol.every_node import IDS, Heard, hear
from host_sim.protocol.generated import LAYOUT_HASH, MESSAGES, RANGE_NONE, Drive, Opcode, Ranges, Reason, Senses

PROTOCOL = Protocol()
NOTHING_SENSED = Senses(tick=0, feel=0, bump=False, look=False, beacon_mm=0, odometer_left=0, odometer_right=0)
DATABASE = cantools.database.load_file(DBC)
any_senses = st.builds(
    Senses,
    tick=st.integers(0, 255),
    feel=st.integers(0, 31),
    bump=st.booleans(),
    look=st.booleans(),
    beacon_mm=st.integers(0, 8191),
    odometer_left=st.integers(0, 4095),
    odometer_right=st.integers(0, 4095),
)
any_drive = st.builds(
    Drive,
    tick=st.integers(0, 255),
    left_mm_s=st.integers(-2048, 2047),
    right_mm_s=st.integers(-2048, 2047),
    reason=st.integers(0, len(Reason) - 1),
    repeat_count=st.integers(0, 255),
    action=st.integers(0, 127),
    eat=st.booleans(),
)
COMMON = {
    "COMMAND": {"crc", "counter", "opcode", "owner"},
    "MEMORY": {"crc", "counter", "half"},
    "FAULTS": {"crc", "counter", "page"},
}
any_data = st.binary(min_size=8, max_size=8)


def signals_of(drive: Drive) -> dict[str, int]:
    return {name.removesuffix("_mm_s"): int(value) for name, value in drive._asdict().items()}


def said_by_cantools(name: str, data: bytes) -> dict[str, int]:
    message = DATABASE.get_message_by_name(name)
    return message.decode(data[: message.length], scaling=False, decode_choices=False)


@given(any_drive)
def test_decoded_drive_equals_the_encoded_one(drive):
    assert PROTOCOL.decode_drive(PROTOCOL.encode("DRIVE", {"counter": 0, **signals_of(drive)})) == drive


@given(any_senses, st.integers(0, 14))
def test_decoded_senses_equal_the_encoded_ones(senses, counter):
    said = PROTOCOL.decode(PROTOCOL.encode_senses(senses, counter))

    assert said is not None
    assert said.name == "SENSES"
    expected = {name.removesuffix("_mm"): int(value) for name, value in senses._asdict().items()}
    assert said.signals == {"crc": said.signals["crc"], "counter": counter, **expected}


@pytest.mark.parametrize("name", [message.name for message in DATABASE.messages])
@given(data=any_data)
def test_messages_unpack_and_pack_as_by_cantools(name, data):
    layout = MessageLayout(MESSAGES[name])
    length = MESSAGES[name].length
    try:
        expected = said_by_cantools(name, data)
    except cantools.database.DecodeError:  # a multiplexer's value that is none: what is always there is said
        assert layout.unpack(data[:length]).keys() == COMMON[name]
        return

    said = layout.unpack(data[:length])

    assert said == expected
    assert said_by_cantools(name, layout.pack(said)) == expected


def test_missing_signal_is_named():
    with pytest.raises(KeyError, match="seed"):
        PROTOCOL.encode("COMMAND", {"counter": 0, "opcode": Opcode.START, "owner": 1, "lockstep": 0, "profile": 0})


@pytest.mark.parametrize("tick", [-1, 256])
def test_number_out_of_the_range_of_its_signal_is_refused(tick):
    drive = Drive(tick=tick, left_mm_s=0, right_mm_s=0, reason=0, repeat_count=0, action=0, eat=False)

    with pytest.raises(ValueError, match=f"DRIVE.tick has no room for {tick}"):
        PROTOCOL.encode("DRIVE", {"counter": 0, **signals_of(drive)})


def test_describe_prints_choices_by_name():
    start = {"counter": 3, "opcode": Opcode.START, "owner": 2, "lockstep": 1, "profile": 1, "seed": 7}

    line = PROTOCOL.describe(PROTOCOL.encode("COMMAND", start))

    assert line == "COMMAND counter=3 opcode=start owner=2 profile=fixed lockstep=lockstep seed=7"


@pytest.mark.parametrize("node", [0, 32, -1])
def test_node_out_of_range_is_refused(node):
    with pytest.raises(ValueError, match=r"1\.\.31"):
        Protocol(node)


def test_command_with_unknown_opcode_is_decoded_without_its_signals():
    data = bytes.fromhex("00A9010000000000")
    frame = Frame(0x021, bytes((crc8(0x021, data),)) + data[1:])

    decoded = Protocol().decode(frame)

    assert decoded is not None
    assert decoded.signals == {"crc": frame.data[0], "counter": 9, "opcode": 10, "owner": 1}
    assert Protocol().describe(frame) == "COMMAND counter=9 opcode=10 owner=1"


def test_layout_with_another_hash_does_not_fit():
    assert PROTOCOL.fits(LAYOUT_HASH)
    assert not PROTOCOL.fits(LAYOUT_HASH ^ 1)


def test_identifiers_are_divided_between_robot_and_simulator():
    of_robot, of_sim = (set(Protocol(2).ids_from(side)) for side in ("ROBOT", "SIM"))

    assert Protocol(2).id_of("DRIVE") in of_robot
    assert Protocol(2).id_of("SENSES") in of_sim
    assert len(of_robot | of_sim) == len(of_robot) + len(of_sim) == len(MESSAGES)


def test_choices_are_known_by_name_and_by_number():
    assert PROTOCOL.choices("COMMAND", "opcode")["stop"] == Opcode.STOP
    assert PROTOCOL.choice("COMMAND", "opcode", Opcode.STOP) == "stop"
    assert PROTOCOL.choice("COMMAND", "opcode", 255) == "255"


def test_missing_distance_is_sent_as_range_none():
    frame = PROTOCOL.encode_ranges(Ranges(None, 1, 2, 3, 60), 9, 4)

    signals = PROTOCOL.decode(frame).signals
    assert list(signals.values())[-5:] == [RANGE_NONE, 1, 2, 3, 60]


def test_damaged_or_foreign_frame_decodes_to_nothing():
    senses = Protocol(2).encode_senses(NOTHING_SENSED, 1)

    assert PROTOCOL.decode(senses) is None
    assert Protocol(2).decode(Frame(senses.id, senses.data[:7])) is None
    assert Protocol(2).decode(Frame(senses.id, bytes(8))) is None
    assert "not a frame of node 1, or damaged" in PROTOCOL.describe(senses)


def test_node_is_read_from_the_identifier():
    assert node_of(Protocol(5).id_of("SENSES")) == 5


def test_damaged_or_foreign_drive_decodes_to_nothing():
    drive = Protocol(2).encode("DRIVE", {signal.name: 0 for signal in MESSAGES["DRIVE"].signals})

    assert Protocol(2).decode_drive(drive) is not None
    assert PROTOCOL.decode_drive(drive) is None
    assert Protocol(2).decode_drive(Frame(drive.id, drive.data[:7])) is None
    assert Protocol(2).decode_drive(Frame(drive.id, bytes(8))) is None


def half(number: int, counter: int = 1) -> DecodedFrame:
    cells = {f"cell_{4 * number + i}": 10 * number + i for i in range(4)}
    return DecodedFrame("MEMORY", {"half": number, "counter": counter, **cells})


WHOLE = (0, 1, 2, 3, 10, 11, 12, 13)


def test_halves_of_a_memory_are_joined_in_either_order():
    report = MemoryReport()

    assert [report.join(half(0)), report.join(half(1))] == [None, WHOLE]
    assert [report.join(half(1)), report.join(half(0))] == [None, WHOLE]


def test_halves_of_two_reports_are_not_joined():
    report = MemoryReport()

    assert [report.join(half(0, counter=1)), report.join(half(1, counter=2))] == [None, None]
    assert report.join(half(0, counter=2)) == WHOLE


def test_invalid_half_of_a_memory_is_ignored():
    report = MemoryReport()
    report.join(half(0))

    assert report.join(half(2)) is None
    assert report.join(half(1)) == WHOLE


SENSES = Protocol(3).encode_senses(Senses(7, 4, False, False, 0, 1, 2), 5)


def test_hear_decodes_a_frame_of_any_node():
    heard = hear(SENSES)

    assert (heard.node, heard.name) == (3, "SENSES")
    assert (heard.signals["tick"], heard.signals["feel"]) == (7, 4)


def test_hear_gives_node_and_name_of_a_damaged_frame_without_signals():
    assert hear(Frame(SENSES.id, bytes(8))) == Heard(3, "SENSES", None)


def test_hear_ignores_an_unknown_identifier():
    unknown = next(number for number in range(0x800) if number not in IDS)

    assert hear(Frame(unknown, b"")) is None
