"""Unmodified flash images in LabWired, an emulator that nobody here wrote, answer as the host does."""

import re
from collections.abc import Iterator, Sequence

import pytest

from host_sim.protocol.codec import Protocol
from host_sim.protocol.generated import Reason
from tests.judges.labwired_board import Board, Frame
from tests.runs.equality import REFERENCE, record

TICKS = 400
LINE = re.compile(r"\(\S+\) \S+ ([0-9A-F]{3})#([0-9A-F]*)$")
PROTOCOL = Protocol()
COMMAND, SENSES = PROTOCOL.id_of("COMMAND"), PROTOCOL.id_of("SENSES")
SLCAN, BXCAN = (
    [("blue_pill", "slcan"), ("feather_stm32f405", "slcan"), ("nucleo_g431rb", "slcan"), ("pico", "slcan")],
    [("blue_pill", "bxcan"), ("feather_stm32f405", "bxcan")],
)

Exchanges = Sequence[tuple[Frame, list[Frame]]]


@pytest.fixture(scope="module")
def exchanges(tmp_path_factory: pytest.TempPathFactory) -> Exchanges:
    """Each frame that the host's firmware heard in a run, and what it answered."""
    log = tmp_path_factory.mktemp("host") / "run.log"
    record(REFERENCE, 1, TICKS, log)
    found: list[tuple[Frame, list[Frame]]] = []
    for match in filter(None, map(LINE.match, log.read_text().splitlines())):
        frame = Frame(int(match[1], 16), bytes.fromhex(match[2]))
        if frame.id in (COMMAND, SENSES):
            found.append((frame, []))
        else:
            found[-1][1].append(frame)
    return found


def first(exchanges: Exchanges, ticks: int) -> Exchanges:
    """The exchanges of the first ticks."""
    places = [place for place, (asked, _) in enumerate(exchanges) if asked.id == SENSES]
    return exchanges[: places[ticks - 1] + 1]


def differences(
    board: Board, exchanges: Exchanges, span: str = ""
) -> Iterator[tuple[Frame, list[Frame], list[Frame]]]:
    """Each frame that is answered otherwise, with what was heard and expected; `span` is the time of a tick."""
    for asked, expected in exchanges:
        heard = board.ask(asked, len(expected), span if asked.id == SENSES else "")
        if heard != expected:
            yield asked, heard, expected


@pytest.mark.parametrize(("board", "link"), SLCAN)
def test_an_slcan_image_answers_400_ticks_as_the_host_does(board, link, exchanges, tmp_path):
    judged = Board(board, link, tmp_path)
    judged.listen("30ms")

    assert list(differences(judged, first(exchanges, 400))) == []


@pytest.mark.parametrize(("board", "link"), BXCAN)
def test_a_bxcan_image_answers_300_ticks_as_the_host_does(board, link, exchanges, tmp_path):
    judged = Board(board, link, tmp_path)
    judged.listen("30ms")

    assert list(differences(judged, first(exchanges, 300))) == []


def test_a_byte_of_the_log_that_was_changed_is_a_difference(exchanges, tmp_path):
    judged = Board("blue_pill", "bxcan", tmp_path)
    judged.listen("30ms")
    *same, (asked, (answer, *more)) = first(exchanges, 5)
    changed = answer._replace(data=bytes([answer.data[0] ^ 1]) + answer.data[1:])

    found = list(differences(judged, [*same, (asked, [changed, *more])]))

    assert found == [(asked, [answer, *more], [changed, *more])]


def test_a_robot_rests_when_the_senses_stop(exchanges, tmp_path):
    judged = Board("blue_pill", "slcan", tmp_path)
    judged.listen("30ms")
    moving = list(differences(judged, first(exchanges, 10), "20ms"))

    heard = judged.listen("150ms")

    said = [PROTOCOL.decode(frame) for frame in heard]
    drives = [it.signals for it in said if it is not None and it.name == "DRIVE"]
    assert moving == []
    assert [(it["reason"], it["left"], it["right"]) for it in drives[:1]] == [(Reason.SILENCE, 0, 0)]


def test_the_plug_in_of_labwired_does_not_turn_what_it_lacks_into_a_skip(request):
    assert not request.config.pluginmanager.has_plugin("labwired")
