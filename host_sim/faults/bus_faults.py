"""The faults that can happen to a frame. Each is a class; `FAULTS` has them by name."""

import re
from collections.abc import Callable
from random import Random
from typing import NamedTuple, Protocol

from host_sim.base.errors import UsageError
from host_sim.base.frame import Frame
from host_sim.transport.clock import VirtualClock

_IDS = 0x800
_BYTES = 8
_FLOOD_MAX = 1000
_BABBLE = Frame(0, bytes(_BYTES))


class Passing(NamedTuple):
    """A frame on its way.

    Attributes:
        frame: The frame.
        delay_s: Additional delay, s.
        behind: Number of later frames that overtake it.
    """

    frame: Frame
    delay_s: float = 0.0
    behind: int = 0


class Fault(Protocol):
    """A fault of one frame."""

    def apply(self, passing: Passing, dice: Random) -> list[Passing]:
        """Returns the frames that arrive in place of a frame.

        Args:
            passing: The frame.
            dice: Source of all random numbers, so that equal dice give equal faults.
        """


class Drop:
    """The frame is lost."""

    def apply(self, passing: Passing, dice: Random) -> list[Passing]:  # noqa: ARG002 - as in `Fault`
        """As in `Fault`."""
        return []


class Duplicate:
    """The frame arrives more than once: `duplicate:2` makes two copies of it."""

    def __init__(self, size: str) -> None:
        """Takes the number of copies (1)."""
        self._copies = _number(size or "1", 1, _FLOOD_MAX)

    def apply(self, passing: Passing, dice: Random) -> list[Passing]:  # noqa: ARG002 - as in `Fault`
        """As in `Fault`."""
        return [passing] * (1 + self._copies)


class Reorder:
    """Later frames overtake the frame: `reorder:2` lets two frames pass."""

    def __init__(self, size: str) -> None:
        """Takes the number of frames (1)."""
        self._behind = _number(size or "1", 1, _FLOOD_MAX)

    def apply(self, passing: Passing, dice: Random) -> list[Passing]:  # noqa: ARG002 - as in `Fault`
        """As in `Fault`."""
        return [passing._replace(behind=passing.behind + self._behind)]


class Delay:
    """The frame takes longer: `delay:50ms` always 50 ms, `delay:0-300ms` anything between."""

    def __init__(self, size: str) -> None:
        """Takes the delay (0-300ms)."""
        match = re.fullmatch(r"(?:(\d{1,5})-)?(\d{1,5})ms", size or "0-300ms")
        if match is None or int(match[1] or match[2]) > int(match[2]):
            raise UsageError(f"a delay is a time such as 50ms or 0-300ms, not {size}")
        self._least_ms, self._most_ms = int(match[1] or match[2]), int(match[2])

    def apply(self, passing: Passing, dice: Random) -> list[Passing]:
        """As in `Fault`."""
        return [passing._replace(delay_s=passing.delay_s + dice.uniform(self._least_ms, self._most_ms) / 1000)]


class Corrupt:
    """Bits of the data change: `corrupt:3` flips three bits, or one bit three times."""

    def __init__(self, size: str) -> None:
        """Takes the number of bits (1)."""
        self._bits = _number(size or "1", 1, 8 * _BYTES)

    def apply(self, passing: Passing, dice: Random) -> list[Passing]:
        """As in `Fault`."""
        data = bytearray(passing.frame.data)
        for _ in range(self._bits if data else 0):
            data[dice.randrange(len(data))] ^= 1 << dice.randrange(8)
        return [passing._replace(frame=passing.frame._replace(data=bytes(data)))]


class Truncate:
    """The frame ends early: `truncate:3` leaves at most three bytes of data."""

    def __init__(self, size: str) -> None:
        """Takes the number of bytes left (any, but fewer than there were)."""
        self._left = _number(size, 0, _BYTES) if size else None

    def apply(self, passing: Passing, dice: Random) -> list[Passing]:
        """As in `Fault`."""
        data = passing.frame.data
        left = dice.randrange(max(len(data), 1)) if self._left is None else self._left
        return [passing._replace(frame=passing.frame._replace(data=data[:left]))]


class Flood:
    """Other talkers: `flood:50` sends 50 frames of any identifier, length and content before the frame."""

    def __init__(self, size: str) -> None:
        """Takes the number of frames (10)."""
        self._frames = _number(size or "10", 1, _FLOOD_MAX)

    def apply(self, passing: Passing, dice: Random) -> list[Passing]:
        """As in `Fault`."""
        return [*(Passing(random_frame(dice)) for _ in range(self._frames)), passing]


class Babble:
    """A node that cannot stop talking: `babble:50` sends 50 frames of highest priority, and the frame waits."""

    def __init__(self, size: str) -> None:
        """Takes the number of frames (20)."""
        self._frames = _number(size or "20", 1, _FLOOD_MAX)

    def apply(self, passing: Passing, dice: Random) -> list[Passing]:  # noqa: ARG002 - as in `Fault`
        """As in `Fault`."""
        late_s = passing.delay_s + self._frames * VirtualClock.FRAME_S
        return [Passing(_BABBLE)] * self._frames + [passing._replace(delay_s=late_s)]


class Forger(Protocol):
    """Listens to a bus, and sends frames in another's name."""

    def hear(self, frame: Frame) -> None:
        """Notes a frame on the bus."""

    def forge(self, dice: Random) -> Frame:
        """A frame with a valid CRC."""


Forgers = Callable[[str], Forger]
"""Creates a forger of the named command or message; of any, for an empty name."""


class Forge:
    """A forged frame with a valid CRC goes before the frame: `forge:stop` a command, `forge:MEMORY` a message."""

    def __init__(self, size: str, forgers: Forgers) -> None:
        """Takes the name of a command or of a message (any message)."""
        self._forger = forgers(size)

    def hear(self, frame: Frame) -> None:
        """As in `Forger`."""
        self._forger.hear(frame)

    def apply(self, passing: Passing, dice: Random) -> list[Passing]:
        """As in `Fault`."""
        return [Passing(self._forger.forge(dice)), passing]


def random_frame(dice: Random) -> Frame:
    """A frame of any identifier, length and content."""
    return Frame(dice.randrange(_IDS), dice.randbytes(dice.randrange(_BYTES + 1)))


def make_fault(name: str, size: str, forgers: Forgers) -> Fault:
    """A fault by its name.

    Args:
        name: One of `FAULTS`.
        size: Size in the fault's own unit; empty for its default.
        forgers: Creates forgers.

    Raises:
        UsageError: The size is invalid.
    """
    return FAULTS[name](size, forgers)


def _drop(size: str, _forgers: Forgers) -> Fault:
    if size:
        raise UsageError(f"drop has no size, not {size}")
    return Drop()


FAULTS: dict[str, Callable[[str, Forgers], Fault]] = {
    "drop": _drop,
    "duplicate": lambda size, _: Duplicate(size),
    "reorder": lambda size, _: Reorder(size),
    "delay": lambda size, _: Delay(size),
    "corrupt": lambda size, _: Corrupt(size),
    "truncate": lambda size, _: Truncate(size),
    "flood": lambda size, _: Flood(size),
    "babble": lambda size, _: Babble(size),
    "forge": Forge,
}
"""Creates each fault from its size and the forgers."""


def _number(text: str, least: int, most: int) -> int:
    if not text.isdecimal() or not least <= int(text) <= most:
        raise UsageError(f"a fault's size is a number from {least} to {most}, not {text}")
    return int(text)
