"""A frame of any node is known by its identifier."""

from host_sim.protocol.codec import Frame, Protocol
from host_sim.protocol.every_node import IDS, Heard, hear
from host_sim.protocol.generated import Senses

SENSES = Protocol(3).encode_senses(Senses(7, 4, False, False, 0, 1, 2), 5)


def test_a_frame_is_heard_as_that_of_its_node():
    heard = hear(SENSES)

    assert (heard.node, heard.name) == (3, "SENSES")
    assert (heard.signals["tick"], heard.signals["feel"]) == (7, 4)


def test_a_damaged_frame_is_its_nodes_and_says_nothing():
    assert hear(Frame(SENSES.id, bytes(8))) == Heard(3, "SENSES", None)


def test_an_identifier_of_no_message_is_nobodys():
    unknown = next(number for number in range(0x800) if number not in IDS)

    assert hear(Frame(unknown, b"")) is None
