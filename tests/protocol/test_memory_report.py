"""The two halves of a memory are joined if they belong together."""

from host_sim.protocol.codec import DecodedFrame
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
