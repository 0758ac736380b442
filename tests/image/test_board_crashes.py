"""The image crashes on an emulated board: it starts again and tells why, wherever its stack was."""

import pytest

from tests.image.support import Talk, talk_to


def told(talk: Talk) -> dict[str, int]:
    """What the board has told of its last crash: registers by name."""
    for _ in range(20):
        talk.ask()
    names = {number: register for register, number in talk.protocol.choices("CRASH", "name").items()}
    return {names[said.signals["name"]]: said.signals["value"] for said in talk.heard if said.name == "CRASH"}


VTOR, FLASH = 0xE000ED08, 0x08000000


def test_its_own_vectors_are_in_force_whoever_started_it(name):
    assert talk_to(name).board.hardware.space.read(VTOR, 4) == FLASH


def test_a_crash_is_told_afterwards(name):
    talk = talk_to(name)
    talk.start()
    talk.live(5)

    talk.board.hardware.core.derail(0x60000000)
    talk.wait(0.1)

    assert told(talk)["pc"] == 0x60000000
    assert talk.board.resets == ["software"]
    assert talk.last("BOOT")["reset_cause"] == talk.protocol.choices("BOOT", "reset_cause")["crash"]


@pytest.mark.parametrize("depth", [0, 8, 300, 600, 900])
def test_a_crash_is_told_wherever_the_stack_is(name, depth):
    talk = talk_to(name)
    stack_top = int.from_bytes(talk.board.hardware.flash.memory[:4], "little")

    talk.board.hardware.core.derail(0x60000000, stack=stack_top - depth)
    talk.wait(0.1)

    assert told(talk)["pc"] == 0x60000000


def test_a_stack_that_has_left_the_ram_ends_in_a_crash_too(name):
    talk = talk_to(name)

    talk.board.hardware.core.derail(0x60000000, stack=0x20000008)
    talk.wait(0.1)

    assert talk.board.resets == ["software"]
    assert talk.ask()["reset_cause"] == talk.protocol.choices("BOOT", "reset_cause")["crash"]
