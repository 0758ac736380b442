"""A cell of the campaign, written as one line of text that reproduces it, and its outcome."""

import re
from collections.abc import Collection, Iterable
from dataclasses import dataclass, field, replace
from shlex import quote

from host_sim.base.errors import UsageError
from host_sim.client.pacing import HOLD_TICKS
from host_sim.protocol.generated import PARAMETERS, PROFILES
from host_sim.sim.run_config import RunConfig
from host_sim.transport.rule import Event, Rule
from host_sim.world.changes import Change

SEED = 12
LOCKSTEP, REAL_TIME = "lockstep", "real-time"
PACES = (LOCKSTEP, REAL_TIME)
PINS_LINK = "pins"
"""The link of a robot with a body on the pins of an emulated Blue Pill."""

PIN_EVENTS = (
    *("sensor-off", "encoder-off", "encoder-back", "motor-stall", "motor-off", "motors-swapped", "bridge-fault"),
    *("adc-stuck", "bounce"),
)
"""Body faults that are possible on that link."""

KILL_EVENTS = ("kill-simulator", "kill-saving")
"""Events that end the process of the run; another one goes on with its memory."""

PROCESS_LINKS = ("none", "fd")
"""Links where the run itself starts the robot, named as for `tools/run --bus`."""

_FORM = "PROFILE LINK PACE seed=N limit=SECONDS [fault=RULE ...] [change=CHANGE ...] [event=EVENT ...]"
_HEAD = re.compile(r"(\S+) (\S+) (\S+) seed=(\d{1,10}) limit=(\d{1,4}(?:\.\d{1,3})?)")


@dataclass(frozen=True)
class Cell:
    """One run of a campaign.

    >>> cell = Cell.parse("article fd lockstep seed=12 limit=8 fault=drop:30% event=hang:300@100")
    >>> cell.events
    (Event(name='hang', size=300, tick=100),)

    Attributes:
        profile: The behaviour.
        link: The link to the robot, one of `setups.LINKS`.
        pace: One of `PACES`.
        seed: Seed of the run, and of its faults.
        limit_s: Robot time of the run, s.
        faults: Faults of the frames, as for `--fault`.
        changes: Faults of the body, as for `--change`.
        events: Events of the robot, its line or this host.
        command_of_own: The program of a custom robot.
        fault: Description of the fault; empty for a run without a fault.
        harmless: Whether the fault may go unnoticed; in lockstep it must then leave no trace.
        denies: Whether the robot itself must report the fault, and learn nothing wrong.
    """

    profile: str
    link: str
    pace: str
    seed: int = SEED
    limit_s: float = 30.0
    faults: tuple[str, ...] = ()
    changes: tuple[str, ...] = ()
    events: tuple[Event, ...] = ()
    command_of_own: str = ""
    fault: str = field(default="", compare=False)
    harmless: bool = field(default=False, compare=False)
    denies: bool = field(default=False, compare=False)

    @staticmethod
    def parse(text: str) -> "Cell":
        """Parses a line written by `str`.

        Raises:
            UsageError: The line is malformed.
        """
        head = _HEAD.match(text)
        if head is None or head[1] not in PROFILES or head[3] not in PACES:
            raise UsageError(f"{text!r} is not a run: write {_FORM}")
        cell = Cell(head[1], head[2], head[3], int(head[4]), float(head[5]), fault="as given")
        return cell.with_items(text[head.end() :].split())

    @property
    def items(self) -> list[str]:
        """The faults and events, each with its kind."""
        return [
            *(f"fault={rule}" for rule in self.faults),
            *(f"change={change}" for change in self.changes),
            *(f"event={event}" for event in self.events),
        ]

    def with_items(self, items: list[str]) -> "Cell":
        """This run with other faults.

        Raises:
            UsageError: An item is malformed.
        """
        found: dict[str, list[str]] = {"fault": [], "change": [], "event": []}
        for item in items:
            kind, _, text = item.partition("=")
            if kind not in found:
                raise UsageError(f"{item!r} is not part of a cell: write {_FORM}")
            found[kind].append(text)
        return replace(
            self,
            faults=tuple(str(Rule.parse(text)) for text in found["fault"]),
            changes=tuple(str(Change.parse(text)) for text in found["change"]),
            events=tuple(map(Event.parse, found["event"])),
        )

    @property
    def without_fault(self) -> "Cell":
        """The same run without a fault."""
        return replace(self, faults=(), changes=(), events=(), fault="")

    @property
    def is_real_time(self) -> bool:
        """Whether it runs at wall-clock speed."""
        return self.pace == REAL_TIME

    @property
    def configuration(self) -> str:
        """Everything but the fault, in words."""
        return f"{self.profile}, {self.pace.replace('-', ' ')}, {self.link}"

    @property
    def is_of_body(self) -> bool:
        """Whether only the body is faulty."""
        on_pins = bool(self.events) and all(event.name in PIN_EVENTS for event in self.events)
        return not self.faults and (on_pins or (bool(self.changes) and not self.events))

    @property
    def may_differ(self) -> bool:
        """Whether its course may differ from that without faults: the body is faulty, or the simulator was killed."""
        return bool(self.changes) or any(event.name in (*PIN_EVENTS, *KILL_EVENTS) for event in self.events)

    @property
    def config(self) -> RunConfig:
        """The configuration of the run, with a robot in this process."""
        return RunConfig(
            self.seed,
            1,
            limit_s=self.limit_s,
            profile=self.profile,
            changes=self.changes,
            faults=self.faults,
            fault_seed=self.seed,
            real_time=self.is_real_time,
        )

    def command(self) -> str:
        """A command that repeats the run, and writes its files where possible."""
        if self.events or self.link not in PROCESS_LINKS:
            program = f" --robot-command {quote(self.command_of_own)}" if self.command_of_own else ""
            return f"tools/octet campaign{program} --repeat '{self}'"
        return replace(self.config, bus=self.link).command()

    def __str__(self) -> str:
        limit_s = f"{round(self.limit_s, 3):.10g}"
        head = f"{self.profile} {self.link} {self.pace} seed={self.seed} limit={limit_s}"
        return " ".join([head, *self.items])


