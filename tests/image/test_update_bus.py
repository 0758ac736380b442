"""Updates over a bus that loses frames, of other numbers and bit rates, and with more than one board."""

from functools import partial

import pytest

from host_sim.emulator.registers import BoardError
from host_sim.protocol.codec import Protocol
from host_sim.update.hub import Hub
from host_sim.update.updater import UpdateError, Updater
from tests.image.support import Talk
from tests.image.update_rig import BLUE_PILL, KEY, NEW, OLD, Crowd, LossyLink, written


def number(board, node):
    tester = Updater(board, 1, KEY)
    tester.enter()
    tester.unlock()
    tester.set_node(node)
    tester.restart()
    board.pass_time(0.2)


def update(tester):
    tester.enter()
    tester.unlock()
    tester.install(BLUE_PILL.images(NEW)[tester.status().free], lambda _count: None)
    tester.restart()
    tester.running()


@pytest.mark.parametrize("rig", [BLUE_PILL], ids=lambda rig: rig.board)
def test_with_lost_frames_it_arrives_all_the_same(rig):
    board = rig.fresh_board()
    updater = Updater(LossyLink(board, 0.02, seed=1), 1, KEY)
    updater.enter()
    updater.unlock()
    updater.install(rig.images(NEW)[1], lambda _count: None)

    data = rig.images(NEW)[1].data
    assert bytes(board.hardware.flash.memory[rig.layout.slots[1] :][: len(data)]) == data
    updater.restart()
    assert updater.running() == (NEW, True)


def test_one_image_serves_a_robot_of_another_number(rig):
    board = rig.fresh_board()
    tester = Updater(board, 1, KEY)
    tester.enter()
    tester.unlock()
    tester.set_node(7)
    tester.restart()

    assert Updater(board, 7, KEY).running() == (OLD, False)
    robot = Talk(board, protocol=Protocol(7))
    robot.wait(1.5)
    assert robot.last("HEARTBEAT")


@pytest.mark.parametrize("slot", [0, 1], ids=["image", "boot loader"])
def test_robot_and_boot_loader_join_a_bus_of_the_bit_rate_that_was_set(rig, slot):
    board = rig.fresh_board()
    tester = Updater(board, 1, KEY)
    tester.enter()
    tester.unlock()
    tester.set_bitrate(250_000)
    if slot:
        board.hardware.flash.memory[rig.layout.slots[0] + 300] ^= 1
    tester.restart()

    with pytest.raises(BoardError, match="set up for 250000 bit/s, on a bus of 500000"):
        board.pass_time(0.2)
    assert (rig.runs_in(board) is None) == bool(slot)


@pytest.mark.parametrize("rig", [BLUE_PILL], ids=lambda rig: rig.board)
def test_two_boards_of_one_number_are_told_apart_before_anything_is_changed(rig):
    boards = [rig.fresh_board(), rig.fresh_board()]
    before = [written(board) for board in boards]
    tester = Updater(Crowd(boards), 1, KEY)

    with pytest.raises(UpdateError, match="2 boards answer as node 1"):
        tester.enter()
    assert [written(board) for board in boards] == before


@pytest.mark.parametrize("rig", [BLUE_PILL], ids=lambda rig: rig.board)
def test_a_node_that_is_not_there_is_named(rig):
    with pytest.raises(UpdateError, match="node 9 does not answer"):
        Updater(rig.fresh_board(), 9, KEY).enter()


@pytest.mark.parametrize("rig", [BLUE_PILL], ids=lambda rig: rig.board)
def test_four_robots_are_updated_at_once_though_a_tenth_of_the_frames_is_lost(rig):
    boards = {node: rig.fresh_board() for node in (1, 2, 3, 4)}
    for node, board in boards.items():
        number(board, node)
    hub = Hub(LossyLink(Crowd(boards.values()), 0.1, seed=1))

    failed = hub.run({node: partial(update, Updater(hub.share(node), node, KEY)) for node in boards})

    assert failed == dict.fromkeys(boards)
    assert {
        bytes(board.hardware.flash.memory[rig.layout.slots[1] :]).startswith(rig.images(NEW)[1].data)
        for board in boards.values()
    } == {True}
    assert [rig.runs_in(board) for board in boards.values()] == [1, 1, 1, 1]
