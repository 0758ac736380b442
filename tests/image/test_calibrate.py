"""A robot of its own on an emulated Blue Pill measures itself: near the truth, or refused with a reason."""

import sys
from dataclasses import replace
from types import SimpleNamespace

import pytest

from host_sim.base.errors import UsageError
from host_sim.cli.main import main
from host_sim.client.commands import handshake
from host_sim.client.connection import Connection
from host_sim.client.frame_log import NoLog
from host_sim.client.robot_client import RobotClient
from host_sim.emulator.pins_board import start_robot
from host_sim.lab.calibrate import calibrate_command
from host_sim.lab.calibrate.calibration import CALIBRATION_VALUES, STEPS, Calibration, Places
from host_sim.protocol.codec import Protocol
from host_sim.protocol.generated import Side
from host_sim.protocol.words import BODY_PARAMETERS
from host_sim.sim.access import BOARDS
from tests.image.calibrate_cuts import STORES, WRITE_MAX, Robot, a_calibration, cut_again, outcomes

SAMPLE = 60
"""After one of so many cuts, the power is cut again at each write."""

ODD = """\
base = "kit"
front_mm = 52
left_mm = 68
track = 1.03
left_motor = 0.85
right_motor = 1.15
motor_ms = 80
battery_v = 8.0
"""


class Rig:
    """A robot of its own in a body whose every trait is off, and what talks to it."""

    def __init__(self, tmp_path):
        (tmp_path / "odd.toml").write_text(ODD)
        self.board = start_robot("blue_pill")
        self.places = Places(self.board, str(tmp_path / "odd.toml"), seed=1)
        self.log = NoLog()
        client = RobotClient(Connection(self.board, now=self.board.now), Protocol(), self.log)
        handshake(client, 5.0)
        self.calibration = Calibration(client, self.places.wait)

    def measure(self, step):
        self.places.put(step)
        return self.calibration.measure(step)


@pytest.fixture
def rig(tmp_path):
    made = Rig(tmp_path)
    yield made
    made.log.close()


def test_calibration_is_accurate_and_survives_a_power_cut(rig):
    assert [rig.measure(step) for step in STEPS] == ["", "", ""]
    found, true = rig.calibration.stored_values(), rig.places.true_values()
    for name, row in CALIBRATION_VALUES.items():
        assert abs(found[name] - true[name]) <= max(abs(row.default - true[name]) / 4, 1.0), name
    assert sum(abs(row.default - true[name]) > 2 for name, row in CALIBRATION_VALUES.items()) >= 5
    rig.board.cut_power()
    rig.board.pass_time(0.1)
    assert rig.calibration.stored_values() == found


def test_disconnected_sensor_is_refused_and_old_values_stay(rig):
    rig.board.robot.wiring.rewire("PROXIMITY_FRONT")
    assert rig.measure("light") == "body_near_front cannot be 0 1/256: it is 20 to 250"
    assert set(rig.calibration.stored_values().items()) == {
        (name, row.default) for name, row in CALIBRATION_VALUES.items()
    }


def test_motor_without_its_encoder_is_refused(rig):
    rig.board.robot.wiring.rewire("RIGHT_ENCODER_A")
    assert rig.measure("motors").startswith("body_forward_right cannot be 0 ")


def test_motor_that_turns_only_forward_is_refused(rig, monkeypatch):
    robot = rig.board.robot
    push = robot._push
    monkeypatch.setattr(robot, "_push", lambda side: max(push(side), 0) if side else push(side))
    assert rig.measure("motors").startswith("body_forward_right cannot be 0 ")


def test_bump_interrupts_a_calibration(rig):
    rig.places.put("motors")
    rig.calibration.set("body_measure", 1 + STEPS.index("motors"))
    rig.places.wait(0.5)
    rig.board.robot.set_bumped(True)
    rig.places.wait(0.1)
    assert rig.calibration.get("body_measure") == 0
    assert rig.calibration.get("body_refused") == BODY_PARAMETERS["body_measure"].number


def test_button_held_at_power_up_measures_light(rig):
    rig.board.robot.set_button(True)
    rig.board.cut_power()
    rig.places.put("light")
    rig.places.wait(0.5)
    rig.board.robot.set_button(False)
    rig.places.wait(2.5)
    assert rig.calibration.get("body_near_front") == round(rig.places.true_values()["body_near_front"])


@pytest.fixture(scope="module", params=BOARDS)
def life(request):
    return a_calibration(request.param)


def test_power_cut_at_any_write_leaves_old_or_new_values(life):
    cuts = range(len(life.recording.changes))
    found, again = outcomes(life, cuts), cut_again(life, cuts[::SAMPLE])

    erases = sum(len(whole) > WRITE_MAX for _, whole, _ in life.recording.changes)
    assert erases == len(Robot(life.recording.board).storing(Side.LEFT))
    assert (found["neither"], again["neither"]) == (0, 0)
    assert found.total() == len(cuts) > erases
    assert again.total() > len(cuts[::SAMPLE])


def test_outcomes_detect_a_cut_that_loses_data(life):
    begin, end = STORES[life.recording.board]
    before = life.recording.before
    harmed = replace(life.recording, before=before[:begin] + bytes(end - begin) + before[end:])

    assert outcomes(replace(life, recording=harmed), [0]) == {"old": 0, "new": 0, "neither": 1}


def test_command_prints_measured_beside_true_values(capsys):
    assert main(["calibrate", "--robot", "emulated", "--seed", "3"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[: len(STEPS)] == [f"{step}: measured and stored" for step in STEPS]
    assert lines[len(STEPS)].split() == ["before", "now", "true", "unit"]
    rows = lines[len(STEPS) + 1 :]
    values = {name: (float(now), float(true)) for name, _, now, true, *_ in map(str.split, rows)}
    assert values.keys() == CALIBRATION_VALUES.keys()
    for now, true in values.values():
        assert now == pytest.approx(true, rel=0.05)


@pytest.mark.parametrize(
    ("words", "why"),
    [
        ([], "calibrate needs a robot"),
        (["dance", "--robot", "emulated"], "there is no 'dance' to calibrate: choose from light, motors, track"),
        (
            ["--robot", "emulated", "--set", "body_track_mm=260"],
            "must be a whole number from 90 to 250 mm, not '260'",
        ),
        (["--robot", "emulated", "--set", "body_measure=1"], "there is no 'body_measure' to set"),
        (["light", "--robot", "emulated", "--show"], "give steps to measure, or --show or --set"),
        (["--robot", "emulated", "--body", "ideal"], "a body to calibrate has motors"),
    ],
)
def test_impossible_calibration_is_refused_in_one_line(words, why, capsys):
    assert main(["calibrate", *words]) == 2
    said = capsys.readouterr().err
    assert why in said
    assert said.count("\n") == 1


def test_end_of_input_before_a_step_is_reported(monkeypatch):
    def ends(_text: str) -> str:
        raise EOFError

    monkeypatch.setattr("builtins.input", ends)
    monkeypatch.setattr(sys, "stdin", SimpleNamespace(isatty=lambda: True))

    with pytest.raises(UsageError, match="motors and what follows it were not measured"):
        calibrate_command._measures(None, None, "motors", ask=True)
