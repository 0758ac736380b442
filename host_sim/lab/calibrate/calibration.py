"""Calibrates a robot with a body on pins over the bus: starts measurements and reads their results."""

from collections.abc import Callable
from dataclasses import dataclass
from math import pi

from host_sim.base.errors import RefusedError, RobotError, UsageError
from host_sim.base.terminal import SOON_S, counted
from host_sim.client.robot_client import RobotClient
from host_sim.emulator.pins_board import PinsBoard
from host_sim.protocol.words import BODY_PARAMETERS, SENSORS
from host_sim.world.arena import Arena
from host_sim.world.body_kinds import body_kind
from host_sim.world.edits import Edit
from host_sim.world.geometry import Pose, SimParams
from host_sim.world.layouts import Layout

_TICK_S = 0.02
_WALL_MM, _BEHIND_MM = 60, 20
_ABREAST = Pose(400.0, 130.0, pi)
"""A pose beside one wall of an empty arena."""


class Places:
    """An emulated robot, placed as each step requires."""

    def __init__(self, board: PinsBoard, body: str, seed: int) -> None:
        """Gives the board a body.

        Args:
            board: A running board.
            body: Kind of the body.
            seed: Seed from which the body is drawn.

        Raises:
            UsageError: There is no such kind, or it has no motors.
        """
        kind = body_kind(body)
        if kind is None or kind.traits["motor_ms"][0] == 0:
            raise UsageError(f'a body to calibrate has motors: a file with base = "kit", or kit, not {body!r}')
        layout = Layout((), ((2000.0, 1500.0),), _ABREAST)
        self._board, self._step, self._tick = board, "", 0
        self._arena = Arena(layout, kind.reach(SimParams()), kind=kind)
        self._arena.begin(seed)
        self._body = self._arena.body
        board.robot.join(self._body.kit)
        self._library, self._light = board.robot.library, board.robot.ffi.new("uint16_t[5]")

    def put(self, step: str) -> None:
        """Places the robot in the ring of walls, in the air, or beside a wall."""
        if self._step == "motors":
            self._arena.edit(Edit("put", at=(_ABREAST.x_mm, _ABREAST.y_mm), heading=1000 * _ABREAST.heading_rad))
        if step == "motors":
            self._arena.edit(Edit("lift"))
        self._step = step

    def wait(self, span_s: float) -> None:
        """Lets a span of the board's time pass."""
        for _ in range(round(span_s / _TICK_S)):
            self._body.sense(self._tick)
            if self._step == "light":
                self._library.kit_light_from(self._body.kit, [_WALL_MM] * len(SENSORS), self._tick, self._light)
            else:
                self._body.measure_light(self._tick, self._light)
            self._board.robot.light = list(self._light)
            self._board.pass_time(_TICK_S)
            self._body.move(0.0, 0.0)
            self._tick += 1

    def true_values(self) -> dict[str, float]:
        """The values without measurement error, by name. Those of a nominal body are the defaults."""
        ffi, kit = self._board.robot.ffi, self._body.kit
        names = [ffi.string(row.name).decode() for row in self._library.KIT_TRAITS]
        trait = dict(zip(names, kit.trait, strict=True))
        planned = {name: float(row.default) for name, row in CALIBRATION_VALUES.items()}
        for sensor in (name.replace("-", "_") for name in SENSORS):
            reach_mm = trait[f"{sensor}_mm"] * trait["wall"]
            planned[f"body_near_{sensor}"] *= ((reach_mm + _BEHIND_MM) / (_WALL_MM + _BEHIND_MM)) ** 2
        wheels = (trait["left_wheel"] + trait["right_wheel"]) / 2 * (1 - trait["slip"] / 2)
        planned["body_track_mm"] *= trait["track"] / wheels
        planned["body_forward_left"] /= trait["left_motor"]
        planned["body_forward_right"] /= trait["right_motor"]
        return planned | {"body_lag_ms": trait["motor_ms"]}


STEPS = ("light", "motors", "track")
"""The measurements, numbered from 1 as in body_measure."""

CALIBRATION_VALUES = {
    name: row for name, row in BODY_PARAMETERS.items() if name not in ("body_measure", "body_refused")
}
"""The parameters that a body stores."""

_LONGEST_S = 60.0
_POLL_S = 0.3
_NAMES = {row.number: name for name, row in BODY_PARAMETERS.items()}


@dataclass(frozen=True)
class Calibration:
    """The calibration dialogue with a robot.

    Attributes:
        client: The client of the stopped robot.
        wait: Waits for a span of robot time, s.
    """

    client: RobotClient
    wait: Callable[[float], object]

    def get(self, name: str) -> int:
        """The value of a parameter of the body.

        Raises:
            UsageError: The robot has no body on pins.
            RobotError: The robot does not answer.
        """
        try:
            answer = self.client.dialogue.command("get", wanted=BODY_PARAMETERS[name].number)
        except RefusedError as error:
            raise UsageError(f"node {self.client.node} has no body that can be calibrated: {error}") from None
        return int(answer.signals["value"])

    def set(self, name: str, value: int) -> None:
        """Sets a parameter of the body, which stores it.

        Raises:
            RefusedError: The value is out of range, or cannot be stored.
            RobotError: The robot does not answer.
        """
        self.client.dialogue.command("set", parameter=BODY_PARAMETERS[name].number, value=value)

    def stored_values(self) -> dict[str, int]:
        """All stored values, by name."""
        return {name: self.get(name) for name in CALIBRATION_VALUES}

    def measure(self, step: str) -> str:
        """Runs a measurement.

        Returns:
            The reason for a failure, in a sentence; empty if the result was stored.

        Raises:
            RobotError: The robot does not answer, or the measurement does not end.
        """
        self.set("body_measure", 1 + STEPS.index(step))
        for _ in counted(range(round(_LONGEST_S / _POLL_S)), None, f"{step}: measuring", after_s=SOON_S):
            self.wait(_POLL_S)
            if self.get("body_measure") == 0:
                return _why(self.get("body_refused"))
        raise RobotError(f"node {self.client.node} is still measuring after {_LONGEST_S:g} s: switch it off")


def _why(refused: int) -> str:
    name, found = _NAMES.get(refused & 0xFF, ""), refused >> 8
    found -= (found >> 23) << 24  # a signed number of 24 bits
    if not name:
        return ""
    if name == "body_measure":
        return "it was interrupted: a bumper, the button, the bridge or the battery"
    if name == "body_refused":
        return "it was measured, but could not be stored"
    row = BODY_PARAMETERS[name]
    return f"{name} cannot be {found} {row.unit}: it is {row.minimum} to {row.maximum}"
