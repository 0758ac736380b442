"""The state of a whole bus from its frames: its robots, other traffic, and the load."""

from collections import deque

import can

from host_sim.lab.monitor.robot_watch import WINDOW_S, RobotWatch
from host_sim.protocol.codec import Frame
from host_sim.protocol.every_node import Heard, hear
from host_sim.protocol.frame_bits import frame_bits

_FULL = 0.7
"""The bus load above which regular frames may be late."""


class BusWatch:
    """Follows everything on a bus.

    Attributes:
        bitrate: Bit rate, bit/s.
        robots: The robots, by node number.
        frames: Number of frames of all kinds.
        foreign: Number of frames that do not come from a robot.
        errors: Number of error frames.
        dropped: Number of frames that arrived faster than they were read, and are missing here.
    """

    def __init__(self, bitrate: int) -> None:
        self.bitrate = bitrate
        self.robots: dict[int, RobotWatch] = {}
        self.frames = self.foreign = self.errors = self.dropped = 0
        self._bits: deque[tuple[float, int]] = deque()

    def accept(self, message: can.Message, now_s: float) -> Heard | None:
        """Processes a frame; returns it decoded if it is from or to a robot."""
        self.frames += 1
        if message.is_error_frame:
            self.errors += 1
            return None
        frame = Frame(message.arbitration_id, bytes(message.data))
        if message.is_extended_id or message.is_remote_frame or message.is_fd:
            self.foreign += 1
            return None
        self._bits.append((now_s, frame_bits(frame)))
        heard = hear(frame)
        if heard is None:
            self.foreign += 1
            return None
        robot = self.robots.setdefault(heard.node, RobotWatch(heard.node, now_s))
        robot.accept(heard.name, heard.signals, now_s)
        return heard

    def load(self, now_s: float) -> float:
        """The recent bus load; filtered-out frames are not included."""
        while self._bits and self._bits[0][0] <= now_s - WINDOW_S:
            self._bits.popleft()
        return sum(bits for _, bits in self._bits) / WINDOW_S / self.bitrate

    def wrong(self, now_s: float) -> list[str]:
        """The current problems, each in a few words that stay the same while it lasts."""
        found = [f"node {node}: {what}" for node, robot in sorted(self.robots.items()) for what in robot.wrong(now_s)]
        if self.errors:
            found.append("bus: error frames")
        if self.dropped:
            found.append("monitor: frames came faster than they could be shown, and some are missing here")
        if self.load(now_s) > _FULL:
            found.append(f"bus: load above {_FULL:.0%}")
        return found
