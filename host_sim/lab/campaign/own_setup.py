"""A robot of one's own, which the run itself starts, and starts again when it has ended."""

from collections.abc import Mapping
from dataclasses import replace

from host_sim.base.errors import UsageError
from host_sim.lab.campaign.host_events import process_events
from host_sim.lab.campaign.setup import Happen
from host_sim.lab.campaign.socket_pair_setup import SocketPair
from host_sim.sim.run_config import RunConfig


class OwnProgram(SocketPair):
    """As in `Setup`."""

    def __init__(self, command: str) -> None:
        """Before the robot is there.

        Args:
            command: The program.

        Raises:
            UsageError: It is empty.
        """
        if not command:
            raise UsageError("the link external needs --robot-command CMD, the robot")
        super().__init__()
        self._command = command
        # The whole process group, since a shell may have started the program; it is another one after each restart.
        events = process_events(lambda: -self._only_child())
        self.events: Mapping[str, Happen] = {**events, "reset": events["kill"]}

    def configured(self, config: RunConfig) -> RunConfig:
        """As in `Setup`."""
        return replace(config, bus="fd", robot_command=self._command)
