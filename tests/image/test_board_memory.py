"""An emulated board keeps the robot's memory in its flash, starts again after crashes, and tells why."""

import struct

import pytest

from host_sim.emulator.flash import FlashFaults
from host_sim.emulator.hardware import Faults
from host_sim.protocol.generated import Side
from tests.image.support import Talk, counted, talk_to


def learn(talk: Talk, side: int) -> None:
    """Writes cell 1, and empties the others of its half."""
    talk.order("write", mask=0b1111, half=0, byte_0=0, byte_1=side, byte_2=0, byte_3=0)


def memory_after_power_up(talk: Talk) -> tuple[int, ...]:
    talk.board.cut_power()
    talk.wait(0.1)
    talk.order("stop")
    talk.wait(0.02)
    return talk.memory


def test_memory_survives_a_power_cut(talk):
    learn(talk, Side.LEFT)
    talk.wait(1.0)

    assert memory_after_power_up(talk) == (0, 1, 0, 0, 0, 0, 0, 0)


SMALL_PAGES = pytest.mark.parametrize("board", ["blue_pill", "nucleo_g431rb"])


@SMALL_PAGES
def test_full_flash_is_erased_and_written_again(board):
    talk = talk_to(board)
    for i in range(300):
        learn(talk, (Side.LEFT, Side.RIGHT)[i % 2])
    flash = talk.board.hardware.flash

    assert flash.erasures > 0
    assert counted(talk.ask()) == {}
    assert memory_after_power_up(talk) == (0, 2, 0, 0, 0, 0, 0, 0)


@SMALL_PAGES
def test_page_with_an_interrupted_erase_is_erased_again(board):
    talk = talk_to(board)
    flash = talk.board.hardware.flash
    flash.erasure_cuts.add(3)  # of a page with a mark
    for i in range(300):
        learn(talk, (Side.LEFT, Side.RIGHT)[i % 2])

    assert talk.board.resets == ["power"]
    assert flash.erasures > 3
    assert memory_after_power_up(talk) == (0, 2, 0, 0, 0, 0, 0, 0)


def test_failed_stores_are_counted_and_the_robot_continues(name):
    talk = talk_to(name, Faults(flash=FlashFaults(failing=frozenset(range(1, 1000)))))
    talk.start()
    learn(talk, Side.LEFT)

    assert len(talk.live(50)) == 50
    talk.wait(1.5)  # at rest there is time to erase, in vain
    assert talk.ask()["unsaved"] > 0
    assert talk.board.resets == []


def test_flash_is_written_only_with_a_good_supply(talk):
    talk.board.hardware.power.supply_mv = 2800
    operations = talk.board.hardware.flash.operations
    learn(talk, Side.LEFT)
    talk.wait(1.0)

    assert talk.board.hardware.flash.operations == operations
    assert talk.ask()["unsaved"] > 0
    talk.board.hardware.power.supply_mv = 3300
    learn(talk, Side.RIGHT)
    talk.wait(1.0)
    assert memory_after_power_up(talk) == (0, 2, 0, 0, 0, 0, 0, 0)


def test_power_cut_during_a_store_leaves_old_or_new_memory(name):
    found, cut_at, operations = set(), 0, 1
    while cut_at < operations:
        cut_at += 1
        talk = talk_to(name, Faults(flash=FlashFaults(cut_at=cut_at)))
        learn(talk, Side.LEFT)
        talk.wait(0.2)
        learn(talk, Side.RIGHT)
        talk.wait(0.2)
        found.add(memory_after_power_up(talk))
        operations = talk.board.hardware.flash.operations

    assert found == {(0, 1, 0, 0, 0, 0, 0, 0), (0, 2, 0, 0, 0, 0, 0, 0)}


def told(talk: Talk) -> dict[str, int]:
    """What the board has told of its last crash: registers by name."""
    for _ in range(20):
        talk.ask()
    names = {number: register for register, number in talk.protocol.choices("CRASH", "name").items()}
    return {names[said.signals["name"]]: said.signals["value"] for said in talk.heard if said.name == "CRASH"}


VTOR, FLASH = 0xE000ED08, 0x08000000


def test_image_installs_its_own_vector_table(talk):
    assert talk.board.hardware.space.read(VTOR, 4) == FLASH


def assert_crashed(talk: Talk) -> None:
    assert talk.board.resets == ["software"]
    assert talk.last("BOOT")["reset_cause"] == talk.protocol.choices("BOOT", "reset_cause")["crash"]


def test_crash_is_reported_after_the_reset(driving):
    driving.board.hardware.core.derail(0x60000000)
    driving.wait(0.1)

    assert told(driving)["pc"] == 0x60000000
    assert_crashed(driving)


@pytest.mark.parametrize("depth", [0, 8, 300, 600, 900])
def test_crash_is_reported_at_any_stack_depth(talk, depth):
    stack_top = int.from_bytes(talk.board.hardware.flash.memory[:4], "little")

    talk.board.hardware.core.derail(0x60000000, stack=stack_top - depth)
    talk.wait(0.1)

    assert told(talk)["pc"] == 0x60000000


def test_uncorrectable_ecc_error_outside_of_a_read_is_a_crash():
    talk = talk_to("nucleo_g431rb")
    hardware = talk.board.hardware
    hardware.flash.unreadable.add(0x1F800)
    ram, load, stay = 0x20001000, (0x4801, 0x6800), 0xE7FE  # ldr r0, [pc, #4]; ldr r0, [r0]; b .
    hardware.core.write(ram, struct.pack("<4HI", *load, stay, stay, FLASH + 0x1F800))

    hardware.core.derail(ram)
    talk.wait(0.1)

    assert ram <= told(talk)["pc"] <= ram + 8
    assert_crashed(talk)


def test_stack_outside_the_ram_is_reported_as_a_crash(talk):
    talk.board.hardware.core.derail(0x60000000, stack=0x20000008)
    talk.wait(0.1)
    talk.ask()

    assert_crashed(talk)
