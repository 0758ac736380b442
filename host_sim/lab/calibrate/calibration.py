"""Calibrates a robot with a body on pins over the bus: starts measurements and reads their results."""

from collections.abc import Callable
from dataclasses import dataclass

from host_sim.base.errors import RefusedError, RobotError, UsageError
from host_sim.client.robot_client import RobotClient
from host_sim.protocol.words import BODY_PARAMETERS

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
        for _ in range(round(_LONGEST_S / _POLL_S)):
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
