"""A robot of its own on the pins of an emulated board: it drives, and what is wired wrong shows."""

import json
from dataclasses import replace
from itertools import pairwise

import pytest

from host_sim.base.errors import RobotError, UsageError
from host_sim.emulator.pins_board import PinsBoard, start_robot
from host_sim.live.feed import PageFeed
from host_sim.live.paced_run import PacedRun
from host_sim.protocol.codec import Frame, Protocol
from host_sim.recording.run_recorder import RunRecorder
from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig
from host_sim.sim.simulation import Simulation
from tests.runs.support import octet_process

PINS = RunConfig(seed=2, environments=1, robot="emulated", board="blue_pill", body="pins", limit_s=20)
TICKS = 250
BOARDS = ["blue_pill", "nucleo_g431rb"]


def board_of(simulation: Simulation) -> PinsBoard:
    link = simulation.clients[0].connection.link
    assert isinstance(link, PinsBoard)
    return link


def counts(simulation: Simulation) -> list[int]:
    """Counts of both encoders."""
    robot = board_of(simulation).robot
    return [robot.timers[name].registers[0x24].value for name in ("TIM3", "TIM4")]


@pytest.mark.parametrize("board", BOARDS)
def test_its_log_is_that_of_the_firmware_and_comes_again(board, tmp_path):
    logs = []
    for name in "ab":
        words = replace(PINS, board=board).command().split()[1:]
        out = tmp_path / name
        octet_process("run", *words, "--out", out).check_returncode()
        logs.append((out / "run.log").read_bytes())
    done = octet_process("replay", out / "run.log")
    assert (done.returncode, "no difference" in done.stdout) == (0, True)
    assert logs[0] == logs[1]


@pytest.mark.parametrize("board", BOARDS)
def test_it_drives_and_touches_nothing(board):
    with make(replace(PINS, board=board)) as simulation:
        simulation.enter(1)
        start = simulation.arena.bodies[0].pose
        for _ in range(TICKS):
            simulation.step()
        body = simulation.arena.bodies[0]
        assert abs(body.pose.x_mm - start.x_mm) + abs(body.pose.y_mm - start.y_mm) > 100
        assert body.collisions == 0
        assert board_of(simulation).resets == []


@pytest.mark.parametrize("channel", ["A", "B"])
def test_an_encoder_on_a_wrong_pin_counts_nothing(channel):
    with make(PINS) as simulation:
        board_of(simulation).robot.wiring.rewire(f"LEFT_ENCODER_{channel}", "PB4")
        simulation.enter(1)
        before = counts(simulation)
        for _ in range(50):
            simulation.step()
        after = counts(simulation)
        assert (after[0] == before[0], after[1] == before[1]) == (True, False)


def test_can_on_a_wrong_pin_is_heard_by_nobody():
    board = start_robot("blue_pill")
    board.pass_time(0.1)
    board.robot.wiring.rewire("CAN_RX", "PA11")
    board.send(Protocol(1).encode("COMMAND", {"counter": 1, "opcode": 9, "owner": 1}))
    assert board.pass_time(0.1) == []
    board.robot.wiring.rewire("CAN_RX", "PB8")
    board.send(Protocol(1).encode("COMMAND", {"counter": 1, "opcode": 9, "owner": 1}))
    assert Frame in {type(frame) for frame in board.pass_time(0.1)}


@pytest.mark.parametrize("name", BOARDS)
def test_a_sensor_whose_wire_is_broken_sees_nothing(name):
    board = start_robot(name)
    board.robot.light = [4000] * 5
    board.robot.wiring.rewire("PROXIMITY_FRONT")
    assert feel_of(board) == 0b11011


def feel_of(board: PinsBoard) -> int:
    """What it says that it feels, resting."""
    board.pass_time(0.06)
    sensed = board._sensed
    assert sensed is not None
    decoded = Protocol(1).decode(sensed)
    assert decoded is not None
    return decoded.signals["feel"]


def test_light_of_the_room_is_not_a_wall():
    board = start_robot("blue_pill")
    board.robot.ambient = 3500
    assert feel_of(board) == 0
    board.robot.ambient, board.robot.light = 300, [1300] * 5
    assert feel_of(board) == 0b11111


