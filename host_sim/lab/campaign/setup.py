"""What the campaign asks of a place where a robot can be."""

from collections.abc import Callable, Mapping
from typing import Protocol

from host_sim.client.robot_client import RobotClient
from host_sim.sim.run_config import RunConfig

Happen = Callable[[int], None]
"""Makes an event of a size happen."""


class Setup(Protocol):
    """A robot and its line, whose faults can be made to happen.

    Attributes:
        events: What can happen there, by name.
    """

    @property
    def events(self) -> Mapping[str, Happen]:
        """What can happen there, by name."""

    def configured(self, config: RunConfig) -> RunConfig:
        """A run with the robot that is here."""

    def found(self, client: RobotClient) -> None:
        """Told the robot's client, once the robot has answered."""
