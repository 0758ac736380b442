"""Updates on an emulated board: the boot loader and the images that are flashed, and the tester that people use."""

import re
from functools import cache

import pytest
from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey
from udsoncan.exceptions import TimeoutException

from host_sim.client.connection import Connection
from host_sim.protocol.codec import Protocol
from host_sim.protocol.generated import UPDATE_REQUEST_ID
from host_sim.update.image import built_images
from host_sim.update.isotp_connection import IsoTpConnection
from host_sim.update.updater import UpdateError, Updater
from tests.image.support import Talk, run_robot
from tests.image.update_figures import TimedLink, figures_of
from tests.image.update_rig import BLUE_PILL, KEY, NEW, OLD, written
from tests.tools.project import ROOT

LESSON = {"mask": 0b1111, "half": 0, "byte_0": 0, "byte_1": 1, "byte_2": 0, "byte_3": 0}


def learn(board):
    talk = Talk(board)
    talk.order("write", **LESSON)
    talk.wait(0.2)
    return talk


def proof_in(frames):
    """The frames of the request that carries the proof: a first frame, and those that go on from it."""
    sent = [frame for _, frame in frames if frame.id > UPDATE_REQUEST_ID]
    begin = next(i for i, frame in enumerate(sent) if frame.data[2:4] == b"\x27\x02")
    return [sent[begin], *(frame for frame in sent[begin + 1 :][:9])]


def interrupt_after(count):
    """Ends an update once so many bytes are there."""

    def progress(there):
        if there >= count:
            raise KeyboardInterrupt

    return progress


def test_a_robot_starts_through_its_boot_loader(rig):
    board = rig.fresh_board()

    assert rig.runs_in(board) == 0
    assert board.resets == []
    assert board.hardware.faults == []


@cache
def figures_once(rig):
    return figures_of(rig)


def test_the_document_has_the_figures(rig):
    page = (ROOT / "docs" / "update.md").read_text()
    name = rig.board.partition("_stm")[0].partition("_g4")[0].replace("_", " ").title()
    (row,) = re.findall(rf"^\| {name} \| (\d+ ms .*)$", page, re.MULTILINE)
    *written, _limit = (float(number.replace(",", "")) for number in re.findall(r"[\d,.]*\d", row))
    it = figures_once(rig)

    times = (it.update_s, it.limit, it.bus_s, it.erase_s, it.check_s)
    measured = (1000 * it.start_s, it.image_bytes, *times, it.changes, it.boot_bytes)
    assert written == pytest.approx(measured, rel=0.05, abs=0.011)  # compilers differ by as much


def test_start_and_update_take_no_longer_than_they_may(rig):
    figures = figures_once(rig)

    assert figures.start_s < 0.030
    assert figures.update_s < 3.0
    assert figures.limit_without_flash <= 1.3
    assert figures.erase_s + figures.check_s < figures.update_s - figures.bus_s


def test_after_an_update_the_new_image_runs_with_the_memory(rig):
    board = rig.fresh_board()
    learn(board)
    tester = rig.put_on(board, NEW)
    tester.restart()

    assert tester.running() == (NEW, True)
    assert rig.runs_in(board) == 1
    board.pass_time(6.0)
    assert tester.running() == (NEW, False)
    talk = Talk(board, protocol=Protocol())
    talk.order("stop")
    talk.wait(0.05)
    assert talk.memory[1] == 1


def test_a_run_an_update_and_the_next_run_has_the_memory(rig, tmp_path):
    board = rig.fresh_board()
    connection = Connection(board, now=board.now)
    learned = run_robot(connection, 3, 1000, tmp_path / "before.log").memory
    board.pass_time(1.0)
    rig.put_on(board, NEW).restart()
    board.pass_time(1.0)
    client = run_robot(connection, 4, 1, tmp_path / "after.log")

    assert any(learned)
    assert client.memory == learned
    assert rig.runs_in(board) == 1


def test_a_robot_that_is_driven_is_not_updated(rig):
    board = rig.fresh_board()
    talk = Talk(board)
    talk.start()
    talk.live(5)

    with pytest.raises(UpdateError, match="is being driven"):
        Updater(board, 1, KEY).enter()


def test_another_key_is_refused_before_anything_is_changed(rig):
    board = rig.fresh_board()
    tester = Updater(board, 1, Ed25519PrivateKey.generate())
    tester.enter()
    before = written(board)

    with pytest.raises(UpdateError, match="has another key"):
        tester.unlock()
    assert written(board) == before