_TICK_MS = PARAMETERS["tick_ms"].default
_FRESH_TICKS = 25
_DENIALS = ("denied", "contradictions")


def unreached(outcomes: Iterable["Outcome"], ways: Collection[str] = ("refused", "never came")) -> list[str]:
    """The faults, in words, whose `reach` is one of `ways` in every run: those runs test little."""
    reaches: dict[str, set[str]] = {}
    for each in outcomes:
        if each.cell.fault:
            reaches.setdefault(each.cell.fault, set()).add(each.reach)
    return [fault for fault, those in reaches.items() if those <= set(ways)]


@dataclass
class Outcome:
    """The outcome of one run.

    Attributes:
        cell: The run.
        oldest: Age of the oldest drive with which the wheels turned, in ticks.
        seen: How the fault was noticed, in words; empty if it was not.
        end: How the run ended early, in words; empty if it did not.
        doubts: Reasons why its result is doubtful.
        wrong: Patterns for which a wrong turn was learned.
        digest: SHA-256 of its log, in hexadecimal.
        course: SHA-256 of the SENSES frames, tick by tick, in hexadecimal; they show what the robot did.
        memory: The robot's eight bytes at the end.
        broke: Whether it ended with an unexpected error: not of the robot, its line, or damaged files.
        lost: Data missing from its files without a warning, in words; empty if they are complete.
        strikes: Number of faults applied to frames.
        refusals: Number of frames that simulator and robot refused.
        struck: The faults applied to frames, as rules for one frame each.
        waiting: Events that have not occurred.
        moved: Tick after which the robot last answered in time.
        ticks: Number of ticks.
        differs: Whether, in lockstep, its course or memory differs from that without the fault.
    """

    cell: Cell
    oldest: int = 0
    seen: str = ""
    end: str = ""
    doubts: tuple[str, ...] = ()
    wrong: tuple[int, ...] = ()
    digest: str = ""
    course: str = ""
    memory: tuple[int, ...] = ()
    broke: bool = False
    lost: str = ""
    strikes: int = 0
    refusals: int = 0
    struck: tuple[str, ...] = ()
    waiting: tuple[Event, ...] = ()
    moved: int = 0
    ticks: int = 0
    differs: bool = False

    @property
    def problems(self) -> list[str]:
        """Reasons why the campaign fails in this cell; empty if it does not."""
        cell = self.cell
        is_misled = self.wrong and (cell.denies or not (cell.changes or cell.is_of_body or self.end or self.doubts))
        found = {
            "unsafe": self.oldest > HOLD_TICKS,
            "unseen": bool(cell.fault) and not self._is_seen and (self.differs or not cell.harmless),
            "differs without a warning": self.differs and not (self.end or self.doubts or cell.may_differ),
            "did not happen": bool(self.waiting) and not self.end,
            "wrong without a warning": bool(is_misled),
            "lost without a warning": bool(self.lost),
            "broke": self.broke,
        }
        return [name for name, is_so in found.items() if is_so]

    @property
    def _is_seen(self) -> bool:
        """Whether the fault was noticed, by the robot itself if required."""
        return any(sign in self.seen for sign in _DENIALS) if self.cell.denies else bool(self.seen)

    @property
    def reach(self) -> str:
        """Whether its fault reached its receiver: reached, refused (all of it), or never came; empty without one."""
        cell = self.cell
        if not cell.items or self.end:
            return "reached" if cell.items else ""
        if cell.faults and not self.strikes and not cell.changes and not cell.events:
            return "never came"
        is_forged = bool(cell.faults) and all(rule.startswith("forge") for rule in cell.faults)
        return "refused" if is_forged and self.refusals >= self.strikes and not self.doubts else "reached"

    @property
    def recovered(self) -> bool:
        """Whether the run reached its end with a robot that answers."""
        return not self.end and self.ticks - self.moved < _FRESH_TICKS

    @property
    def rest_ms(self) -> int:
        """Longest time for which wheels turned without a new drive, ms."""
        return self.oldest * _TICK_MS

    @property
    def kind(self) -> str:
        """The worst finding in a word or two, which a smaller schedule must still reproduce."""
        learned = "learned wrong turns" if self.wrong else "went on"
        return (*self.problems, *["ended"] * bool(self.end), *["doubted"] * bool(self.doubts), learned)[0]

    def compare(self, clean: "Outcome") -> None:
        """Compares with the run without a fault, and notes the differences."""
        if self.cell.is_of_body and not self.seen and self.digest != clean.digest:
            self.seen = "what it does"
        result, without = (self.course, self.memory), (clean.course, clean.memory)
        self.differs = result != without and not self.cell.is_real_time
