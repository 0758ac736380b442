"""A cell of the campaign: a run with its faults, written as one line of text that reproduces it."""

import re
from dataclasses import dataclass, field, replace
from shlex import quote

from host_sim.base.errors import UsageError
from host_sim.protocol.generated import PROFILES
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
        link: The link to the robot, one of `links.LINKS`.
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
        """Whether its course may be another than without faults: of another body, or a killed simulator."""
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
