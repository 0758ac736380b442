"""Frames that only a simulator sends: who else does that is found out by them."""

from host_sim.client.asked_commands import AskedCommands
from host_sim.protocol.codec import DecodedFrame, Frame

_RIVAL_S = 1.0


class Rivals:
    """Others who command the same robot.

    Attributes:
        heard: The second frame within a second from another simulator; None while there is none.
    """

    def __init__(self, owner: int, asked: AskedCommands) -> None:
        """Has heard nobody.

        Args:
            owner: Number of this simulator.
            asked: The commands that it has sent.
        """
        self.heard: Frame | None = None
        self._owner, self._asked = owner, asked
        self._last_s: float | None = None

    def hear(self, frame: Frame, now_s: float) -> bool:
        """Takes a frame. Returns whether it is the second one within a second: one may be noise, two are not."""
        if self._last_s is not None and now_s - self._last_s <= _RIVAL_S:
            self.heard = frame
        self._last_s = now_s
        return self.heard is frame

    def poses_as_us(self, frame: Frame, decoded: DecodedFrame) -> bool:
        """Whether it is a command in our name that is not ours: the robot obeys it, and it is no noise."""
        is_ours = decoded.signals.get("owner") == self._owner
        return decoded.name == "COMMAND" and is_ours and not self._asked.has(frame)
