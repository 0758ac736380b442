"""The setup of a robot, into which a campaign injects faults."""

from collections.abc import Callable, Collection, Mapping
from dataclasses import replace

from host_sim.client.robot_client import RobotClient
from host_sim.sim.run_config import RunConfig

Happen = Callable[[int], None]
"""Triggers an event of a given size."""


class Setup:
    """A robot and its line: here one in this process, of which only the frames and the body can be faulty.

    Attributes:
        events: The possible events by name.
        of_opener: Those of them that only the process that opened this setup can trigger.
    """

    events: Mapping[str, Happen] = {}
    of_opener: Collection[str] = ()

    def configured(self, config: RunConfig) -> RunConfig:
        """The configuration of a run with this robot."""
        return replace(config, bus="none")

    def found(self, client: RobotClient) -> None:
        """Called with the robot's client, once the robot has answered."""
