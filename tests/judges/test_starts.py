"""Unmodified flash images start in LabWired, an emulator that takes interrupts, whatever their flash holds."""

import re
import struct
import zlib
from collections.abc import Iterator, Sequence

import pytest

from host_sim.protocol.codec import Protocol
from host_sim.protocol.generated import Reason
from tests.judges.labwired_board import Board, Frame
from tests.runs.support import REFERENCE, record

PLACE = struct.Struct("<I8s")
"""A record of the store without its CRC: its number, and eight bytes."""


def store_record(number: int, memory: bytes) -> bytes:
    """A record, by the description in flash_store.h."""
    data = PLACE.pack(number, memory)
    return data + struct.pack("<I", zlib.crc32(data))


def page(records: int) -> bytes:
    """A page that was erased, which its mark says, and written."""
    mark = PLACE.pack(0, bytes(8))
    written = b"".join(
        store_record(number, bytes((0, 1 + number % 2, *bytes(6)))) for number in range(1, records + 1)
    )
    return mark + struct.pack("<I", ~zlib.crc32(mark) & 0xFFFFFFFF) + written


STORES = {
    "blue_pill": (0x0800F800, 0x0800E800, 0x0800F000, 1024),
    "feather_stm32f405": (0x08004000, 16384),
    "nucleo_g431rb": (0x0801F000, 2048),
}
"""The first page of each store of a board, and the size of a page."""
FILLS = {"blank": 0, "full": -1, "roomy": 3}
IMAGES = [
    *(("blue_pill", link) for link in ("bxcan", "slcan", "pins", "mute", "body")),
    *(("feather_stm32f405", link) for link in ("bxcan", "slcan")),
    ("nucleo_g431rb", "slcan"),
]
GPIOB_ODR, INFRARED = 0x40010C0C, 13
"""The pin that lights the sensors in one of four beats."""
BOOT_STEPS = 2000
"""In steps of 250 us: at an eighth of the clock, a look at each record of an F405 takes long."""


def fill(board: Board, name: str, fill: str) -> None:
    """Fills the stores."""
    *pages, size = STORES[name]
    for at in pages if fill != "blank" else ():
        board.flash(at, page(size // 16 - 1 if fill == "full" else 3))


def is_alive(board: Board, link: str) -> bool:
    """Whether the robot says that it has started, or that it senses; one without CAN lights its sensors."""
    lit = set()
    for _ in range(BOOT_STEPS):
        if board.listen("250us"):
            return True
        if link == "mute":
            lit.add(board.sim.read_u32(GPIOB_ODR) >> INFRARED & 1)
        if lit == {0, 1}:
            return True
    return False


@pytest.mark.parametrize("fills", FILLS)
@pytest.mark.parametrize(("name", "link"), IMAGES)
def test_image_starts_with_any_content_of_its_store(name, link, fills, tmp_path):
    board = Board(name, link, tmp_path)
    fill(board, name, fills)

    assert is_alive(board, link)


@pytest.mark.parametrize("fills", ["blank", "full"])
@pytest.mark.parametrize("link", ["pins", "mute", "body"])
def test_stand_alone_robot_survives_a_beat_during_an_erase(link, fills, tmp_path):
    """LabWired erases in no time, so the beat is made pending in each erase, as it would be after 5 of its 20 ms."""
    board = Board("blue_pill", link, tmp_path)
    fill(board, "blue_pill", fills)
    erases = was = 0

    for _ in range(20_000):
        board.sim.run_for("1us")
        control = board.sim.read_u32(0x40022010) & 0x42
        if control == 0x42 != was:
            erases += 1
            board.sim.write_u32(0xE000E200, 1 << 25)
        was = control

    assert erases > 0
    assert is_alive(board, link)


TICKS = 400
LINE = re.compile(r"\(\S+\) \S+ ([0-9A-F]{3})#([0-9A-F]*)$")
PROTOCOL = Protocol()
COMMAND, SENSES = PROTOCOL.id_of("COMMAND"), PROTOCOL.id_of("SENSES")
TICKS_JUDGED = {"slcan": 400, "bxcan": 300}
JUDGED = [
    *((board, "slcan") for board in ("blue_pill", "feather_stm32f405", "nucleo_g431rb", "pico")),
    *((board, "bxcan") for board in ("blue_pill", "feather_stm32f405")),
]

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


@pytest.mark.parametrize(("board", "link"), JUDGED)
def test_image_answers_300_ticks_or_more_as_the_host_does(board, link, exchanges, tmp_path):
    judged = Board(board, link, tmp_path)
    judged.listen("30ms")

    assert list(differences(judged, first(exchanges, TICKS_JUDGED[link]))) == []


def test_changed_byte_of_the_log_is_reported_as_a_difference(exchanges, tmp_path):
    judged = Board("blue_pill", "bxcan", tmp_path)
    judged.listen("30ms")
    *same, (asked, (answer, *more)) = first(exchanges, 5)
    changed = answer._replace(data=bytes([answer.data[0] ^ 1]) + answer.data[1:])

    found = list(differences(judged, [*same, (asked, [changed, *more])]))

    assert found == [(asked, [answer, *more], [changed, *more])]


def test_robot_stops_when_the_senses_end(exchanges, tmp_path):
    judged = Board("blue_pill", "slcan", tmp_path)
    judged.listen("30ms")
    moving = list(differences(judged, first(exchanges, 10), "20ms"))

    heard = judged.listen("150ms")

    said = [PROTOCOL.decode(frame) for frame in heard]
    drives = [it.signals for it in said if it is not None and it.name == "DRIVE"]
    assert moving == []
    assert [(it["reason"], it["left"], it["right"]) for it in drives[:1]] == [(Reason.SILENCE, 0, 0)]


def test_labwired_plugin_that_turns_missing_parts_into_skips_is_off(request):
    assert not request.config.pluginmanager.has_plugin("labwired")
