"""A link with injected faults, and the schedule that it follows."""

import math
from array import array
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass, field
from random import Random

from host_sim.transport.bus_faults import FAULTS, Fault, Forger, Forgers, Passing
from host_sim.transport.clock import Clock, WallClock
from host_sim.transport.link import Frame, Link
from host_sim.transport.rule import DIRECTIONS, Direction, Rule

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
