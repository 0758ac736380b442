"""The commands that a robot was sent lately, by which its answers are judged."""

from collections import deque

from host_sim.client.freshness import Arrival
from host_sim.protocol.codec import COUNTERS, Frame, counter_of

_KNOWN = COUNTERS - 1


class AskedCommands:
    """As many commands as can be told apart by their alive counters.

    Attributes:
        answered: Whether the last one was answered, or there was none.
    """

    def __init__(self) -> None:
        """Nothing was asked yet."""
        self.answered = True
        self._asked: deque[Frame] = deque(maxlen=_KNOWN)

    @property
    def last(self) -> Frame:
        """The last command."""
        return self._asked[-1]

    def add(self, command: Frame) -> None:
        """A command is about to be sent."""
        self._asked.append(command)
        self.answered = False

    def has(self, command: Frame) -> bool:
        """Whether a command is one of these, byte for byte."""
        return command in self._asked

    def judge(self, answer: Frame) -> Arrival:
        """What an answer is: NEW, once, if it is that to the last command; AGAIN; or OTHER, to what was not asked."""
        matching = [asked for asked in self._asked if counter_of(asked) == counter_of(answer)]
        if not matching or matching[-1].data[1] != answer.data[1]:
            return Arrival.OTHER
        if self.answered or matching[-1] != self.last:
            return Arrival.AGAIN
        self.answered = True
        return Arrival.NEW
