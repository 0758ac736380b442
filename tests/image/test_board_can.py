"""An emulated board's CAN controller and bus fail, or carry noise: frames are lost at most, and counted."""

import pytest

from host_sim.emulator.can import CanFaults, CanFrame
from host_sim.emulator.clock import SECOND
from host_sim.emulator.hardware import Faults
from tests.image.support import counted, is_rest, talk_to

NOISE_PER_TICK = 200
"""Ten thousand frames a second."""


def test_stuck_controller_resets_the_board_and_sends_no_frame(name):
    talk = talk_to(name, Faults(can=CanFaults(init_stuck=True)))

    said = talk.wait(0.1)

    assert said == []
    assert len(talk.board.resets) > 5
    assert set(talk.board.resets) == {"software"}


def test_image_works_with_two_mailboxes(name):
    talk = talk_to(name, Faults(can=CanFaults(stuck_mailboxes=0b001)))
    talk.start()

    drives = talk.live(100)

    # The first frame that got stuck is lost, and the driver cannot know.
    assert len(drives) >= 99


@pytest.mark.parametrize("signal", ["CAN_RX", "CAN_TX"])
def test_image_with_can_on_another_pin_is_silent(name, signal):
    talk = talk_to(name)
    talk.board.hardware.wiring.rewire(signal, "PC13")
    talk.start()

    assert talk.live(5) == []


def test_stuck_mailboxes_lose_frames_and_recover(name):
    talk = talk_to(name)
    talk.start()
    talk.live(5)
    model = talk.board.hardware.can.node

    model.stuck_mailboxes = 0b111
    during = talk.live(20)
    model.stuck_mailboxes = 0
    talk.live(5)

    assert during == []
    assert len(talk.live(20)) == 20
    assert counted(talk.ask())["dropped"] > 0
    assert talk.board.resets == []


def test_frames_lost_in_the_controller_are_counted(name):
    talk = talk_to(name)
    talk.start()
    talk.live(5)

    for _ in range(6):
        talk.board.send(talk.senses())
    talk.board.hardware.clock.skip(5 * SECOND // 1000)  # the core stands still meanwhile
    talk.wait(0.02)

    assert talk.board.hardware.can.node.overruns == 3
    assert len(talk.live(10)) == 10
    report = counted(talk.ask())
    assert report.pop("missed") == 3
    assert report


def test_robot_recovers_from_bus_off(name):
    talk = talk_to(name)
    talk.start()
    talk.live(5)

    talk.board.hardware.can.wire.shorted = True
    during = talk.live(20)
    talk.board.hardware.can.wire.shorted = False
    first = talk.wait(0.5)

    assert during == []
    assert all(is_rest(said) for said in first if said.name == "DRIVE")
    assert len(talk.live(20)) == 20
    report = talk.ask()
    assert report["bus_offs"] > 0
    assert report["silences"] > 0
    assert talk.board.resets == []


def test_frames_that_waited_during_bus_off_are_not_sent(name):
    talk = talk_to(name)
    talk.start()
    talk.live(5)
    talk.board.hardware.can.wire.shorted = True
    talk.live(20)
    talk.board.hardware.can.wire.shorted = False
    talk.wait(0.5)

    fresh = talk.live(1)

    assert [drive.signals["tick"] for drive in fresh] == [talk.tick]


def test_lone_robot_is_error_passive_and_recovers(name):
    talk = talk_to(name)
    talk.start()
    talk.live(5)

    talk.board.hardware.can.wire.alone = True
    talk.wait(1.0)
    errors = talk.board.hardware.can.node.tec
    talk.board.hardware.can.wire.alone = False
    talk.wait(0.05)

    assert errors == 128  # passive
    assert len(talk.live(10)) == 10
    assert talk.board.resets == []


def test_invalid_frames_are_counted_and_foreign_ones_filtered(name):
    talk = talk_to(name)
    talk.start()
    talk.live(5)
    senses = talk.protocol.id_of("SENSES")
    command = talk.protocol.id_of("COMMAND")

    for frame in (
        CanFrame(senses, b"short"),
        CanFrame(senses),
        CanFrame(command, b"wrong CRC"[:8]),
    ):
        talk.board.put(frame)
    for frame in (
        CanFrame(senses, bytes(8), remote=True),
        CanFrame(senses << 18, bytes(8), extended=True),
        CanFrame(senses, bytes(8), extended=True),
        CanFrame(senses + 1, bytes(8)),
        CanFrame(0x7FF),
        CanFrame(0),
    ):
        talk.board.put(frame)
    talk.wait(0.01)

    assert len(talk.live(10)) == 10
    assert counted(talk.ask()) == {"damaged": 3}


def test_noise_of_10000_frames_per_second_loses_no_tick(name):
    talk = talk_to(name)
    talk.start()
    before = len(talk.heard)

    for _ in range(25):
        talk.board.send(talk.senses())
        for i in range(NOISE_PER_TICK):
            talk.board.put(CanFrame(0x200 + i))
        talk.wait(0.02)

    drives = [said for said in talk.heard[before:] if said.name == "DRIVE"]
    assert [drive.signals["tick"] for drive in drives] == list(range(25))
    assert counted(talk.ask()) == {}


def test_noise_on_own_identifiers_is_counted_and_loses_no_tick(name):
    talk = talk_to(name)
    talk.start()
    before = len(talk.heard)
    noise = CanFrame(talk.protocol.id_of("SENSES"))

    for _ in range(10):
        talk.board.send(talk.senses())
        for _ in range(NOISE_PER_TICK):
            talk.board.put(noise)
        talk.wait(0.02)

    drives = [said for said in talk.heard[before:] if said.name == "DRIVE"]
    assert [drive.signals["tick"] for drive in drives] == list(range(10))
    assert talk.ask()["damaged"] == 255
