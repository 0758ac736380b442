"""A link with injected faults, and the schedule that it follows."""

import math
import re
from array import array
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from random import Random
from typing import NamedTuple, Protocol

from host_sim.base.errors import UsageError
from host_sim.transport.link import Clock, Frame, Link, VirtualClock, WallClock
from host_sim.transport.rule import DIRECTIONS, Direction, Rule

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


RECORD_MAX = 100_000
"""Maximum number of faults recorded; later ones are only counted."""


class _Rolled:
    """One rule with its fault, and an independent random sequence for each direction."""

    def __init__(self, place: int, rule: Rule, fault: Fault, seed: int) -> None:
        self.place, self.rule, self.fault, self._seed = place, rule, fault, seed
        self._chances: dict[Direction, Random] = {}
        if not rule.is_certain:
            self._chances = {direction: Random(f"{seed} {rule} {direction}") for direction in DIRECTIONS}

    def strikes(self, number: int, direction: Direction) -> bool:
        """Whether the fault affects a frame. Must be called once for each frame that the rule covers."""
        if not self.rule.covers(number, direction):
            return False
        return self.rule.is_certain or self._chances[direction].random() * 100 < self.rule.chance

    def dice(self, number: int, direction: Direction) -> Random:
        """The dice of a frame: the same in a run with the rule and in one with the recorded fault."""
        return Random(f"{self._seed} {self.rule.name} {number} {direction}")


class Schedule:
    """Faults for the frames of one link. The same rules and seed damage the same frames in the same way.

    Attributes:
        count: Number of faults so far.
    """

    def __init__(self, rules: Sequence[Rule], seed: int, forgers: Forgers) -> None:
        """Prepares the faults: rules are applied in this order, those for a single frame first.

        Raises:
            UsageError: There is no such fault, or its size is invalid.
        """
        self._rules = [*rules]
        self._forgers: list[Forger] = []

        def forger_of(name: str) -> Forger:
            self._forgers.append(forgers(name))
            return self._forgers[-1]

        rolled = [
            _Rolled(place, rule, FAULTS[rule.name](rule.size, forger_of), seed) for place, rule in enumerate(rules)
        ]
        self._wide = [each for each in rolled if not each.rule.is_single]
        self._single: dict[int, list[_Rolled]] = {}
        for each in rolled:
            if each.rule.is_single:
                self._single.setdefault(each.rule.first, []).append(each)
        self._numbers = dict.fromkeys(DIRECTIONS, 0)
        self._struck = array("q")
        self.count = 0

    @property
    def struck(self) -> list[Rule]:
        """Each fault so far, as a rule for one frame: with the same seed they make the same faults again."""
        each = zip(self._struck[::3], self._struck[1::3], self._struck[2::3], strict=True)
        return [self._rules[place].at(number, DIRECTIONS[way]) for place, number, way in each]

    def passing(self, frame: Frame, direction: Direction) -> list[Passing]:
        """Returns the frames that arrive for the next frame in a direction, in order."""
        self._numbers[direction] += 1
        number = self._numbers[direction]
        arriving = [Passing(frame)]
        for rolled in (*self._single.get(number, ()), *self._wide):
            if rolled.strikes(number, direction):
                dice = rolled.dice(number, direction)
                arriving = [after for before in arriving for after in rolled.fault(before, dice)]
                self._record(rolled.place, number, direction)
        for forger in self._forgers:
            forger.hear(frame)
        return arriving

    def _record(self, place: int, number: int, direction: Direction) -> None:
        """Records a fault as numbers, since a run of a day has tens of thousands."""
        if self.count < RECORD_MAX:
            self._struck.extend((place, number, DIRECTIONS.index(direction)))
        self.count += 1


_BEHIND_S = 0.3
"""Time after which a frame waiting to be overtaken arrives, even without other frames, s."""

_LATE_MAX = 1000
"""Maximum number of frames processed after a timeout: they may keep coming, and a fault may drop them all."""


@dataclass
class _Held:
    """A delayed frame, due at a time or when enough frames have overtaken it."""

    frame: Frame
    due_s: float
    behind: int


@dataclass
class _Way:
    """One direction of a link: the delayed frames, and those that have arrived."""

    held: list[_Held] = field(default_factory=list)
    arrived: deque[Frame] = field(default_factory=deque)

    def put(self, passing: Passing, now_s: float) -> None:
        """Takes a frame, which arrives at once or later."""
        if not passing.delay_s and not passing.behind:
            self._arrive(passing.frame)
            return
        due_s = now_s + passing.delay_s + (_BEHIND_S if passing.behind else 0.0)
        self.held.append(_Held(passing.frame, due_s, passing.behind))

    def deliver(self, now_s: float) -> None:
        """Lets every frame arrive that is due."""
        while self.held and self.next_s() <= now_s:
            due = min(self.held, key=lambda held: held.due_s)
            self.held.remove(due)
            self._arrive(due.frame)

    def next_s(self) -> float:
        """The time at which the next frame is due."""
        return min((held.due_s for held in self.held), default=math.inf)

    def _arrive(self, frame: Frame) -> None:
        self.arrived.append(frame)
        for held in self.held:
            held.behind -= 1
            if held.behind == 0:
                held.due_s = -math.inf


class FaultyLink:
    """A link that wraps another one and injects faults into its frames in both directions.

    Attributes:
        schedule: The faults, and a record of them.
        link: The link to the robot.
    """

    def __init__(self, link: Link, schedule: Schedule, clock: Clock | None = None) -> None:
        """Takes over a link, which `close` closes; delays are by the wall clock unless another one is given."""
        self.schedule = schedule
        self.link, self._clock = link, clock or WallClock()
        self._ways: dict[Direction, _Way] = {direction: _Way() for direction in DIRECTIONS}

    def send(self, frame: Frame) -> None:
        """As in `Link`."""
        self._let_pass(frame, "to")
        self._deliver()

    def receive(self, timeout_s: float) -> Frame | None:
        """As in `Link`."""
        way = self._ways["from"]
        give_up, late = self._clock.now() + timeout_s, 0
        while True:
            self._deliver()
            if way.arrived:
                return way.arrived.popleft()
            now = self._clock.now()
            wait_s = min(give_up, *(each.next_s() for each in self._ways.values())) - now
            frame = self._clock.receive(self.link, max(wait_s, 0.0))
            is_late = self._clock.now() >= give_up
            if frame is not None:
                self._let_pass(frame, "from")
                late += is_late
            if is_late and (frame is None or late == _LATE_MAX):
                self._deliver()
                return way.arrived.popleft() if way.arrived else None

    def close(self) -> None:
        """As in `Link`. Frames that are still on their way are lost."""
        self.link.close()

    def _let_pass(self, frame: Frame, direction: Direction) -> None:
        now = self._clock.now()
        for passing in self.schedule.passing(frame, direction):
            self._ways[direction].put(passing, now)

    def _deliver(self) -> None:
        """Delivers all due frames: those to the robot are sent at once, those from it wait for `receive`."""
        now = self._clock.now()
        for way in self._ways.values():
            way.deliver(now)
        arrived = self._ways["to"].arrived
        while arrived:
            self.link.send(arrived.popleft())
