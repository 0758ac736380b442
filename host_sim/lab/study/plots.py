"""Plots of a study, for results that a table cannot show."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from host_sim.base.extra_library import library
from host_sim.base.files import replacing
from host_sim.lab.study.figures import FIGURES, estimate
from host_sim.lab.study.heiserman import CLASSES, scores
from host_sim.lab.study.sample import CURVE, Floats, Sample

_COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#999999")
_SIZE_INCHES = (7.0, 4.2)
_DPI = 110
_SMOOTH = 5
_CREATURES, _CONTACTS = 200, 100

Draw = Callable[[Any, Sequence[Sample]], None]


def draw_plots(
    samples: Sequence[Sample], folder: Path, prefix: str = "", only: Sequence[str] | None = None
) -> list[Path]:
    """Draws the plots for which there are data.

    Args:
        samples: The conditions.
        folder: Folder for the PNG files; created if needed.
        prefix: Prefix of their names.
        only: Names of the plots to draw; by default all.

    Returns:
        The paths of the plots.

    Raises:
        OctetError: Matplotlib is not installed, or a file cannot be written.
    """
    plots: dict[str, Draw] = {"learning": _learning, "survival": _survival, "score": _score}
    if any(np.isfinite(sample.wrong_at).any() for sample in samples):
        plots["recovery"] = _recovery
    folder.mkdir(parents=True, exist_ok=True)
    wanted = {name: plot for name, plot in plots.items() if only is None or name in only}
    return [_draw(plot, samples, folder / f"{prefix}{name}.png") for name, plot in wanted.items()]


def _draw(plot: Draw, samples: Sequence[Sample], path: Path) -> Path:
    figure = library("matplotlib.figure", "study").Figure(figsize=_SIZE_INCHES, dpi=_DPI, layout="constrained")
    axes = figure.subplots()
    axes.set_prop_cycle(color=_COLOURS, linestyle=("-", "--") * (len(_COLOURS) // 2))  # lines may overlap
    axes.spines[["top", "right"]].set_visible(False)
    axes.grid(alpha=0.25)
    plot(axes, samples)
    with replacing(path) as part:
        figure.savefig(part, format="png", metadata={"Software": None})
    return path


def _learning(axes: Any, samples: Sequence[Sample]) -> None:
    """Duration of a contact by the number of contacts so far."""
    numbers = np.arange(1, CURVE + 1)
    for sample in samples:
        axes.plot(numbers, _smooth(_over_seeds(sample.blocked_at, _interquartile_mean)), label=sample.name)
    axes.set(xlabel="contact, counted from the robot's birth", ylabel="blocked, s (interquartile mean)")
    axes.set(xlim=(1, CURVE), ylim=(0, None))
    axes.legend(frameon=False)


def _survival(axes: Any, samples: Sequence[Sample]) -> None:
    """Share of environments not finished yet, by time."""
    end_s = max(float(np.max(sample.robot_s)) for sample in samples)
    for sample in samples:
        times = np.sort(sample.robot_s[sample.finished > 0])
        left = 100 * (1 - np.arange(1, len(times) + 1) / sample.robot_s.size)
        axes.step([0, *times, end_s], [100, *left, left[-1] if len(left) else 100], where="post", label=sample.name)
    axes.set(xlabel="robot time, s", ylabel="environments not finished, %", ylim=(0, 100), xlim=(0, end_s))
    axes.legend(frameon=False)


def _recovery(axes: Any, samples: Sequence[Sample]) -> None:
    """Share of robots that know a wrong turn, by contacts after the change."""
    for sample in samples:
        if np.isfinite(sample.wrong_at).any():
            axes.plot(np.arange(1, CURVE + 1), 100 * _over_seeds(sample.wrong_at, np.mean), label=sample.name)
    axes.set(xlabel="contacts after the change", ylabel="robots that know a wrong turn, %", xlim=(1, CURVE))
    axes.set_ylim(0, 102)
    axes.legend(frameon=False)


def _score(axes: Any, samples: Sequence[Sample]) -> None:
    """Heiserman's score of each condition and of his creatures, with the times blocked."""
    creatures = {
        f"Heiserman's {kind}": float(np.mean([list(scores(kind, seed, _CONTACTS))[-1] for seed in range(_CREATURES)]))
        for kind in CLASSES
    }
    found = [estimate(FIGURES["score"], sample) for sample in samples]
    names = [*creatures, *(sample.name for sample in samples)]
    values = [*creatures.values(), *(it.value for it in found)]
    errors = np.zeros((2, len(names)))
    errors[:, len(creatures) :] = [[it.value - it.low for it in found], [it.high - it.value for it in found]]
    colours = ["#999999"] * len(creatures) + [_COLOURS[i % len(_COLOURS)] for i in range(len(samples))]
    axes.barh(names, values, xerr=errors, color=colours)
    blocked = [f"{float(FIGURES['blocked_s'].of(it, np.arange(len(it.seeds)))):.2f} s blocked" for it in samples]
    for place, text in enumerate(blocked, len(creatures)):
        axes.text(values[place] + errors[1, place] + 0.01, place, text, va="center")
    axes.set(xlabel=f"Heiserman's score: good moves by contacts (his creatures: after {_CONTACTS})", xlim=(0, 1.25))
    axes.invert_yaxis()
    axes.grid(visible=False, axis="y")


def _over_seeds(curves: Floats, of: Callable[[Floats], Any]) -> Floats:
    """A statistic of the seeds' values at each contact; NaN where fewer than a quarter of the seeds have values."""
    there = [column[np.isfinite(column)] for column in curves.T]
    return np.array([of(column) if len(column) >= max(1, len(curves) // 4) else np.nan for column in there])


def _interquartile_mean(values: Floats) -> Any:
    """The mean of the middle half."""
    cut = len(values) // 4
    return np.sort(values)[cut : len(values) - cut].mean()


def _smooth(curve: Floats) -> Floats:
    """Moving average of a curve; at its ends, over the values available."""
    return np.array([curve[max(0, i - _SMOOTH // 2) : i + _SMOOTH // 2 + 1].mean() for i in range(len(curve))])
