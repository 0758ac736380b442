"""Bodies that are not as the robot expects: a sensor that is stuck or noisy, sensors or motors that are swapped."""

import random
import re
from collections.abc import Callable
from typing import Any, NamedTuple

from host_sim.errors import UsageError
from host_sim.protocol.generated import FEEL
from host_sim.robot_io import Senses
from host_sim.world.body import Body

_NOISE_PER_MILLE = 10
_BITS = tuple(FEEL.values())
_FRONT = FEEL["FRONT"]
_MIRRORED = tuple(
    sum(_BITS[-1 - place] for place, bit in enumerate(_BITS) if feel & bit) for feel in range(1 << len(_BITS))
)


class _FaultyBody:
    """A body in whose wires something is wrong; all else is as in the body itself."""

    def __init__(self, body: Body, dice: random.Random) -> None:
        self._body, self._dice = body, dice

    def __getattr__(self, name: str) -> Any:
        return getattr(self._body, name)


class _Noisy(_FaultyBody):
    """Each sensor is wrong in one tick of a hundred."""

    def sense(self, tick: int) -> Senses:
        senses = self._body.sense(tick)
        wrong = sum(bit for bit in _BITS if self._dice.randrange(1000) < _NOISE_PER_MILLE)
        return senses._replace(feel=senses.feel ^ wrong)


class _StuckOn(_FaultyBody):
    """The front sensor always sees something."""

    def sense(self, tick: int) -> Senses:
        senses = self._body.sense(tick)
        return senses._replace(feel=senses.feel | _FRONT)


class _Mirrored(_FaultyBody):
    """The ring of sensors is mounted the other way round."""

    def sense(self, tick: int) -> Senses:
        senses = self._body.sense(tick)
        return senses._replace(feel=_MIRRORED[senses.feel])


class _Swapped(_FaultyBody):
    """Each motor, with its odometer, has the other one's plug."""

    def sense(self, tick: int) -> Senses:
        senses = self._body.sense(tick)
        return senses._replace(odometer_left=senses.odometer_right, odometer_right=senses.odometer_left)

    def move(self, left_mm_s: float, right_mm_s: float) -> None:
        self._body.move(right_mm_s, left_mm_s)


FAULTS: dict[str, Callable[[Body, random.Random], Any]] = {
    "noise": _Noisy,
    "stuck-front": _StuckOn,
    "mirrored": _Mirrored,
    "swapped": _Swapped,
}
"""What can be wrong with a body, by name: makes one of a sound body and a generator of random numbers."""

OTHER_WAY_ROUND = frozenset(("swapped", "mirrored"))
"""The faults with which each turn leads to the other side than the senses say."""


class Change(NamedTuple):
    """A fault, and the environment in which it begins, from 1."""

    fault: str
    environment: int


def change_of(text: str) -> Change:
    """A change as people write it.

    >>> change_of("swapped@env6")
    Change(fault='swapped', environment=6)

    Raises:
        UsageError: It is none.
    """
    found = re.fullmatch(r"([\w-]+)@env([1-9]\d{0,3})", text)
    if not found or found[1] not in FAULTS:
        raise UsageError(f"{text!r} is no change such as swapped@env6; there are {', '.join(FAULTS)}")
    return Change(found[1], int(found[2]))
