"""What the rows of some trials say, as a table for people."""

import math
import statistics
from collections.abc import Iterable, Sequence

from host_sim.protocol.generated import Side
from host_sim.study.trial import Row

_TRAPPED_S = 60.0
_PROPER = {1: Side.LEFT, 3: Side.LEFT, 4: Side.RIGHT, 6: Side.RIGHT}
_95_PERCENT = 1.96
_HEAD = ("profile", "finished", "median", "mean", "ratio to the first", "blocked", "trapped", "wrong cells", "bumps")
_NOTES = """\
finished     environments with all food eaten
median, mean robot time of an environment
ratio        of the mean times on the same seeds, with its 95 % interval
blocked      robot time from blocked to clear, mean
trapped      environments with more than 60 s of that at a time
wrong cells  robots that know a wrong turn for pattern 1, 3, 4 or 6 in the end
bumps        environments in which the body touched something"""


def table(rows: Sequence[Row]) -> str:
    """The rows by profile, each compared with the first one."""
    names = list(dict.fromkeys(row.profile for row in rows))
    by_name = {name: [row for row in rows if row.profile == name] for name in names}
    first = by_name[names[0]]
    lines = [_HEAD, *((name, *_figures(by_name[name], first)) for name in names)]
    widths = [max(len(line[column]) for line in lines) for column in range(len(_HEAD))]
    text = ["  ".join(word.ljust(width) for word, width in zip(line, widths, strict=True)).rstrip() for line in lines]
    return "\n".join([*text, "", _NOTES])


def _figures(rows: Sequence[Row], first: Sequence[Row]) -> tuple[str, ...]:
    times = [row.robot_s for row in rows]
    blocked = [seconds for row in rows for seconds in row.blocked_s]
    last = {row.seed: row for row in rows}
    wrong = [any(row.sides[cell] not in (0, side) for cell, side in _PROPER.items()) for row in last.values()]
    return (
        f"{_percent(row.finished for row in rows)}",
        f"{statistics.median(times):.0f} s",
        f"{statistics.mean(times):.0f} s",
        _ratio(_by_seed(rows), _by_seed(first)),
        f"{statistics.mean(blocked):.2f} s" if blocked else "-",
        str(sum(max(row.blocked_s, default=0.0) > _TRAPPED_S for row in rows)),
        _percent(wrong),
        str(sum(row.collisions > 0 for row in rows)),
    )


def _percent(truths: Iterable[bool]) -> str:
    counted = list(truths)
    return f"{100 * sum(counted) / len(counted):.1f} %"


def _by_seed(rows: Sequence[Row]) -> dict[int, float]:
    """Each seed's robot time."""
    sums: dict[int, float] = {}
    for row in rows:
        sums[row.seed] = sums.get(row.seed, 0.0) + row.robot_s
    return sums


def _ratio(ours: dict[int, float], theirs: dict[int, float]) -> str:
    """The ratio of the sums, with the interval that the paired differences from it give."""
    seeds = sorted(ours.keys() & theirs.keys())
    mean = statistics.mean(theirs[seed] for seed in seeds)
    ratio = statistics.mean(ours[seed] for seed in seeds) / mean
    if len(seeds) < 2:  # noqa: PLR2004 - one difference has no spread
        return f"{ratio:.2f}"
    spread = statistics.stdev(ours[seed] - ratio * theirs[seed] for seed in seeds)
    half = _95_PERCENT * spread / math.sqrt(len(seeds)) / mean
    return f"{ratio:.2f} ({ratio - half:.2f}..{ratio + half:.2f})"
