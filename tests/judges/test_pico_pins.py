"""A robot of its own on the pins of a Raspberry Pi Pico in rp2040js, a third-party emulator.

Its edges of PWM are those at the pins; its encoders turn at the pins, and PIO counts them; its ADC reads samples.
"""

import math
from collections.abc import Callable, Iterator
from contextlib import ExitStack, closing
from pathlib import Path
from statistics import mean

import pytest

from host_sim.protocol.codec import Protocol
from host_sim.protocol.generated import ODOMETER_SPAN, Opcode, Reason
from host_sim.sim.make import make
from host_sim.sim.pico_pins import PicoOnPins
from host_sim.sim.run_config import RunConfig
from host_sim.sim.simulation import Simulation
from tests.judges.labwired_board import flash_of
from tests.judges.test_pico import FULL
from tests.judges.test_starts import page
from tests.judges.test_starts import store_record as stored

ROOM = page(1) + stored(1, bytes((0, 2, *[0] * 6)))
PINS = RunConfig(seed=2, environments=1, robot="emulated", board="pico", body="pins", limit_s=20)
WORST_TICK_US, PAGE_US = 250, 400
NEAR = 1200
Start = Callable[..., PicoOnPins]


@pytest.fixture
def start(tmp_path: Path) -> Iterator[Start]:
    """Starts boards, which end with the test."""
    path = tmp_path / "flash.bin"
    with ExitStack() as stack:

        def started(store: bytes = b"", *options: str) -> PicoOnPins:
            path.write_bytes(flash_of(store, "pins"))
            return stack.enter_context(closing(PicoOnPins(path, *options)))

        yield started


def board_of(simulation: Simulation) -> PicoOnPins:
    link = simulation.clients[0].connection.link
    assert isinstance(link, PicoOnPins)
    return link


def press(board: PicoOnPins) -> None:
    """Presses the button, and lets go."""
    for pressed in (True, False):
        board.robot.set_button(pressed)
        board.pass_time(0.2)


def duties(board: PicoOnPins) -> list[int]:
    """The duty of its motors, %."""
    return list(board.robot.figures()["duty"])


def test_pico_drives_the_path_of_a_simulated_kit():
    """Compares the first 2 s: later, the sensors' noise differs."""
    ways = []
    for config in (PINS, RunConfig(seed=2, environments=1, body="kit")):
        with make(config) as simulation:
            simulation.enter(1)
            for _ in range(100):
                simulation.step()
            ways.append((simulation.arena.bodies[0].pose, simulation.arena.bodies[0].collisions))
    (pico, hits), (kit, _) = ways
    assert hits == 0
    assert abs(pico.x_mm - kit.x_mm) + abs(pico.y_mm - kit.y_mm) < 10


def actions_of(config: RunConfig, ticks: int) -> dict[int, list[tuple[int, float]]]:
    """For each reason, how many ticks each action took, and how far it turned in degrees."""
    found: dict[int, list[tuple[int, float]]] = {}
    with make(config) as simulation:
        simulation.enter(1)
        begun, last, heading = 0, None, simulation.arena.bodies[0].pose.heading_rad
        for tick in range(ticks):
            simulation.step()
            (drive,) = simulation.drives
            if last is not None and drive.action != last.action:
                now = simulation.arena.bodies[0].pose.heading_rad
                turned = math.degrees(math.remainder(now - heading, math.tau))
                found.setdefault(last.reason, []).append((tick - begun, abs(turned)))
                begun, heading = tick, now
            last = drive
    return found


def test_pico_actions_match_a_simulated_kit_in_time_and_angle():
    """Whole runs then differ only by chance: the sensors' noise differs, and the paths diverge."""
    pico, kit = (actions_of(config, 1500) for config in (PINS, RunConfig(seed=2, environments=1, body="kit")))
    for reason, most in ((Reason.WANDER, 0.05), (Reason.LOOK_AROUND, 0.1)):
        ticks = [mean(ticks for ticks, _ in actions[reason]) for actions in (pico, kit)]
        assert ticks[0] == pytest.approx(ticks[1], rel=most)
    for actions in (pico, kit):
        assert mean(turned for _, turned in actions[Reason.REMEMBERED]) == pytest.approx(10, abs=1)


