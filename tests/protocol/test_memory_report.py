"""The two halves of a memory on the wire, and frames of any node."""

from host_sim.protocol.codec import DecodedFrame, Frame, Protocol
from host_sim.protocol.every_node import IDS, Heard, hear
from host_sim.protocol.generated import Senses
from host_sim.protocol.memory_report import MemoryReport


def half(number: int, counter: int = 1) -> DecodedFrame:
    cells = {f"cell_{4 * number + i}": 10 * number + i for i in range(4)}
    return DecodedFrame("MEMORY", {"half": number, "counter": counter, **cells})


WHOLE = (0, 1, 2, 3, 10, 11, 12, 13)


def test_halves_are_joined_in_whichever_order_they_come():
    report = MemoryReport()

    assert [report.join(half(0)), report.join(half(1))] == [None, WHOLE]
    assert [report.join(half(1)), report.join(half(0))] == [None, WHOLE]


def test_halves_of_two_reports_are_not_joined():
    report = MemoryReport()

    assert [report.join(half(0, counter=1)), report.join(half(1, counter=2))] == [None, None]
    assert report.join(half(0, counter=2)) == WHOLE


def test_a_half_that_there_is_not_is_left_out():
    report = MemoryReport()
    report.join(half(0))

    assert report.join(half(2)) is None
    assert report.join(half(1)) == WHOLE


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
