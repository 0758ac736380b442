"""The outcome of a cell: whether it was safe, whether the fault was seen, and whether anything wrong was learned."""

from collections.abc import Collection, Iterable
from dataclasses import dataclass

from host_sim.client.pacing import HOLD_TICKS
from host_sim.lab.campaign.cell import Cell
from host_sim.protocol.generated import PARAMETERS
from host_sim.transport.rule import Event

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
        course: SHA-256 of the robot's senses, tick by tick, in which what it did before shows.
        memory: What the robot knows in the end.
        broke: Whether it ended with an error that is not about the robot, its line, or damaged files.
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
