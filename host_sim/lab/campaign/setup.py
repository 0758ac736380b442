"""The interface between the campaign and the setup of a robot."""

from collections.abc import Callable, Mapping
from typing import Protocol

from host_sim.client.robot_client import RobotClient
from host_sim.sim.run_config import RunConfig

Happen = Callable[[int], None]
"""Triggers an event of a given size."""


class Setup(Protocol):
    """A robot and its line, into which faults can be injected.

    Attributes:
        events: The possible events by name.
    """

    @property
    def events(self) -> Mapping[str, Happen]:
        """The possible events by name."""

    def configured(self, config: RunConfig) -> RunConfig:
        """The configuration of a run with this robot."""

    def found(self, client: RobotClient) -> None:
        """Called with the robot's client, once the robot has answered."""
