"""How close a run came to real time: unanswered ticks, gaps between answers, ticks that began late."""

from dataclasses import dataclass, field


@dataclass(frozen=True)
class Limits:
    """Beyond these, the result of a run in real time is doubtful.

    Attributes:
        unanswered_percent: Share of the ticks without an answer.
        gap_s: Longest time without an answer, s.
        late_percent: Share of the ticks that this host began late, by more than a tick.
    """

    unanswered_percent: float = 10.0
    gap_s: float = 1.0
    late_percent: float = 10.0


_LATE = 1.0
"""Of a tick."""

_TICKS_MIN = 50
"""In fewer ticks, a share says nothing."""


@dataclass
class Punctuality:
    """Counts the ticks of one robot in real time.

    Attributes:
        limits: What makes the result doubtful.
        ticks: Number of ticks.
        unanswered: Number of those without an answer.
        gap_s: The longest time without an answer, s.
        late: Number of ticks that began late.
        latest_s: The most that one was late, s.
    """

    limits: Limits = field(default_factory=Limits)
    ticks: int = 0
    unanswered: int = 0
    gap_s: float = 0.0
    late: int = 0
    latest_s: float = 0.0

    def begin(self, late_s: float, tick_s: float) -> None:
        """A tick begins, some time after it should."""
        self.ticks += 1
        self.late += late_s > _LATE * tick_s
        self.latest_s = max(self.latest_s, late_s)

    def miss(self, gap_s: float, tick_s: float) -> bool:
        """A tick has no answer, and none has come for some time. Returns whether this is now too long."""
        self.unanswered += 1
        self.gap_s = max(self.gap_s, gap_s)
        return round(gap_s - tick_s, 6) < self.limits.gap_s <= gap_s

    @property
    def unanswered_percent(self) -> float:
        """Share of the ticks without an answer."""
        return 100 * self.unanswered / max(self.ticks, 1)

    @property
    def late_percent(self) -> float:
        """Share of the ticks that began late."""
        return 100 * self.late / max(self.ticks, 1)

    def doubts(self) -> list[str]:
        """What makes the result doubtful at the end of the run."""
        if self.ticks < _TICKS_MIN:
            return []
        shares = (
            (self.unanswered_percent, self.limits.unanswered_percent, "had no answer"),
            (self.late_percent, self.limits.late_percent, "began late on this host"),
        )
        return [
            f"{share:.1f} % of the {self.ticks} ticks {what}; the limit is {limit:g} %"
            for share, limit, what in shares
            if share > limit
        ]

    def summary(self) -> dict[str, float] | None:
        """For `summary.json`; None in lockstep."""
        if not self.ticks:
            return None
        return {
            "ticks": self.ticks,
            "unanswered_percent": round(self.unanswered_percent, 2),
            "longest_gap_ms": round(self.gap_s * 1000),
            "late_percent": round(self.late_percent, 2),
            "latest_ms": round(self.latest_s * 1000, 1),
        }
