"""`tools/octet update`: what it says, of one robot and of several; it ends with 2 where a robot does not take it."""

import pytest

from host_sim.cli.main import main
from host_sim.transport import buses
from tests.image.update_rig import BLUE_PILL, NEW, OLD, Crowd


@pytest.fixture
def on_the_bus(monkeypatch):
    """Puts boards on the bus that the command opens."""
    return lambda *boards: monkeypatch.setattr(buses, "open_bus_link", lambda *_: Crowd(boards))


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("blue_pill", "nowhere to put the image: give --bus BUS"),
        ("--bus virtual:x", "IMAGE is missing: give a file from --save, or a board"),
        ("--bus virtual:x --node 1-2 --set-node 3", "--set-node is for one robot"),
        ("nowhere.octet --bus virtual:x", "cannot read nowhere.octet"),
        ("blue_pill --key nowhere.pem --bus virtual:x", "cannot read the key nowhere.pem"),
        ("blue_pill --bus carrier:pigeon", "cannot open the bus carrier:pigeon"),
    ],
)
def test_what_is_typed_wrong_is_said_in_one_line(words, said, capfd):
    assert main(["update", *words.split()]) == 2
    assert said in capfd.readouterr().err


def test_it_says_what_it_will_do_and_reads_back_what_runs(on_the_bus, capfd):
    board = BLUE_PILL.fresh_board()
    on_the_bus(board)

    assert main(["update", "blue_pill", "--bus", "any:bus", "--version", str(NEW)]) == 0
    said = capfd.readouterr()
    assert said.out.splitlines() == [
        f"node 1: version {OLD} stays in slot A; version {NEW} goes to slot B",
        f"node 1: version {NEW} runs",
    ]
    assert "anybody can update it" in said.err
    assert BLUE_PILL.runs_in(board) == 1


def test_a_robot_that_is_not_there_keeps_no_other_from_its_update(on_the_bus, capfd):
    board = BLUE_PILL.fresh_board()
    on_the_bus(board)

    assert main(["update", "blue_pill", "--bus", "any:bus", "--node", "1-2", "--version", str(NEW)]) == 2
    said = capfd.readouterr()
    assert "octet: node 2 does not answer: it is off the bus, or has no boot loader\n" in said.err
    assert f"node 1: version {NEW} runs" in said.out


def test_number_and_bit_rate_are_set_without_an_image(on_the_bus, capfd):
    board = BLUE_PILL.fresh_board()
    on_the_bus(board)

    assert main(["update", "--bus", "any:bus", "--set-node", "7"]) == 0
    assert "node 1: has number 7 from now on" in capfd.readouterr().out
    assert main(["update", "blue_pill", "--bus", "any:bus", "--node", "7", "--version", str(NEW)]) == 0
    assert BLUE_PILL.runs_in(board) == 1


def test_a_bus_that_takes_no_frames_is_said_to_be_full(monkeypatch, capfd):
    class Full:
        def __init__(self, stats):
            self._stats = stats

        def send(self, _frame):
            self._stats.unsent += 1

        def receive(self, _timeout_s):
            return None

        def close(self):
            pass

    monkeypatch.setattr(buses, "open_bus_link", lambda _bus, _ids, stats, _bitrate: Full(stats))

    assert main(["update", "blue_pill", "--bus", "any:bus"]) == 2
    assert "the bus takes no frames: it is full, or nobody else is on it" in capfd.readouterr().err
