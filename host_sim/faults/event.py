"""Events that affect a robot, its line or this host at a tick, and their notation."""

import re
from dataclasses import dataclass

from host_sim.base.errors import UsageError

_EVENT = re.compile(r"(?P<name>[a-z]+(?:-[a-z]+)*)(?::(?P<size>\d{1,5}))?@(?P<tick>\d{1,7})")


@dataclass(frozen=True)
class Event:
    """An event that occurs once, after a tick.

    `NAME[:SIZE]@TICK`; most sizes are a time in ms:

    >>> Event.parse("hang:300@150")
    Event(name='hang', size=300, tick=150)
    >>> str(Event.parse("reset@150"))
    'reset@150'

    Attributes:
        name: Name of the event.
        size: Size in the event's own unit; 0 for an event without one.
        tick: Number of ticks completed by then.
    """

    name: str
    size: int
    tick: int

    @staticmethod
    def parse(text: str) -> "Event":
        """Reads an event.

        Raises:
            UsageError: It is not an event.
        """
        match = _EVENT.fullmatch(text)
        if match is None:
            raise UsageError(f"{text!r} is not an event: write NAME[:SIZE]@TICK, such as hang:300@150")
        return Event(match["name"], int(match["size"] or 0), int(match["tick"]))

    def __str__(self) -> str:
        return f"{self.name}{f':{self.size}' if self.size else ''}@{self.tick}"