def test_an_encoder_that_counts_against_its_motor_stops_the_robot_within_a_second():
    with make(PINS) as simulation:
        board = board_of(simulation)
        board.robot.counts_by[0] = -1
        simulation.enter(1)
        for _ in range(50):
            simulation.step()
        port, pin = board.robot.wiring.port("BRIDGE_AWAKE")
        assert not port.drives(pin)


@pytest.mark.parametrize("name", BOARDS)
def test_a_fault_of_the_bridge_stops_the_pwm_without_the_image(name):
    with make(replace(PINS, board=name)) as simulation:
        simulation.enter(1)
        for _ in range(20):
            simulation.step()
        board = board_of(simulation)
        assert board.robot.motors.duty("ch2n") > 0
        board.robot.set_bridge_fault(True)
        assert board.robot.motors.duty("ch2n") == board.robot.motors.duty("ch1") == 0
        simulation.step()
        port, pin = board.robot.wiring.port("BRIDGE_AWAKE")
        assert not port.drives(pin)


@pytest.mark.parametrize(
    ("name", "lasts_s", "drives"),
    [
        ("nucleo_g431rb", 3e-6, True),
        ("nucleo_g431rb", 4e-6, False),
        ("blue_pill", 1e-7, False),
    ],
)
def test_a_spike_on_the_fault_signal_ends_no_run_where_the_chip_can_filter_it(name, lasts_s, drives):
    with make(replace(PINS, board=name)) as simulation:
        simulation.enter(1)
        board = board_of(simulation)
        board.robot.set_bridge_fault(True, lasts_s)
        simulation.step()
        port, pin = board.robot.wiring.port("BRIDGE_AWAKE")
        assert port.drives(pin) == drives


@pytest.mark.parametrize("name", BOARDS)
def test_the_button_starts_and_stops_it_without_a_pc(name):
    board = start_robot(name)
    board.robot.set_button(True)
    board.pass_time(0.3)
    board.robot.set_button(False)
    board.pass_time(1.5)
    assert board.robot.wiring.meets("LEFT_PWM")
    assert board.robot.figures()["duty"][0] != 0
    board.robot.set_button(True)
    board.pass_time(0.3)
    board.robot.set_button(False)
    board.pass_time(0.5)
    assert board.robot.figures()["duty"][0] == 0


@pytest.mark.parametrize("name", BOARDS)
def test_its_beat_has_no_jitter(name):
    with make(replace(PINS, board=name)) as simulation:
        board = board_of(simulation)
        moments = []
        pwm = board.robot.motors.registers[0x38]
        board.hardware.space.watch()

        def note(value: int) -> None:
            moments.append(board.now())
            pwm.value = value

        pwm.on_write = note
        simulation.enter(1)
        for _ in range(50):
            simulation.step()
    spans = [b - a for a, b in pairwise(moments)]
    assert len(spans) > 190
    assert max(abs(span - 0.005) for span in spans) < 1e-6


def test_a_page_is_told_what_is_on_its_pins():
    with make(PINS) as simulation:
        live = PacedRun(simulation, RunRecorder.of(simulation, boredom_limit=10), lambda _: None)
        live.begin()
        feed, robot = PageFeed(live), board_of(simulation).robot
        for _ in range(25):
            simulation.step()
        (pins,) = json.loads(feed.next() or "")["pins"]
        assert pins["counts"] == [robot.library.kit_count(robot.kit, side) for side in range(2)] != [0, 0]
        assert all(0 < abs(duty) <= 100 for duty in pins["duty"])
        assert pins["volts"] == round(robot.volts, 2)


def test_other_boards_and_robots_are_refused():
    why = "there is no image with a body on pins for feather_stm32f405: use --board blue_pill, nucleo_g431rb or pico"
    with pytest.raises(UsageError, match=why):
        start_robot("feather_stm32f405")
    with pytest.raises(UsageError, match="use --robot emulated --board blue_pill"):
        RunConfig(body="pins")


def test_a_robot_that_says_nothing_is_lost_and_not_waited_for_for_ever():
    with make(PINS) as simulation:
        simulation.enter(1)
        board = board_of(simulation)
        board.robot.wiring.rewire("CAN_TX", "PA12")
        simulation.clients[0].connection.__dict__["deadline_s"] = 0.3
        with pytest.raises(RobotError):
            simulation.step()
