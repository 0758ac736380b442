"""The faults that can happen to a frame, each made by a function from its size; `FAULTS` has them by name."""

import re
from collections.abc import Callable
from random import Random
from typing import NamedTuple, Protocol

from host_sim.base.errors import UsageError
from host_sim.transport.clock import VirtualClock
from host_sim.transport.link import Frame

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


class Forger(Protocol):
    """Listens to a bus, and sends frames in another's name."""

    def hear(self, frame: Frame) -> None:
        """Notes a frame on the bus."""

    def forge(self, dice: Random) -> Frame:
        """A frame with a valid CRC."""


Fault = Callable[[Passing, Random], list[Passing]]
"""Returns the frames that arrive in place of a frame; all random numbers come from the dice, for equal faults."""

Forgers = Callable[[str], Forger]
"""Creates a forger of the named command or message; of any, for an empty name."""


def _drop(size: str, _: Forgers) -> Fault:
    """The frame is lost."""
    if size:
        raise UsageError(f"drop has no size, not {size}")
    return lambda _passing, _dice: []


def _duplicate(size: str, _: Forgers) -> Fault:
    """The frame arrives more than once: `duplicate:2` makes two copies of it (1)."""
    copies = _number(size or "1", 1, _FLOOD_MAX)
    return lambda passing, _dice: [passing] * (1 + copies)


def _reorder(size: str, _: Forgers) -> Fault:
    """Later frames overtake the frame: `reorder:2` lets two frames pass (1)."""
    behind = _number(size or "1", 1, _FLOOD_MAX)
    return lambda passing, _dice: [passing._replace(behind=passing.behind + behind)]


def _delay(size: str, _: Forgers) -> Fault:
    """The frame takes longer: `delay:50ms` always 50 ms, `delay:0-300ms` (the default) anything between."""
    match = re.fullmatch(r"(?:(\d{1,5})-)?(\d{1,5})ms", size or "0-300ms")
    if match is None or int(match[1] or match[2]) > int(match[2]):
        raise UsageError(f"a delay is a time such as 50ms or 0-300ms, not {size}")
    least_ms, most_ms = int(match[1] or match[2]), int(match[2])
    return lambda passing, dice: [passing._replace(delay_s=passing.delay_s + dice.uniform(least_ms, most_ms) / 1000)]


def _corrupt(size: str, _: Forgers) -> Fault:
    """Bits of the data change: `corrupt:3` flips three bits, or one bit three times (1)."""
    bits = _number(size or "1", 1, 8 * _BYTES)

    def fault(passing: Passing, dice: Random) -> list[Passing]:
        data = bytearray(passing.frame.data)
        for _ in range(bits if data else 0):
            data[dice.randrange(len(data))] ^= 1 << dice.randrange(8)
        return [passing._replace(frame=passing.frame._replace(data=bytes(data)))]

    return fault


def _truncate(size: str, _: Forgers) -> Fault:
    """The frame ends early: `truncate:3` leaves at most three bytes (any number, but fewer than there were)."""
    most = _number(size, 0, _BYTES) if size else None

    def fault(passing: Passing, dice: Random) -> list[Passing]:
        data = passing.frame.data
        left = dice.randrange(max(len(data), 1)) if most is None else most
        return [passing._replace(frame=passing.frame._replace(data=data[:left]))]

    return fault


def _flood(size: str, _: Forgers) -> Fault:
    """Other talkers: `flood:50` sends 50 frames of any identifier, length and content before the frame (10)."""
    count = _number(size or "10", 1, _FLOOD_MAX)
    return lambda passing, dice: [*(Passing(random_frame(dice)) for _ in range(count)), passing]


def _babble(size: str, _: Forgers) -> Fault:
    """A node that cannot stop talking: `babble:50` sends 50 frames of highest priority, and the frame waits (20)."""
    count = _number(size or "20", 1, _FLOOD_MAX)
    late_s = count * VirtualClock.FRAME_S
    return lambda passing, _dice: [Passing(_BABBLE)] * count + [passing._replace(delay_s=passing.delay_s + late_s)]


def _forge(size: str, forgers: Forgers) -> Fault:
    """A forged frame with a valid CRC goes before the frame: `forge:stop` a command, `forge:MEMORY` a message."""
    forger = forgers(size)
    return lambda passing, dice: [Passing(forger.forge(dice)), passing]


FAULTS: dict[str, Callable[[str, Forgers], Fault]] = {
    "drop": _drop,
    "duplicate": _duplicate,
    "reorder": _reorder,
    "delay": _delay,
    "corrupt": _corrupt,
    "truncate": _truncate,
    "flood": _flood,
    "babble": _babble,
    "forge": _forge,
}
"""Makes each fault from its size, empty for the default in brackets, and the forgers; UsageError for a wrong size."""


def random_frame(dice: Random) -> Frame:
    """A frame of any identifier, length and content."""
    return Frame(dice.randrange(_IDS), dice.randbytes(dice.randrange(_BYTES + 1)))


def _number(text: str, least: int, most: int) -> int:
    if not text.isdecimal() or not least <= int(text) <= most:
        raise UsageError(f"a fault's size is a number from {least} to {most}, not {text}")
    return int(text)
