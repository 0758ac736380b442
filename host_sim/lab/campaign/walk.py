"""Random schedules of faults of all kinds, each to be compared with the same run without them."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from random import Random

from host_sim.lab.campaign.cell import LOCKSTEP, Cell
from host_sim.lab.campaign.matrix import HOST, LINE, ROBOT, FaultClass
from host_sim.protocol.generated import MESSAGES, Opcode
from host_sim.transport.rule import FAULT_NAMES, Event, Rule

_FAULTS_MAX, _SEEDS = 6, 5
_TICKS_A_S, _MARGIN = 50, 20
"""Ticks in a second, and at the beginning and at the end of a run, which are left to it."""

_INSTRUCTIONS = 20_000
_SIZES_MAX = {"duplicate": 3, "reorder": 5, "corrupt": 6, "truncate": 7, "flood": 50, "babble": 50}


def walk(count: int, seed: int, links: Sequence[str], profiles: Sequence[str], limit_s: float) -> list[list[Cell]]:
    """Draws schedules of 1 to 6 faults: frame faults, and at most one event each of the robot, its line and its host.

    Args:
        count: Number of schedules.
        seed: Seed of all of them.
        links: Links to the robot.
        profiles: Behaviours.
        limit_s: Robot time of each run, s.

    Returns:
        The cells, grouped by the run without faults, which comes first.
    """
    groups: dict[Cell, list[Cell]] = {}
    for number in range(count):
        dice = Random(f"{seed} {number}")
        base = Cell(dice.choice(profiles), dice.choice(links), LOCKSTEP, dice.randrange(_SEEDS) + 1, limit_s)
        groups.setdefault(base, [base]).append(_drawn(base, dice))
    return list(groups.values())


def _drawn(base: Cell, dice: Random) -> Cell:
    events = [event for classes in (ROBOT, LINE, HOST) for event in _event(classes, base, dice)]
    wanted = dice.randint(1, _FAULTS_MAX)
    events = dice.sample(events, min(len(events), wanted))
    faults = tuple(_rule(dice, base) for _ in range(wanted - len(events)))
    happening = tuple(each for some in events for each in some)
    return replace(base, faults=faults, events=happening, fault="a random schedule", harmless=True)


def _event(classes: Sequence[FaultClass], base: Cell, dice: Random) -> Iterator[list[Event]]:
    """What happens at once, in every other schedule."""
    there = [each for each in classes if each.can_happen(base.profile, base.link, base.pace)]
    possible = [each for each in there if "{saving}" not in each.event]  # there may be no lesson after it
    if possible and dice.random() < 1 / 2:
        tick = dice.randrange(_MARGIN, round(base.limit_s * _TICKS_A_S) - _MARGIN)
        told = dice.choice(possible).event.format(any=dice.randint(1, _INSTRUCTIONS))
        yield [Event.parse(f"{each}@{tick}") for each in told.split()]


def _rule(dice: Random, base: Cell) -> str:
    """A random fault of frames: by chance in all of them, or in each of a few."""
    name = dice.choice(FAULT_NAMES)
    first = dice.randrange(1, round(base.limit_s * _TICKS_A_S))
    when = dice.choice((f"{dice.randint(1, 20)}%", f"@{first}-{first + dice.randrange(40)}"))
    size, way = _size(name, dice), dice.choice(("", "/to", "/from"))
    chance, frames = (f":{when}", "") if when.endswith("%") else ("", when)
    return str(Rule.parse(f"{name}{chance}{size}{frames}{way}"))


def _size(name: str, dice: Random) -> str:
    if name == "forge":
        return f":{dice.choice([*(opcode.name.lower() for opcode in Opcode), *MESSAGES])}"
    if name == "delay":
        return f":0-{dice.randint(1, 300)}ms"
    return f":{dice.randint(1, _SIZES_MAX[name])}" if name in _SIZES_MAX else ""
