"""A robot with a body on emulated pins, whose wires, motors and sensors can fail."""

from dataclasses import replace

from host_sim.client.robot_client import RobotClient
from host_sim.emulator.robot_on_pins import SENSORS, SIDES, RobotOnPins
from host_sim.lab.campaign.board_setup import MS, Board, Later
from host_sim.lab.campaign.cell import PIN_EVENTS
from host_sim.lab.campaign.setup import Happen
from host_sim.sim.run_config import RunConfig

_BOUNCE_MS = 3


class PinsRobot(Board):
    """The setup of a stand-alone robot."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        on_pins: tuple[Happen, ...] = (
            lambda sensor: self._robot.wiring.rewire(SENSORS[sensor]),
            lambda side: self._robot.wiring.rewire(f"{SIDES[side]}_ENCODER_A"),
            lambda side: self._set("counts_by", side, -1),
            lambda side: self._set("stalled", side, True),
            lambda side: self._robot.wiring.rewire(f"{SIDES[side]}_PWM"),
            lambda _: setattr(self._robot, "swapped", True),
            lambda _: self._robot.set_bridge_fault(True),
            lambda _: setattr(self._robot, "converts", False),
            self._bounce,
        )
        self.events = {**dict(zip(PIN_EVENTS, on_pins, strict=True)), "flash-cut": self.events["flash-cut"]}

    def configured(self, config: RunConfig) -> RunConfig:
        """As in `Setup`."""
        return replace(config, robot="emulated", board=self._name, body="pins")

    def found(self, client: RobotClient) -> None:
        """As in `Setup`."""
        super().found(client)
        assert self.board.hardware.robot is not None  # only such boards have a body
        self._robot: RobotOnPins = self.board.hardware.robot

    def _set(self, what: str, side: int, value: int) -> None:
        getattr(self._robot, what)[side] = value

    def _bounce(self, span_ms: int) -> None:
        """Bounces the button's contacts, each time for less than a press takes."""
        clock = self.board.hardware.clock
        for at in range(0, span_ms, _BOUNCE_MS):
            Later(clock, at * MS, lambda down=not at // _BOUNCE_MS % 2: self._robot.set_button(down))  # type: ignore[misc]
        Later(clock, span_ms * MS, lambda: self._robot.set_button(False))
