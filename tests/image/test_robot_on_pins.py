"""A robot of its own on the pins of an emulated board: it drives, and what is wired wrong shows.

Told against driven speed on the emulated bridge, with motors of any inductance, in both directions.
"""

import json
from dataclasses import replace
from itertools import pairwise

import pytest

from host_sim.base.errors import RobotError, UsageError
from host_sim.emulator.pins_board import PinsBoard, start_robot
from host_sim.emulator.robot_on_pins import Winding
from host_sim.live.feed import PageFeed
from host_sim.live.paced_run import PacedRun
from host_sim.protocol.codec import COUNTERS, Frame, Protocol
from host_sim.protocol.generated import TICK_SPAN, Reason
from host_sim.recording.run_recorder import RunRecorder
from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig
from host_sim.sim.simulation import Simulation
from tests.image.two_boards import TwoBoards, kit_arena
from tests.runs.support import octet_process

PINS = RunConfig(seed=2, environments=1, robot="emulated", board="blue_pill", body="pins", limit_s=20)
TICKS = 250
BOARDS = ["blue_pill", "nucleo_g431rb"]


def board_of(simulation: Simulation) -> PinsBoard:
    link = simulation.clients[0].connection.link
    assert isinstance(link, PinsBoard)
    return link


def go(simulation: Simulation, ticks: int) -> None:
    for _ in range(ticks):
        simulation.step()


def bridge_is_awake(simulation: Simulation) -> bool:
    robot = board_of(simulation).robot
    port, pin = robot.wiring.port("BRIDGE_AWAKE")
    return port.drives(pin)


def press(board: PinsBoard, then_s: float) -> None:
    board.robot.set_button(True)
    board.pass_time(0.3)
    board.robot.set_button(False)
    board.pass_time(then_s)


def counts(simulation: Simulation) -> list[int]:
    """Counts of both encoders."""
    robot = board_of(simulation).robot
    return [robot.timers[name].registers[0x24].value for name in ("TIM3", "TIM4")]


@pytest.mark.parametrize("board", BOARDS)
def test_log_on_pins_replays_and_is_reproducible(board, tmp_path):
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
def test_robot_on_pins_drives_without_collisions(board):
    with make(replace(PINS, board=board)) as simulation:
        simulation.enter(1)
        start = simulation.arena.bodies[0].pose
        go(simulation, TICKS)
        body = simulation.arena.bodies[0]
        assert abs(body.pose.x_mm - start.x_mm) + abs(body.pose.y_mm - start.y_mm) > 100
        assert body.collisions == 0
        assert board_of(simulation).resets == []


@pytest.mark.parametrize("channel", ["A", "B"])
def test_encoder_on_a_wrong_pin_does_not_count(channel):
    with make(PINS) as simulation:
        board_of(simulation).robot.wiring.rewire(f"LEFT_ENCODER_{channel}", "PB4")
        simulation.enter(1)
        before = counts(simulation)
        go(simulation, 50)
        after = counts(simulation)
        assert (after[0] == before[0], after[1] == before[1]) == (True, False)


def test_can_on_a_wrong_pin_gets_no_answer():
    board = start_robot("blue_pill")
    command = Protocol(1).encode("COMMAND", {"counter": 1, "opcode": 9, "owner": 1})
    board.pass_time(0.1)
    board.robot.wiring.rewire("CAN_RX", "PA11")
    board.send(command)
    assert board.pass_time(0.1) == []
    board.robot.wiring.rewire("CAN_RX", "PB8")
    board.send(command)
    assert Frame in {type(frame) for frame in board.pass_time(0.1)}


@pytest.mark.parametrize("name", BOARDS)
def test_disconnected_sensor_detects_no_wall(name):
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


def test_ambient_light_is_not_detected_as_a_wall():
    board = start_robot("blue_pill")
    board.robot.ambient = 3500
    assert feel_of(board) == 0
    board.robot.ambient, board.robot.light = 300, [1300] * 5
    assert feel_of(board) == 0b11111


def test_reversed_encoder_stops_the_robot_within_a_second():
    with make(PINS) as simulation:
        board_of(simulation).robot.counts_by[0] = -1
        simulation.enter(1)
        go(simulation, 50)
        assert not bridge_is_awake(simulation)


@pytest.mark.parametrize("name", BOARDS)
def test_bridge_fault_stops_the_pwm_in_hardware(name):
    with make(replace(PINS, board=name)) as simulation:
        simulation.enter(1)
        go(simulation, 20)
        board = board_of(simulation)
        assert board.robot.motors.duty("ch2n") > 0
        board.robot.set_bridge_fault(True)
        assert board.robot.motors.duty("ch2n") == board.robot.motors.duty("ch1") == 0
        simulation.step()
        assert not bridge_is_awake(simulation)


