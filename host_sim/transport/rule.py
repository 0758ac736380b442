"""The notation of faults of frames and of events at a tick, and the fewest of them that have the same effect."""

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import groupby
from pathlib import Path
from typing import Literal, TypeVar, get_args

from host_sim.base.errors import UsageError, meant
from host_sim.base.files import read_words

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


Direction = Literal["to", "from"]
"""To the robot, or from it."""

DIRECTIONS: tuple[Direction, ...] = get_args(Direction)

FAULT_NAMES = ("drop", "duplicate", "reorder", "delay", "corrupt", "truncate", "flood", "babble", "forge")
"""The names of the faults of frames."""

_RULE = re.compile(
    r"(?P<name>[a-z]{1,20})"
    r"(?::(?P<chance>\d{1,3}(?:\.\d{1,3})?)%)?"
    r"(?::(?P<size>[A-Za-z0-9-]{1,20}))?"
    r"(?:@(?P<first>\d{1,9})(?P<until>-(?P<last>\d{1,9})?)?)?"
    r"(?:/(?P<direction>to|from))?"
)
_ENDLESS = 10**9
_FILE_MAX = 16_000_000
_CERTAIN = 100.0


@dataclass(frozen=True)
class Rule:
    """One fault, and the frames that it may affect.

    `NAME[:CHANCE%][:SIZE][@FIRST[-[LAST]]][/to|/from]`:

    >>> Rule.parse("drop:30%")
    Rule(name='drop', chance=30.0, size='', first=1, last=1000000000, directions=('to', 'from'))
    >>> str(Rule.parse("delay:0-300ms@100-200/from"))
    'delay:0-300ms@100-200/from'

    Attributes:
        name: Name of the fault.
        chance: Chance for each frame, percent.
        size: Size in the fault's own unit; empty for its default.
        first: Number of the first frame, from 1; each direction has its own numbers.
        last: Number of the last frame.
        directions: The directions in which frames are affected.
    """

    name: str
    chance: float = _CERTAIN
    size: str = ""
    first: int = 1
    last: int = _ENDLESS
    directions: tuple[Direction, ...] = DIRECTIONS

    @staticmethod
    def parse(text: str) -> "Rule":
        """Reads a rule.

        Raises:
            UsageError: The text is malformed, or there is no such fault.
        """
        match = _RULE.fullmatch(text)
        if match is None:
            raise UsageError(f"{text!r} is not a fault: write NAME[:CHANCE%][:SIZE][@FIRST[-LAST]][/to|/from]")
        first = int(match["first"] or 1)
        last = int(match["last"] or _ENDLESS) if match["until"] or not match["first"] else first
        if match["name"] not in FAULT_NAMES:
            raise UsageError(f"there is no fault {match['name']!r}: {meant(match['name'], FAULT_NAMES)}")
        rule = Rule(match["name"], float(match["chance"] or _CERTAIN), match["size"] or "", first, last)
        if rule.chance > _CERTAIN or not 1 <= first <= last:
            raise UsageError(f"{text!r} is not a fault: its chance is over 100 %, or its frames run backwards")
        return rule if match["direction"] is None else rule.only(DIRECTIONS[match["direction"] == "from"])

    def only(self, direction: Direction) -> "Rule":
        """This rule for one direction only."""
        return replace(self, directions=(direction,))

    @property
    def is_certain(self) -> bool:
        """Whether every frame is affected."""
        return self.chance == _CERTAIN

    @property
    def is_single(self) -> bool:
        """Whether the rule is about one frame of each direction at most."""
        return self.first == self.last

    def at(self, number: int, direction: Direction) -> "Rule":
        """The rule for a single frame, without chance, as recorded when this rule has struck."""
        return Rule(self.name, _CERTAIN, self.size, number, number, (direction,))

    def covers(self, number: int, direction: Direction) -> bool:
        """Whether the rule is about a frame."""
        return self.first <= number <= self.last and direction in self.directions

    def __str__(self) -> str:
        chance = "" if self.is_certain else f":{self.chance:g}%"
        size = f":{self.size}" if self.size else ""
        direction = "" if self.directions == DIRECTIONS else f"/{self.directions[0]}"
        return f"{self.name}{chance}{size}{self._frames()}{direction}"

    def _frames(self) -> str:
        if (self.first, self.last) == (1, _ENDLESS):
            return ""
        if self.is_single:
            return f"@{self.first}"
        return f"@{self.first}-{'' if self.last == _ENDLESS else self.last}"


def read_rules(text: str) -> list[str]:
    """The rules in a command-line argument: one rule, or for `@FILE` those in a file, one per line.

    Raises:
        UsageError: The file cannot be read, or something in it is not a rule.
    """
    if not text.startswith("@"):
        return [str(Rule.parse(text))]
    return read_words(Path(text[1:]), _FILE_MAX, lambda word: str(Rule.parse(word)))


_Item = TypeVar("_Item")
_Result = TypeVar("_Result")


def fewer(
    items: list[_Item], attempt: Callable[[list[_Item]], _Result | None]
) -> Iterator[tuple[list[_Item], _Result]]:
    """Delta debugging: leaves out ever smaller parts of the items for as long as possible.

    Yields:
        Ever fewer items that cause the effect, and the result of `attempt` for them; None means no effect.
    """
    size = max(len(items) // 2, 1)
    while size:
        at = 0
        while at < len(items):
            rest = items[:at] + items[at + size :]
            result = attempt(rest) if rest else None
            if result is None:
                at += size
            else:
                items = rest
                yield items, result
        size //= 2


def in_ranges(rules: Sequence[Rule]) -> Iterator[Rule]:
    """Joins strikes of one kind at consecutive frames into one rule."""
    kinds = sorted(rules, key=lambda rule: (rule.name, rule.size, rule.directions, rule.first))
    numbered = enumerate(kinds)
    for _, run in groupby(
        numbered, lambda each: (each[1].name, each[1].size, each[1].directions, each[1].first - each[0])
    ):
        strikes = [rule for _, rule in run]
        yield replace(strikes[0], last=strikes[-1].last)


def narrower(rule: Rule, holds: Callable[[Rule], bool]) -> Rule:
    """Narrows a rule to as few frames as `holds` accepts, removing them at its end, else at its beginning."""
    step = (rule.last - rule.first + 1) // 2
    while step:
        ends = [replace(rule, last=rule.last - step), replace(rule, first=rule.first + step)]
        found = next((each for each in ends if each.first <= each.last and holds(each)), None)
        rule, step = (rule, step // 2) if found is None else (found, step)
    return rule