def test_a_proof_of_an_earlier_session_is_refused_when_it_is_replayed(rig):
    board = rig.fresh_board()
    link = TimedLink(board)
    tester = Updater(link, 1, KEY)
    tester.enter()
    tester.unlock()
    heard = IsoTpConnection(board, 1)
    replayed = b"".join(frame.data[1:] for frame in proof_in(link.frames))[1:][:66]
    tester.enter()
    before = written(board)
    heard.specific_send(b"\x27\x01")
    heard.specific_wait_frame(1.0)
    heard.specific_send(replayed)

    assert replayed.startswith(b"\x27\x02")
    assert heard.specific_wait_frame(1.0) == b"\x7f\x27\x35"
    assert written(board) == before
    tester.restart()
    assert tester.running() == (OLD, False)


def test_an_image_of_another_signer_is_not_chosen(rig):
    board = rig.fresh_board()
    tester = Updater(board, 1, KEY)
    tester.enter()
    tester.unlock()
    foreign = built_images(rig.board, rig.layout.link, NEW, Ed25519PrivateKey.generate())[1]

    with pytest.raises(UpdateError, match="not signed by the key of this board"):
        tester.install(foreign, lambda _count: None)
    tester.restart()
    assert tester.running() == (OLD, False)


def test_an_older_image_is_refused_before_anything_is_erased(rig):
    board = rig.fresh_board()
    tester = Updater(board, 1, KEY)
    tester.enter()
    tester.unlock()
    before = written(board)

    with pytest.raises(UpdateError, match="older than the board accepts"):
        tester.install(rig.images(OLD - 1)[1], lambda _count: None)
    assert written(board) == before
    tester.lower_floor(OLD - 1)
    tester.install(rig.images(OLD - 1)[1], lambda _count: None)


def test_a_new_image_that_is_never_confirmed_goes_back(rig):
    board = rig.fresh_board()
    rig.put_on(board, NEW).restart()
    slots = []
    for _ in range(5):
        board.pass_time(0.3)
        slots.append(rig.runs_in(board))
        board.cut_power()

    assert slots == [1, 1, 1, 0, 0]


def test_an_update_that_was_cut_goes_on_where_it_was(rig):
    board = rig.fresh_board()
    flash = board.hardware.flash
    pages, writes = rig.layout.slot_bytes // rig.layout.page, {"blue_pill": 7700, "nucleo_g431rb": 1960}
    flash.cuts.add(flash.operations + pages + writes.get(rig.board, 3930) * 3 // 4)
    rig.put_on(board, NEW)

    assert board.resets == ["software", "power", "software"]
    assert flash.erasures < max(2 * pages, 6)
    assert bytes(flash.memory[rig.layout.slots[1] :][: len(rig.images(NEW)[1].data)]) == rig.images(NEW)[1].data


@pytest.mark.parametrize("rig", [BLUE_PILL], ids=lambda rig: rig.board)
def test_an_update_that_goes_on_is_not_given_up_if_an_erase_comes_twice(rig, monkeypatch):
    """Its answer was lost; the page before it is the last one now, which may not be whole."""
    board, image = rig.fresh_board(), rig.images(NEW)[1]
    updater = Updater(board, 1, KEY)
    updater.enter()
    updater.unlock()
    with pytest.raises(KeyboardInterrupt):
        updater.install(image, interrupt_after(len(image.data) // 2))
    erase, asked = updater._client.start_routine, []

    def lose_first(*words):
        answer = erase(*words)
        asked.append(words[0])
        if len(asked) == 1:
            raise TimeoutException
        return answer

    monkeypatch.setattr(updater._client, "start_routine", lose_first)

    updater.install(image, lambda _count: None)

    assert len(asked) > 2
    assert bytes(board.hardware.flash.memory[rig.layout.slots[1] :][: len(image.data)]) == image.data


def test_a_chip_whose_image_is_not_signed_stays_in_the_boot_loader(rig):
    data = bytearray(rig.images(OLD)[0].data)
    data[-1] ^= 1
    board = rig.board_with((rig.layout.slots[0], bytes(data)))

    assert rig.runs_in(board) is None
    tester = rig.put_on(board, NEW)
    tester.restart()
    assert tester.running() == (NEW, True)
