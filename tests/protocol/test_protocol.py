"""The Python side of the wire, by itself; that it agrees with the C side is test_wire_golden.py's."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from host_sim.protocol.codec import Frame, Protocol, crc8, drive_from
from host_sim.robot_io import Senses

PROTOCOL = Protocol()
DRIVE_RANGES = ((0, 4095), (-2047, 2047), (-2047, 2047), (0, 7), (0, 255), (0, 127), (0, 1))
any_senses = st.builds(
    Senses,
    st.integers(0, 4095),
    st.integers(0, 31),
    st.booleans(),
    st.booleans(),
    st.integers(0, 8191),
    st.integers(0, 4095),
    st.integers(0, 4095),
)


@given(st.tuples(*(st.integers(low, high) for low, high in DRIVE_RANGES)))
def test_the_fast_way_of_reading_a_drive_is_that_of_the_dbc(values):
    names = ("tick", "left", "right", "reason", "repeat_count", "action", "eat")
    frame = PROTOCOL.encode("DRIVE", dict(zip(names, values, strict=True)))

    said = PROTOCOL.decode(frame)

    assert said is not None
    assert PROTOCOL.decode_drive(frame) == drive_from(said) == values


@given(any_senses)
def test_senses_come_back_as_they_went(senses):
    said = PROTOCOL.decode(PROTOCOL.encode_senses(senses))

    assert said is not None
    assert said.name == "SENSES"
    assert Senses(*(said.signals[name] for name in list(said.signals)[1:])) == senses


def test_the_crc_is_the_published_one():
    assert crc8(0x3231, b"?3456789") == 0x4B  # SAE J1850's check value, of "123456789"


def test_a_drive_is_read_with_its_signs():
    signals = {"tick": 9, "reason": 5, "left": -251, "right": 251, "repeat_count": 3, "eat": 1, "action": 127}

    frame = PROTOCOL.encode("DRIVE", signals)

    assert PROTOCOL.decode_drive(frame) == (9, -251, 251, 5, 3, 127, True)


@given(any_senses, st.integers(0, 63), st.integers(0, 63))
def test_no_two_flipped_bits_get_through(senses, one, other):
    frame = PROTOCOL.encode_senses(senses)
    flips = (1 << one) | (1 << other)

    damaged = (int.from_bytes(frame.data, "little") ^ flips).to_bytes(8, "little")

    assert PROTOCOL.decode(Frame(frame.id, damaged)) is None


def test_frames_of_other_nodes_are_not_ours():
    theirs = Protocol(2).encode_senses(Senses(0, 0, False, False, 0, 0, 0))

    assert PROTOCOL.decode(theirs) is None
    assert Protocol(2).decode(theirs) is not None


@pytest.mark.parametrize("node", [0, 64, -1])
def test_a_node_out_of_range_is_refused(node):
    with pytest.raises(ValueError, match=r"1\.\.63"):
        Protocol(node)
