"""Random schedules of faults, and the reduction of one to the smallest with the same kind of outcome."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from random import Random

from host_sim.lab.campaign.cell import LOCKSTEP, Cell, Outcome
from host_sim.lab.campaign.matrix import HOST, LINE, ROBOT, FaultClass
from host_sim.protocol.generated import MESSAGES, Opcode
from host_sim.transport.rule import FAULT_NAMES, Event, Rule, fewer, in_ranges

_FAULTS_MAX, _SEEDS = 6, 5
_TICKS_A_S, _MARGIN = 50, 20
"""Ticks per second, and the number of ticks at the start and at the end of a run that have no event."""

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
    """Yields, with probability 1/2, the simultaneous events of one of these classes."""
    there = [each for each in classes if each.applies_to(base.profile, base.link, base.pace)]
    possible = [each for each in there if "{saving}" not in each.event]  # there may be no lesson after it
    if possible and dice.random() < 1 / 2:
        tick = dice.randrange(_MARGIN, round(base.limit_s * _TICKS_A_S) - _MARGIN)
        text = dice.choice(possible).event.format(any=dice.randint(1, _INSTRUCTIONS))
        yield [Event.parse(f"{each}@{tick}") for each in text.split()]


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


Attempt = Callable[[Cell], Outcome]
"""Runs a cell."""

_LIMIT_S = 0.5


def shrink(cell: Cell, attempt: Attempt) -> Iterator[Outcome]:
    """Removes what is not needed: whole items, then single strikes of a random fault, then time at the end.

    Yields:
        The outcome of the whole cell, then of each smaller one of the same kind; the last is the smallest.
    """
    found = attempt(cell)
    yield found
    for smaller in (_fewer, _single, _fewer, _shorter):
        for found in smaller(found, attempt):  # noqa: B020 - each begins with the last of the one before
            yield found


def _same(found: Outcome, cell: Cell, attempt: Attempt) -> Outcome | None:
    outcome = attempt(cell)
    return outcome if outcome.kind == found.kind else None


def _fewer(found: Outcome, attempt: Attempt) -> Iterator[Outcome]:
    """Removes items for as long as possible."""
    for _, smaller in fewer(found.cell.items, lambda rest: _same(found, found.cell.with_items(rest), attempt)):
        yield smaller


def _single(found: Outcome, attempt: Attempt) -> Iterator[Outcome]:
    """Replaces random rules and those for many frames by their strikes, if these alone have the same effect."""
    items = [item for item in found.cell.items if not item.startswith("fault=")]
    strikes = [f"fault={rule}" for rule in in_ranges(list(map(Rule.parse, found.struck)))]
    if not strikes or len(strikes) <= len(found.cell.faults):
        return
    smaller = _same(found, found.cell.with_items([*items, *strikes]), attempt)
    if smaller is not None:
        yield smaller


def _shorter(found: Outcome, attempt: Attempt) -> Iterator[Outcome]:
    """Halves the time for as long as the kind of outcome stays the same."""
    while found.cell.limit_s >= 2 * _LIMIT_S:
        half = round(found.cell.limit_s / 2, 1)
        smaller = _same(found, replace(found.cell, limit_s=half), attempt)
        if smaller is None:
            return
        found = smaller
        yield found
