"""The power fails during an update of an emulated board: an image starts, and the update can be made again.

`tests/hal/boot/test_update_power_cuts.c` does so at each operation of the flash, on a smaller chip. Here it is the
real image, of whose many writes one of EVERY is cut; `python -m tests.image.power_cuts` tries all of them.
"""

import pytest

from tests.image.power_cuts import WRITE_MAX, Recording, recording_of_an_update, restarted, slot_after, slots_after
from tests.image.update_rig import NEW, RIGS

EVERY, AGAIN_EVERY = 97, 2_000


@pytest.fixture(scope="module", params=RIGS, ids=lambda rig: rig.board)
def recording(request):
    return recording_of_an_update(request.param)


def is_worth_a_cut(recording: Recording, number: int) -> bool:
    """Each erase and each change of the choice, and some of the image."""
    offset, whole, _ = recording.changes[number]
    begin, end = recording.rig.span
    return not begin <= offset < end or len(whole) > WRITE_MAX or number % EVERY == 0


def test_wherever_it_fails_an_image_starts_and_the_memory_is_there(recording):
    cuts = [number for number in range(len(recording.changes)) if is_worth_a_cut(recording, number)]

    assert len(recording.changes) > recording.rig.images(NEW)[1].size // WRITE_MAX
    assert len(cuts) > len(recording.changes) // EVERY
    assert set(slots_after(recording, cuts)) == {0, 1}


def test_wherever_it_fails_the_update_can_be_made_again(recording):
    rig = recording.rig
    for number in range(0, len(recording.changes), AGAIN_EVERY):
        board = restarted(rig, recording.before)
        recording.cut(board, number)
        board.cut_power()
        updater = rig.put_on(board, NEW)
        data = rig.images(NEW)[1].data
        assert bytes(board.hardware.flash.memory[rig.layout.slots[1] :][: len(data)]) == data
        updater.restart()
        assert updater.running() == (NEW, True)


def test_a_cut_that_lost_both_images_would_be_noticed(recording):
    rig = recording.rig
    board = restarted(rig, recording.before)
    board.hardware.flash.memory[rig.layout.slots[0] + 300] ^= 1

    assert slot_after(rig, board, bytes(board.hardware.flash.memory)) is None
