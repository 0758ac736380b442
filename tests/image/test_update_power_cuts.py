"""The power fails during an update of an emulated board: an image starts, and the update can be made again.

`tests/hal/boot/test_update_power_cuts.c` does so at each operation of the flash, on a smaller chip. Here it is the
real image, of whose many half-words one of EVERY is cut; `python -m tests.image.power_cuts` tries all of them.
"""

import pytest

from tests.image.power_cuts import (
    CHOICE,
    Recording,
    recording_of_an_update,
    restarted,
    slot_after,
    slots_after,
)
from tests.image.update_rig import LAYOUT, NEW, images, put_on

EVERY, AGAIN_EVERY = 97, 2_000


@pytest.fixture(scope="module")
def recording():
    return recording_of_an_update()


def is_worth_a_cut(recording: Recording, number: int) -> bool:
    """Each erase and each change of the choice, and some of the image."""
    offset, whole, _ = recording.changes[number]
    return offset >= CHOICE or len(whole) > 2 or number % EVERY == 0


def test_wherever_it_fails_an_image_starts_and_the_memory_is_there(recording):
    cuts = [number for number in range(len(recording.changes)) if is_worth_a_cut(recording, number)]

    assert len(recording.changes) > 7_000
    assert len(cuts) > 100
    assert set(slots_after(recording, cuts)) == {0, 1}


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

    assert slot_after(restarted(recording.before), bytes(memory)) is None