@pytest.mark.parametrize(
    ("name", "lasts_s", "drives"),
    [
        ("nucleo_g431rb", 3e-6, True),
        ("nucleo_g431rb", 4e-6, False),
        ("blue_pill", 1e-7, False),
    ],
)
def test_short_fault_spike_is_filtered_if_the_chip_can(name, lasts_s, drives):
    with make(replace(PINS, board=name)) as simulation:
        simulation.enter(1)
        board_of(simulation).robot.set_bridge_fault(True, lasts_s)
        simulation.step()
        assert bridge_is_awake(simulation) == drives


@pytest.mark.parametrize("name", BOARDS)
def test_button_starts_and_stops_the_robot_without_a_pc(name):
    board = start_robot(name)
    press(board, then_s=1.5)
    assert board.robot.wiring.meets("LEFT_PWM")
    assert board.robot.figures()["duty"][0] != 0
    press(board, then_s=0.5)
    assert board.robot.figures()["duty"][0] == 0


@pytest.mark.parametrize("name", BOARDS)
def test_pwm_is_updated_without_jitter(name):
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
        go(simulation, 50)
    spans = [b - a for a, b in pairwise(moments)]
    assert len(spans) > 190
    assert max(abs(span - 0.005) for span in spans) < 1e-6


def test_page_feed_contains_the_pins():
    with make(PINS) as simulation:
        live = PacedRun(simulation, RunRecorder.of(simulation, boredom_limit=10), lambda _: None)
        live.begin()
        feed, robot = PageFeed(live), board_of(simulation).robot
        go(simulation, 25)
        (pins,) = json.loads(feed.next() or "")["pins"]
        assert pins["counts"] == [robot.library.kit_count(robot.kit, side) for side in range(2)] != [0, 0]
        assert all(0 < abs(duty) <= 100 for duty in pins["duty"])
        assert pins["volts"] == round(robot.volts, 2)


def test_pins_on_unsupported_boards_and_robots_are_refused():
    why = "there is no image with a body on pins for feather_stm32f405: use --board blue_pill, nucleo_g431rb or pico"
    with pytest.raises(UsageError, match=why):
        start_robot("feather_stm32f405")
    with pytest.raises(UsageError, match="use --robot emulated --board blue_pill"):
        RunConfig(body="pins")


def test_silent_robot_on_pins_times_out():
    with make(PINS) as simulation:
        simulation.enter(1)
        board = board_of(simulation)
        board.robot.wiring.rewire("CAN_TX", "PA12")
        simulation.clients[0].connection.__dict__["deadline_s"] = 0.3
        with pytest.raises(RobotError):
            simulation.step()


INDUCTANCES_MH = (0.3, 1.0, 2.0)
SETTLING_TICKS, DRIVE_TICKS, TICK_S = 40, 50, 0.02
COUNT_MM = 0.0916
_PROTOCOL = Protocol()


def driven_mm_s(board: str, told_mm_s: int, inductance_mh: float) -> float:
    """The speed that the left wheel of a body on a board reaches, by its encoder, when both are told this one."""
    boards = TwoBoards(body=board)
    boards.cut = True
    boards.robot.winding = Winding(henry=inductance_mh / 1000)
    arena = kit_arena()
    boards.robot.join(arena.body.kit)
    kit, begin = arena.body.kit, 0
    for tick in range(SETTLING_TICKS + DRIVE_TICKS):
        if tick == SETTLING_TICKS:
            begin = kit.wheels[0].place
        _tell(boards, told_mm_s)
    way = (kit.wheels[0].place - begin + 2**63) % 2**64 - 2**63
    return float(way / 65536 * COUNT_MM / (DRIVE_TICKS * TICK_S))


def _tell(boards: TwoBoards, speed_mm_s: int) -> None:
    """A tick, in which the body gets a drive for the senses that it sent last."""
    boards.pass_time(TICK_S)
    said = [_PROTOCOL.decode(frame) for _, frame in boards.heard[-8:]]
    senses = [it.signals for it in said if it is not None and it.name == "SENSES"][-1]
    stamp = {"tick": senses["tick"] % TICK_SPAN, "counter": senses["counter"] % COUNTERS}
    drive = {
        "left": speed_mm_s,
        "right": speed_mm_s,
        "reason": Reason.WANDER,
        "repeat_count": 0,
        "eat": 0,
        "action": 1,
    }
    boards.body.send(_PROTOCOL.encode("DRIVE", drive | stamp))


@pytest.mark.parametrize("board", ["blue_pill", "nucleo_g431rb"])
@pytest.mark.parametrize("way", [1, -1], ids=["forward", "backward"])
@pytest.mark.parametrize("speed_mm_s", [60, 200])
@pytest.mark.parametrize("inductance_mh", INDUCTANCES_MH)
def test_wheels_reach_the_commanded_speed(inductance_mh, speed_mm_s, way, board):
    driven = driven_mm_s(board, way * speed_mm_s, inductance_mh)

    assert driven == pytest.approx(way * speed_mm_s, rel=0.05)
