"""A robot in a process of its own at the other end of a socket pair: the firmware, or a custom program."""

import os
import threading
from dataclasses import replace
from pathlib import Path

from host_sim.base.errors import UsageError
from host_sim.client.robot_client import RobotClient
from host_sim.lab.campaign.host_events import process_events
from host_sim.lab.campaign.setup import Setup
from host_sim.sim.run_config import RunConfig


class SocketPair(Setup):
    """The setup of the firmware in a process of its own, which the run starts."""

    def __init__(self) -> None:
        self._before = _children()
        self._pid = 0
        self.events = process_events(lambda: self._pid)

    def configured(self, config: RunConfig) -> RunConfig:
        """As in `Setup`."""
        return replace(config, bus="fd")

    def found(self, client: RobotClient) -> None:  # noqa: ARG002 - as in `Setup`
        """As in `Setup`: the robot is the only new child of this process."""
        self._pid = self._only_child()

    def _only_child(self) -> int:
        (pid,) = _children() - self._before
        return pid


class OwnProgram(SocketPair):
    """The setup of a custom program."""

    def __init__(self, command: str) -> None:
        """Takes the program, which the run starts.

        Raises:
            UsageError: The command is empty.
        """
        if not command:
            raise UsageError("the link external needs --robot-command CMD, the robot")
        super().__init__()
        self._command = command
        # The whole process group, since a shell may have started the program; it changes with each restart.
        events = process_events(lambda: -self._only_child())
        self.events = {**events, "reset": events["kill"]}

    def configured(self, config: RunConfig) -> RunConfig:
        """As in `Setup`."""
        return replace(config, bus="fd", robot_command=self._command)


def _children() -> set[int]:
    path = Path(f"/proc/{os.getpid()}/task/{threading.get_native_id()}/children")
    return set(map(int, path.read_text(encoding="ascii").split()))
