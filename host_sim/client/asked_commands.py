"""Recent commands, to which answers are matched, and detection of other simulators."""

from collections import deque

from host_sim.client.robot_reports import Arrival
from host_sim.protocol.codec import COUNTERS, DecodedFrame, Frame, counter_of

_KNOWN = COUNTERS - 1
_RIVAL_S = 1.0


class AskedCommands:
    """The latest commands, as many as their alive counters can tell apart.

    Attributes:
        answered: Whether the last command was answered, or there was none.
    """

    def __init__(self) -> None:
        """Starts without any command."""
        self.answered = True
        self._asked: deque[Frame] = deque(maxlen=_KNOWN)

    @property
    def last(self) -> Frame:
        """The last command."""
        return self._asked[-1]

    def add(self, command: Frame) -> None:
        """Adds a command that is about to be sent."""
        self._asked.append(command)
        self.answered = False

    def has(self, command: Frame) -> bool:
        """Whether these include a command, byte for byte."""
        return command in self._asked

    def judge(self, answer: Frame) -> Arrival:
        """Classifies an answer: NEW if first to the last command, AGAIN if repeated, OTHER if nothing matches."""
        matching = [asked for asked in self._asked if counter_of(asked) == counter_of(answer)]
        if not matching or matching[-1].data[1] != answer.data[1]:
            return Arrival.OTHER
        if self.answered or matching[-1] != self.last:
            return Arrival.AGAIN
        self.answered = True
        return Arrival.NEW


class Rivals:
    """Other simulators that command the same robot.

    Attributes:
        heard: Second frame heard within a second from another simulator, if any.
    """

    def __init__(self, owner: int, asked: AskedCommands) -> None:
        """Starts without any rival heard.

        Args:
            owner: Owner ID of this simulator.
            asked: The commands sent by this simulator.
        """
        self.heard: Frame | None = None
        self._owner, self._asked = owner, asked
        self._last_s: float | None = None

    def hear(self, frame: Frame, now_s: float) -> bool:
        """Counts a frame. Returns whether it is the second within a second: one may be noise, two are not."""
        if self._last_s is not None and now_s - self._last_s <= _RIVAL_S:
            self.heard = frame
        self._last_s = now_s
        return self.heard is frame

    def poses_as_us(self, frame: Frame, decoded: DecodedFrame) -> bool:
        """Whether a frame is a command with our owner ID sent by another: the robot obeys it, and it is not noise."""
        is_ours = decoded.signals.get("owner") == self._owner
        return decoded.name == "COMMAND" and is_ours and not self._asked.has(frame)
