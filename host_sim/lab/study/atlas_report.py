"""The report of an atlas, as figures, picture and CSV: important cells, the best memory, memories of learners."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from host_sim.base.extra_library import library
from host_sim.base.files import csv_text, replacing, write_bytes
from host_sim.lab.study.atlas import MEMORIES, Atlas, Maps
from host_sim.lab.study.contacts import OTHER, PROPER, digits_of
from host_sim.lab.study.figures import LEVEL
from host_sim.lab.study.fleets import sample_of
from host_sim.lab.study.plan import Plan
from host_sim.lab.study.sample import Floats, Sample
from host_sim.lab.study.trial import Trial
from host_sim.lab.table import aligned
from host_sim.protocol.generated import CELL_COUNT, Side
from host_sim.sim.fleet import run_fleet
from host_sim.world.memory_kinds import Memory

PROGRAMMED = "programmed"

_FIXED = (0, 1, 1, 1, 2, 1, 2, 1)

NAMED: Mapping[str, Memory] = {
    PROGRAMMED: _FIXED,  # a test compares it with the profile `fixed`
    "one-sided": tuple(PROPER.get(cell, Side.NOTHING) for cell in range(CELL_COUNT)),
    "empty": (Side.NOTHING,) * CELL_COUNT,
    "all wrong": tuple(OTHER[Side(side)] for side in _FIXED),
}
"""Memories that are compared, besides the best one and those of learners."""

_SEVERAL = ((1, 4), (3, 6), (5, 7), (1, 3, 4, 6), (2, 5, 7))
CELLS: Mapping[str, Sequence[int]] = {
    **{f"cell {cell}": (cell,) for cell in range(1, CELL_COUNT)},
    **{f"cells {' and '.join(map(str, cells))}": cells for cells in _SEVERAL},
}
"""Cells whose part in the variance of the mean times is computed."""

LEARNED_IN = 5
"""Number of environments in which a learner learns."""

_MIRRORED = tuple(int(f"{cell:03b}"[::-1], 2) for cell in range(CELL_COUNT))  # a bit for each front sensor
_RESAMPLES, _SEED = 1000, 1
_COLUMNS, _ROWS = (1, 3, 2, 5), (4, 6, 7)
_SIDES = ("empty", "left", "right")


def explained(means: Floats, cells: Sequence[int]) -> Floats:
    """The part of the variance of mean times over all memories that some cells explain, 0 to 1.

    Args:
        means: The mean times, shape (..., memories).
        cells: The cells.
    """
    grid = means.reshape(*means.shape[:-1], *[len(Side)] * (CELL_COUNT - 1))
    axes = tuple(range(-(CELL_COUNT - 1), 0))
    others = tuple(cell - CELL_COUNT for cell in range(1, CELL_COUNT) if cell not in cells)
    return _ratio(grid.mean(others, keepdims=True).var(axes), grid.var(axes))


def mirrored(means: Floats) -> Floats:
    """The mean times of the memories with left and right patterns exchanged, as with mirrored sensors.

    Args:
        means: The mean times, shape (..., memories).
    """
    index = {memory: i for i, memory in enumerate(MEMORIES)}
    return means[..., [index[tuple(memory[cell] for cell in _MIRRORED)] for memory in MEMORIES]]


def correlation(means: Floats, others: Floats) -> Floats:
    """Pearson's correlation of two maps' mean times over the memories, shape (..., memories) each."""
    a, b = (it - it.mean(-1, keepdims=True) for it in (means, others))
    return _ratio((a * b).sum(-1), np.sqrt((a * a).sum(-1) * (b * b).sum(-1)))


def _ratio(part: Floats, whole: Floats) -> Floats:
    """The quotient; NaN where the memories do not differ."""
    return np.asarray(np.divide(part, whole, out=np.full(np.shape(whole), np.nan), where=whole > 0))


class Report(NamedTuple):
    """The report of an atlas.

    Attributes:
        plan: The study.
        atlases: The atlas of each condition.
        ends: For each condition, the final memories of learners.
        samples: For each condition, samples of some memories on held-out seeds, the programmed memory first.
    """

    plan: Plan
    atlases: Mapping[str, Atlas]
    ends: Mapping[str, Sequence[Memory]]
    samples: Sequence[Sequence[Sample]]

    def rows(self) -> dict[tuple[str, str], tuple[float, float, float]]:
        """The figures of the maps by condition and name: value, low and high."""
        drawn = {name: _resampled(atlas.seconds) for name, atlas in self.atlases.items()}
        first, *others = drawn
        found = {
            (_named(self.plan, name, words), "explained"): 100 * explained(means, cells)
            for name, means in drawn.items()
            for words, cells in CELLS.items()
        }
        for name in others:
            found[name, "alike"] = correlation(drawn[name], drawn[first])
            found[name, "turned"] = correlation(drawn[name], mirrored(drawn[first]))
        return {key: _unbiased(values) for key, values in found.items()}

    def __str__(self) -> str:
        first, last = self.plan.seeds_used
        lines = [f"all {len(MEMORIES)} memories, each as a robot that learns no more: seeds {first}..{last}"]
        for name, atlas in self.atlases.items():
            means = atlas.mean_s
            order = np.argsort(means)
            best, worst = (f"{digits_of(MEMORIES[i])} {means[i]:.1f} s" for i in order[[0, -1]])
            place = 1 + int(np.flatnonzero(order == MEMORIES.index(NAMED[PROGRAMMED]))[0])
            lines += [f"{name}: mean {means.mean():.1f} s, best {best}, worst {worst}, programmed is number {place}"]
        rows = [
            (condition, figure, f"{value:.3g}", f"({low:.3g}..{high:.3g})")
            for (condition, figure), (value, low, high) in self.rows().items()
        ]
        judged = f"\nmemories on seeds {'..'.join(map(str, self.plan.judged_on))}:" if self.samples else ""
        return "\n".join([*lines, "", *aligned(rows, right=(2,)), judged])


def report_of(plan: Plan, maps: Maps) -> Report:
    """The report on a study whose maps are complete; runs learners, and the memories to compare."""
    first, last = plan.seeds_used
    atlases = {it.condition: maps.atlas(it.condition, range(first, last + 1)) for it in plan.conditions}
    count = plan.judged_on[1] - plan.judged_on[0] + 1 if plan.judged_on else plan.seeds
    ends = {it.condition: _ends(it, first, count) for it in plan.conditions}
    judged = [[*_samples(plan, it, atlases[it.condition].best, ends[it.condition])] for it in plan.conditions]
    return Report(plan, atlases, ends, judged if plan.judged_on else [])


def _samples(plan: Plan, trial: Trial, best: Memory, ends: Sequence[Memory]) -> Iterator[Sample]:
    named = {words: [memory] * len(ends) for words, memory in {**NAMED, "best": best}.items()}
    for words, memories in {**named, "learned": ends}.items():
        name = _named(plan, trial.condition, words)
        yield sample_of(name, trial.config, plan.judged_on[0], len(ends), memories)


def _named(plan: Plan, condition: str, words: str) -> str:
    return f"{condition} {words}" if len(plan.conditions) > 1 else words


def _ends(trial: Trial, first_seed: int, count: int) -> list[Memory]:
    """The memories of learners after their environments."""
    config = replace(trial.config, seed=first_seed, robots=count, worlds="own", environments=LEARNED_IN)
    last = {it.robot: it.memory for it in run_fleet(config, company=1) if it.environment == LEARNED_IN}
    return [last[robot] for robot in range(1, count + 1)]


def _resampled(seconds: Floats) -> Floats:
    """The mean times of each memory, shape (1 + resamples, memories): of all seeds, then of bootstrap resamples.

    All conditions use the same resamples.
    """
    count = len(seconds)
    drawn = np.random.default_rng(_SEED).multinomial(count, np.full(count, 1 / count), _RESAMPLES)
    weights: NDArray[np.float64] = np.vstack([np.ones(count), drawn]) / count
    return np.asarray(weights @ seconds)


def _unbiased(values: Floats) -> tuple[float, float, float]:
    """Value, low and high of the basic bootstrap, the value corrected for the bias that resampling shows."""
    value, drawn = float(values[0]), values[1:]
    low, high = np.percentile(drawn, (50 * (1 + LEVEL), 50 * (1 - LEVEL)))
    return 2 * value - float(drawn.mean()), 2 * value - float(low), 2 * value - float(high)


def write_map(report: Report, path: Path) -> None:
    """Writes the mean time and the percentages of each memory under each condition as comma-separated values."""
    columns = {"mean_s": 1.0, "finished": 100.0, "trapped": 100.0}
    names = [
        f"{name} {column}" if len(report.atlases) > 1 else column for name in report.atlases for column in columns
    ]
    values = [
        factor * (atlas.mean_s if column == "mean_s" else getattr(atlas, column).mean(0))
        for atlas in report.atlases.values()
        for column, factor in columns.items()
    ]
    every = zip(MEMORIES, np.transpose(values), strict=True)
    rows = ([digits_of(memory), *(f"{it:.1f}" for it in row)] for memory, row in every)
    write_bytes(path, csv_text([["memory", *names], *rows]).encode())


def draw_map(report: Report, path: Path) -> None:
    """Draws the mean times of all memories under each condition, with the ends of the learners."""
    count = len(report.atlases)
    figure = library("matplotlib.figure", "study").Figure(figsize=(11, 3.9 * count), dpi=90, layout="constrained")
    for axes, (name, atlas) in zip(np.atleast_1d(figure.subplots(count)), report.atlases.items(), strict=True):
        _draw(axes, atlas, report.ends[name])
        if count > 1:
            axes.set_title(name)
    path.parent.mkdir(parents=True, exist_ok=True)
    with replacing(path) as part:
        figure.savefig(part, format="png", metadata={"Software": None})


def _places(memories: Sequence[Memory]) -> NDArray[np.int64]:
    """Column and row of memories on the map."""
    cells = np.array(memories)

    def place(of: Sequence[int]) -> NDArray[np.int64]:
        return np.asarray(cells[:, of] @ len(Side) ** np.arange(len(of))[::-1])

    return np.stack([place(_COLUMNS), place(_ROWS)])


def _draw(axes: Any, atlas: Atlas, ends: Sequence[Memory]) -> None:
    size = len(Side) ** len(_ROWS), len(Side) ** len(_COLUMNS)
    field = np.zeros(size)
    field[tuple(_places(MEMORIES)[::-1])] = atlas.mean_s
    low, high = np.percentile(atlas.mean_s, (0, 99))
    image = axes.imshow(field, cmap="viridis_r", vmin=low, vmax=high, interpolation="nearest")
    axes.figure.colorbar(image, ax=axes, label="mean time of an environment, s", shrink=0.8)
    spread = np.random.default_rng(_SEED).uniform(-0.3, 0.3, (2, len(ends)))
    axes.plot(*(_places(ends) + spread), ",", color="#D55E00", alpha=0.6)
    for word, memory in {PROGRAMMED: NAMED[PROGRAMMED], "empty": NAMED["empty"], "best": atlas.best}.items():
        x, y = _places([memory])[:, 0]
        axes.plot(x, y, "x", color="black", markersize=9)
        axes.annotate(word, (x, y), (4, 5), textcoords="offset points", weight="bold")
    for part in (1, 2):
        axes.axvline(size[1] * part / 3 - 0.5, color="white", linewidth=2)
        axes.axhline(size[0] * part / 3 - 0.5, color="white", linewidth=2)
    axes.set_xticks(size[1] * (np.arange(3) + 0.5) / 3 - 0.5, [f"cell 1 {it}" for it in _SIDES])
    axes.set_yticks(size[0] * (np.arange(3) + 0.5) / 3 - 0.5, [f"cell 4\n{it}" for it in _SIDES])
