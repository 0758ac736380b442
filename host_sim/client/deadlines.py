"""Timing quality of a run in real time: unanswered ticks, gaps between answers, and clock speed."""

from dataclasses import dataclass, field


@dataclass(frozen=True)
class Limits:
    """Limits beyond which the result of a run in real time is doubtful.

    Attributes:
        unanswered_percent: Share of the ticks without an answer.
        gap_s: Time without an answer that is too long, s; any tick without one if it is 0.
        behind_percent: Share of the wall-clock time by which the world's clock falls behind on this host.
    """

    unanswered_percent: float = 10.0
    gap_s: float = 1.0
    behind_percent: float = 5.0


_TICKS_MIN = 50
"""Minimum number of ticks for a meaningful share."""


@dataclass
class Deadlines:
    """Counts the ticks of one robot in real time.

    Attributes:
        limits: Limits beyond which the result is doubtful.
        ticks: Number of ticks.
        unanswered: Number of ticks without an answer.
        gap_s: Longest time without an answer, s.
        late: Number of ticks that began late, by more than a tick.
        latest_s: Maximum delay of a tick, s.
        lost_s: Total delay of the world's clock behind the wall clock, s.
        robot_s: Time on the world's clock, s.
    """

    limits: Limits = field(default_factory=Limits)
    ticks: int = 0
    unanswered: int = 0
    gap_s: float = 0.0
    late: int = 0
    latest_s: float = 0.0
    lost_s: float = 0.0
    robot_s: float = 0.0

    def begin(self, late_s: float, tick_s: float) -> float:
        """Notes the delay of a tick. Returns how much of it is lost, s.

        Delays under a tick are made up. Longer ones are not: many ticks at once would not be real time either.
        """
        lost_s = late_s if late_s > tick_s else 0.0
        self.ticks, self.robot_s, self.lost_s = self.ticks + 1, self.robot_s + tick_s, self.lost_s + lost_s
        self.late += lost_s > 0
        self.latest_s = max(self.latest_s, late_s)
        return lost_s

    def miss(self, gap_s: float, tick_s: float) -> bool:
        """Notes a tick without an answer, and the time since the last answer. Returns whether it is now too long."""
        self.unanswered += 1
        self.gap_s = max(self.gap_s, gap_s)
        return round(gap_s - tick_s, 6) < max(self.limits.gap_s, tick_s) <= gap_s

    @property
    def unanswered_percent(self) -> float:
        """Share of the ticks without an answer."""
        return 100 * self.unanswered / max(self.ticks, 1)

    @property
    def late_percent(self) -> float:
        """Share of the ticks that began late."""
        return 100 * self.late / max(self.ticks, 1)

    @property
    def speed(self) -> float:
        """Speed of the world's clock as a multiple of real time: 1 if it lost no time."""
        return self.robot_s / (self.robot_s + self.lost_s) if self.lost_s else 1.0

    def doubts(self) -> list[str]:
        """Reasons why the result is doubtful, at the end of the run."""
        if self.ticks < _TICKS_MIN:
            return []
        share, limit = self.unanswered_percent, self.limits.unanswered_percent
        slowest = 1 - self.limits.behind_percent / 100
        deaf = f"{share:.1f} % of the {self.ticks} ticks had no answer; the limit is {limit:g} %"
        slow = f"this host was too slow for real time: {self.speed:.3f} x; the limit is {slowest:g} x"
        return [deaf] * (share > limit) + [slow] * (self.speed < slowest)

    def summary(self) -> dict[str, float] | None:
        """The figures for `summary.json`; None in lockstep."""
        if not self.ticks:
            return None
        return {
            "ticks": self.ticks,
            "speed": round(self.speed, 4),
            "unanswered_percent": round(self.unanswered_percent, 2),
            "longest_gap_ms": round(self.gap_s * 1000),
            "late_percent": round(self.late_percent, 2),
            "latest_ms": round(self.latest_s * 1000, 1),
        }
