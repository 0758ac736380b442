"""Distinguishes new messages from repeated and late ones by their alive counters."""

from enum import Enum, auto

from host_sim.protocol.codec import COUNTERS, Frame, counter_of

_AHEAD_MAX = COUNTERS // 2

GAP_MIN = _AHEAD_MAX + 1
"""After this many lost messages, a new one looks like a late one."""


class Arrival(Enum):
    """Classification of a message, compared with the last one of its kind."""

    NEW = auto()
    """The next message, or one of the few after it."""
    AGAIN = auto()
    """The last message again, byte for byte."""
    LATE = auto()
    """An earlier message."""
    OTHER = auto()
    """The last message's counter with other content: from a restarted or another sender."""
    ELSEWHERE = auto()
    """The second of two consecutive messages that do not follow the last one: late, or from another sender."""


class Freshness:
    """Follows the alive counter of one kind of message.

    Attributes:
        last: The last message; None before the first.
    """

    def __init__(self) -> None:
        """Accepts any message as new."""
        self.last: Frame | None = None
        self._late: Frame | None = None

    def judge(self, frame: Frame, *, gap: bool = False) -> Arrival:
        """Compares a message with those before it.

        Args:
            frame: The message.
            gap: Whether `GAP_MIN` or more may have been lost since the last one, so that its counter is meaningless.
        """
        if self.last is None:
            return self._take(frame, Arrival.NEW)
        ahead = _ahead(self.last, frame)
        if frame == self.last:
            return Arrival.AGAIN
        if ahead == 0:
            return self._take(frame, Arrival.OTHER)
        if ahead <= _AHEAD_MAX:
            return self._take(frame, Arrival.NEW)
        return self._judge_late(frame, _AHEAD_MAX if gap else 1)

    def go_on(self, frame: Frame) -> None:
        """Accepts a message that is known to be the next one."""
        self._take(frame, Arrival.NEW)

    def _judge_late(self, frame: Frame, ahead_max: int) -> Arrival:
        late, self._late = self._late, frame
        if late is not None and 1 <= _ahead(late, frame) <= ahead_max:
            return self._take(frame, Arrival.ELSEWHERE)
        return Arrival.LATE

    def _take(self, frame: Frame, arrival: Arrival) -> Arrival:
        self.last, self._late = frame, None
        return arrival


def _ahead(before: Frame, after: Frame) -> int:
    return (counter_of(after) - counter_of(before)) % COUNTERS
