"""The power fails during an update of an emulated board: an image starts, and the update can be made again.

`tests/hal/boot/test_update_power_cuts.c` does so at each operation of the flash, on a smaller chip. Here it is the
real image, of whose many half-words every EVERYth is cut: 1 tries all of them, in minutes.
"""

from dataclasses import dataclass, field

import pytest

from host_sim.emulator import board as board_module
from tests.image.support import Talk
from tests.image.update_rig import LAYOUT, NEW, board_with, fresh_board, images, put_on, runs_in

EVERY, AGAIN_EVERY = 97, 2_000
CHOICE, STORE = 60 * 1024, 62 * 1024
LESSON = {"mask": 0b1111, "half": 0, "byte_0": 0, "byte_1": 1, "byte_2": 0, "byte_3": 0}


@dataclass
class Recording:
    """What an update did to a flash: its bytes before; of each change place, bytes after, and bytes if it was cut."""

    before: bytes = b""
    changes: list[tuple[int, bytes, bytes]] = field(default_factory=list)

    def cut_at(self, number: int) -> bytes:
        """The flash as it is if the power fails within that change."""
        memory = bytearray(self.before)
        for offset, whole, _ in self.changes[:number]:
            memory[offset : offset + len(whole)] = whole
        offset, _, partial = self.changes[number]
        memory[offset : offset + len(partial)] = partial
        return bytes(memory)

    def worth_a_cut(self, number: int) -> bool:
        """Each erase and each change of the choice, and some of the image."""
        offset, whole, _ = self.changes[number]
        return offset >= CHOICE or len(whole) > 2 or number % EVERY == 0


@pytest.fixture(scope="module")
def recording():
    """Of an update from OLD to NEW, up to the confirmation, on a board that has learned something."""
    board = fresh_board()
    talk = Talk(board)
    talk.order("write", **LESSON)
    talk.wait(0.2)
    flash = board.hardware.flash
    found = Recording(bytes(flash.memory))
    change = flash._change

    def recorded(offset, whole, partial):
        found.changes.append((offset, whole, partial))
        change(offset, whole, partial)

    flash._change = recorded
    updater = put_on(board, NEW)
    updater.restart()
    updater.running()
    board.pass_time(6.0)
    assert updater.running() == (NEW, False)
    return found


def restarted(memory):
    return board_with((LAYOUT.boot, memory[LAYOUT.boot :]))


def test_wherever_it_fails_an_image_starts_and_the_memory_is_there(recording, monkeypatch):
    monkeypatch.setattr(board_module, "_BOOT_S", 0.05)
    cuts = [number for number in range(len(recording.changes)) if recording.worth_a_cut(number)]
    chosen = set()
    for number in cuts:
        board = restarted(recording.cut_at(number))
        slot = runs_in(board)
        assert slot is not None, f"no image starts after a cut at {number}"
        assert bytes(board.hardware.flash.memory[STORE:]) == recording.before[STORE:]
        chosen.add(slot)

    assert len(recording.changes) > 7_000
    assert len(cuts) > 100
    assert chosen == {0, 1}


def test_wherever_it_fails_the_update_can_be_made_again(recording):
    for number in range(0, len(recording.changes), AGAIN_EVERY):
        board = restarted(recording.cut_at(number))
        updater = put_on(board, NEW)
        data = images(NEW)[1].data
        assert bytes(board.hardware.flash.memory[LAYOUT.slots[1] :][: len(data)]) == data
        updater.restart()
        assert updater.running() == (NEW, True)


def test_a_cut_that_lost_both_images_would_be_noticed(recording):
    memory = bytearray(recording.before)
    memory[LAYOUT.slots[0] + 300] ^= 1

    assert runs_in(restarted(bytes(memory))) is None
