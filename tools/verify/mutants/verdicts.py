"""Verdicts on mutants, and the scores computed from them."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

from tools.verify.mutants.schemata import Mutant
from tools.verify.mutants.sources import GROUPS, Group, group_of

SAMPLE = Group("sample", 97.0, ("",))


class Verdict(Enum):
    """The verdict on a mutant."""

    KILLED = "killed"
    SAME_CODE = "the same code"
    LISTED = "listed as equivalent"
    ALIVE = "alive"


@dataclass(frozen=True)
class Score:
    """The score of a group of mutants.

    Attributes:
        group: The group.
        counts: Number of mutants with each verdict.
    """

    group: Group
    counts: dict[Verdict, int]

    @property
    def percent(self) -> float:
        """Share of the non-equivalent mutants that are killed, percent."""
        killed, alive = self.counts[Verdict.KILLED], self.counts[Verdict.ALIVE]
        return 100.0 * killed / (killed + alive) if killed + alive else 100.0

    @property
    def is_enough(self) -> bool:
        """Whether the score reaches the group's bar."""
        return self.percent >= self.group.bar

    def __str__(self) -> str:
        parts = "  ".join(f"{count:5} {verdict.value}" for verdict, count in self.counts.items())
        return f"{self.group.name:8} {parts}  {self.percent:6.2f} %, bar {self.group.bar:g} %"


def scores(verdicts: Sequence[tuple[Mutant, Verdict]]) -> list[Score]:
    """The score of each group that has mutants."""
    found = []
    for group in GROUPS:
        of_group = [verdict for mutant, verdict in verdicts if group_of(mutant.file) == group]
        if of_group:
            found.append(_score(group, of_group))
    return found


def score_of_sample(verdicts: Sequence[tuple[Mutant, Verdict]]) -> Score:
    """The score of a sample, which is too small to be judged by group."""
    return _score(SAMPLE, [verdict for _, verdict in verdicts])


def _score(group: Group, verdicts: Sequence[Verdict]) -> Score:
    return Score(group, {verdict: verdicts.count(verdict) for verdict in Verdict})
