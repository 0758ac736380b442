"""The oracles of the behaviours, and robots for them: they sense what they are told to, and draw as they are told to.

The oracle of a profile is the class of its name in `oracles/behaviours.py`.
"""

from typing import NamedTuple

from tests.firmware.octet_c import load
from tests.firmware.oracles import behaviours
from tests.firmware.oracles.listing import Action, Listing

FFI, C = load()

READINGS_MAX = 100
"""For one decision."""
Memory = dict[int, int] | bytearray


class Reading(NamedTuple):
    """What the robot senses as it decides."""

    feel: int
    look: bool = False
    beacon_mm: int = 0
    range_mm: tuple[int, ...] = (255,) * 5


def oracle_of(profile: str) -> type[Listing]:
    oracle: type[Listing] = getattr(behaviours, profile.title())
    return oracle


class SensingRobot:
    """A robot for the listing that senses what it is told to, and draws from a generator of its own."""

    readings = 0

    def __init__(self) -> None:
        self.reading = Reading(0)
        self.dice = FFI.new("struct random *")

    def feel(self) -> int:
        self.readings += 1
        assert self.readings < READINGS_MAX, "the oracle reads and decides nothing: the memory means nothing to it"
        return self.reading.feel

    def look(self) -> bool:
        return self.reading.look

    def beacon_mm(self) -> int:
        return self.reading.beacon_mm

    def ranges_mm(self) -> tuple[int, ...]:
        return self.reading.range_mm

    def random(self, n: int) -> int:
        return C.random_below(self.dice, n)


class ScriptedRobot(SensingRobot):
    """The same with draws that are given."""

    def __init__(self, draws: tuple[int, ...]) -> None:
        self.draws = iter(draws)

    def random(self, n: int) -> int:
        draw = next(self.draws)
        assert draw < n
        return draw


def repeat_count_during(action: Action, listing: Listing) -> int:
    """The brain's: it counts a remembered turn as it begins, the listing when it has ended; and it stays at 255."""
    return min(listing.repeat_count + (action.why == "REMEMBERED"), 255)


def oracle_says(
    oracle: type[Listing], readings: list[Reading], mem: Memory, repeat_count: int, draws: tuple[int, ...]
) -> tuple[Action, int]:
    """The last action of some readings in a row, and the brain's repeat count during it."""
    robot = ScriptedRobot(draws)
    listing = oracle(robot, mem, repeat_count)
    search = listing.search()
    for robot.reading in readings:
        action = next(search)
    return action, repeat_count_during(action, listing)
