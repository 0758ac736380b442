"""An emulated board's CAN controller and bus fail, or carry noise: frames are lost at most, and counted."""

import pytest

from host_sim.emulator.can import CanFaults, CanFrame
from host_sim.emulator.clock import SECOND
from host_sim.emulator.hardware import Faults
from host_sim.protocol.codec import Protocol
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
def test_image_with_can_on_another_pin_is_silent(talk, signal):
    talk.board.hardware.wiring.rewire(signal, "PC13")
    talk.start()

    assert talk.live(5) == []


def test_stuck_mailboxes_lose_frames_and_recover(driving):
    model = driving.board.hardware.can.node

    model.stuck_mailboxes = 0b111
    during = driving.live(20)
    model.stuck_mailboxes = 0
    driving.live(5)

    assert during == []
    assert len(driving.live(20)) == 20
    assert counted(driving.ask())["dropped"] > 0
    assert driving.board.resets == []


def test_frames_lost_in_the_controller_are_counted(driving):

    for _ in range(6):
        driving.board.send(driving.senses())
    driving.board.hardware.clock.skip(5 * SECOND // 1000)  # the core stands still meanwhile
    driving.wait(0.02)

    assert driving.board.hardware.can.node.overruns == 3
    assert len(driving.live(10)) == 10
    report = counted(driving.ask())
    assert report.pop("missed") == 3
    assert report


def test_robot_recovers_from_bus_off(driving):
    driving.board.hardware.can.wire.shorted = True
    during = driving.live(20)
    driving.board.hardware.can.wire.shorted = False
    first = driving.wait(0.5)

    assert during == []
    assert all(is_rest(said) for said in first if said.name == "DRIVE")
    assert len(driving.live(20)) == 20
    report = driving.ask()
    assert report["bus_offs"] > 0
    assert report["silences"] > 0
    assert driving.board.resets == []


def test_frames_that_waited_during_bus_off_are_not_sent(driving):
    driving.board.hardware.can.wire.shorted = True
    driving.live(20)
    driving.board.hardware.can.wire.shorted = False
    driving.wait(0.5)

    fresh = driving.live(1)

    assert [drive.signals["tick"] for drive in fresh] == [driving.tick]


def test_lone_robot_is_error_passive_and_recovers(driving):
    driving.board.hardware.can.wire.alone = True
    driving.wait(1.0)
    errors = driving.board.hardware.can.node.tec
    driving.board.hardware.can.wire.alone = False
    driving.wait(0.05)

    assert errors == 128  # passive
    assert len(driving.live(10)) == 10
    assert driving.board.resets == []


def test_invalid_frames_are_counted_and_foreign_ones_filtered(driving):
    senses = driving.protocol.id_of("SENSES")
    command = driving.protocol.id_of("COMMAND")

    for frame in (
        CanFrame(senses, b"short"),
        CanFrame(senses),
        CanFrame(command, b"wrong CRC"[:8]),
    ):
        driving.board.put(frame)
    for frame in (
        CanFrame(senses, bytes(8), remote=True),
        CanFrame(senses << 18, bytes(8), extended=True),
        CanFrame(senses, bytes(8), extended=True),
        CanFrame(senses + 1, bytes(8)),
        CanFrame(0x7FF),
        CanFrame(0),
    ):
        driving.board.put(frame)
    driving.wait(0.01)

    assert len(driving.live(10)) == 10
    assert counted(driving.ask()) == {"damaged": 3}


@pytest.mark.parametrize(
    ("ticks", "noise", "counted_as"),
    [
        (25, [CanFrame(0x200 + i) for i in range(NOISE_PER_TICK)], {}),
        (10, [CanFrame(Protocol().id_of("SENSES"))] * NOISE_PER_TICK, {"damaged": 255}),
    ],
    ids=["of other identifiers", "of its own"],
)
def test_noise_of_10000_frames_per_second_is_counted_and_loses_no_tick(talk, ticks, noise, counted_as):
    talk.start()
    before = len(talk.heard)

    for _ in range(ticks):
        talk.board.send(talk.senses())
        for frame in noise:
            talk.board.put(frame)
        talk.wait(0.02)

    drives = [said for said in talk.heard[before:] if said.name == "DRIVE"]
    assert [drive.signals["tick"] for drive in drives] == list(range(ticks))
    assert counted(talk.ask()) == counted_as
