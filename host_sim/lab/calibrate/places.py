"""Places an emulated robot for each calibration step, and knows the true values of its body."""

from math import pi

from host_sim.base.errors import UsageError
from host_sim.emulator.pins_board import PinsBoard
from host_sim.lab.calibrate.calibration import CALIBRATION_VALUES
from host_sim.protocol.words import SENSORS
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