def test_sensor_triggers_at_60_mm_and_releases_at_a_tenth_less_light():
    with make(PINS) as simulation:
        simulation.enter(1)
        parts, felt, changes = board_of(simulation).robot, 0, 0
        for _ in range(600):
            simulation.step()
            near = [NEAR - NEAR // 10 * (felt >> i & 1) for i in range(len(parts.light))]
            expected = sum((parts.light[i] >= near[i]) << i for i in (1, 2, 3))
            changes += expected != felt
            felt = simulation.senses[0].feel
            assert felt == expected
    assert changes > 5


def test_longest_tick_takes_less_than_250_us_plus_a_page_write():
    with make(PINS) as simulation:
        simulation.enter(1)
        board = board_of(simulation)
        board.pico.order("longest")
        for _ in range(250):
            simulation.step()
        (longest,) = board.pico.order("longest")
    assert float(longest) < WORST_TICK_US + PAGE_US


@pytest.mark.parametrize("store", [b"", ROOM, FULL], ids=["blank", "roomy", "full"])
def test_pico_starts_from_any_store_and_rests_until_the_button_is_pressed(start, store):
    board = start(store)
    board.pass_time(0.5)
    assert duties(board) == [0, 0]
    assert board.robot.shares[2:6] == [1.0] * 4  # both motors brake

    press(board)
    board.pass_time(1.5)

    assert 0 not in duties(board)


def test_button_stops_the_running_pico(start):
    board = start()
    press(board)
    board.pass_time(1.5)
    press(board)
    assert duties(board) == [0, 0]


@pytest.mark.parametrize(
    "trouble",
    [
        lambda parts: parts.set_bridge_fault(True),
        lambda parts: parts.set_bridge_fault(True, 1e-7),
        lambda parts: setattr(parts, "battery_v", 5.4),
    ],
    ids=["fault", "spike", "flat battery"],
)
def test_bridge_fault_or_flat_battery_puts_the_bridge_to_sleep(start, trouble):
    board = start()
    press(board)
    board.pass_time(1.5)
    trouble(board.robot)
    board.pass_time(0.3)
    assert board.robot.shares[10] == 0.0
    assert board.robot.shares[2:6] == [1.0] * 4


def test_disconnected_battery_counts_as_flat(start):
    board = start()
    board.robot.battery_v = 0.0
    press(board)
    board.pass_time(1.5)
    assert duties(board) == [0, 0]


@pytest.mark.parametrize("side", [0, 1])
def test_reversed_encoder_stops_the_robot_within_a_second(side):
    with make(PINS) as simulation:
        board = board_of(simulation)
        board.robot.counts_by[side] = -1
        simulation.enter(1)
        for _ in range(50):
            simulation.step()
        assert board.robot.shares[10] == 0.0


def test_pio_counts_each_edge_of_both_encoders(start):
    """The program's counts are in its registers Y, the firmware's in its odometers."""
    board, protocol = start(), Protocol()
    for more in (40, -25, 1000):
        board.robot._turn(0, more)
        board.robot._turn(1, -more)
        board.pass_time(0.02)
    assert [int(y) for y in board.pico.order("count 0", "count 1")] == [1015, -1015]
    board.send(protocol.encode("COMMAND", {"counter": 1, "opcode": Opcode.STOP, "owner": 1}))
    board.pass_time(0.1)
    sensed = board._sensed
    assert sensed is not None
    decoded = protocol.decode(sensed)
    assert decoded is not None
    left, right = decoded.signals["odometer_left"], decoded.signals["odometer_right"]
    assert left > 0
    assert (left + right) % ODOMETER_SPAN in (0, ODOMETER_SPAN - 1)  # each rounds down


def feel_of(board: PicoOnPins) -> int:
    """The proximity pattern that it reports at rest."""
    board.pass_time(0.06)
    sensed = board._sensed
    assert sensed is not None
    decoded = Protocol().decode(sensed)
    assert decoded is not None
    return decoded.signals["feel"]


def test_pico_has_three_sensors_and_ignores_room_light(start):
    board = start()
    board.robot.ambient = 2500
    assert feel_of(board) == 0
    board.robot.ambient, board.robot.light = 300, [1500] * 5
    assert feel_of(board) == 0b01110


def test_commands_reach_the_pico_at_line_speed(start):
    board, protocol = start(b"", "paced"), Protocol()
    board.pass_time(1.0)
    for counter in (1, 2):
        board.send(protocol.encode("COMMAND", {"counter": counter, "opcode": Opcode.STOP, "owner": 1}))
    said = [protocol.decode(frame) for frame in board.pass_time(0.2)]
    assert [it.signals["counter"] for it in said if it is not None and it.name == "ANSWER"] == [1, 2]


def test_hung_core_is_reset_and_the_wheels_stop(start):
    board = start()
    press(board)
    board.pass_time(1.5)
    board.pico.order("hang")
    board.pass_time(2.5)
    assert duties(board) == [0, 0]
