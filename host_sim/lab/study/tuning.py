"""Searches the parameters of a behaviour by CMA-ES over fleets.

A generation is judged in rounds, each with fewer settings and with more seeds, all of them new, so that no setting
wins twice by lucky environments. The best of each generation and the defaults are compared once more on new seeds. A
robot that touches things is worse than any that does not, however fast it is.
"""

import json
import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from host_sim.base.errors import UsageError
from host_sim.base.extra_library import library
from host_sim.base.files import read_text, write_bytes
from host_sim.lab.study.figures import FIGURES
from host_sim.lab.study.fleets import sample_of
from host_sim.lab.study.sample import Sample, joined
from host_sim.lab.study.version import code_version
from host_sim.protocol.generated import PARAMETERS
from host_sim.sim.run_config import RunConfig

GOALS = {"time": "mean_s", "finished": "finished"}
"""The figure of each goal."""

OF_THE_BODY = ("speed_mm_s", "turn_speed_deg_s", "wheel_track_mm", "tick_ms", "share")
"""Parameters that are searched only if named: limits of the body, and features that a fleet lacks."""

_PART = 25  # seeds per work item
_KEPT = 3  # one in this many settings reaches the next round, which has as many times the seeds
_ROUNDS = 3
_FINALISTS = 4
_BUMPED_MAX, _UNFIT = 0.02, 1e6  # with collisions in a larger share of environments, a robot is worse than any other
_NOTES_MAX = 100_000_000
_SPREAD = 0.15  # standard deviation of the first generation, as a fraction of a parameter's range

Settings = tuple[tuple[str, int], ...]
"""Parameters and their values, in the order of PARAMETERS; omitted ones have their defaults."""

_Key = tuple[Settings, int, int]


class Piece(NamedTuple):
    """A fleet with some settings on consecutive seeds.

    Attributes:
        config: The run; its seed is the first one.
        seeds: Number of seeds.
    """

    config: RunConfig
    seeds: int

    def __str__(self) -> str:
        return self.config.command()


def run_pieces(pieces: Sequence[Piece]) -> list[tuple[Piece, Sample]]:
    """Runs fleets in this process."""
    return [(piece, sample_of(str(piece), piece.config, piece.config.seed, piece.seeds)) for piece in pieces]


Runner = Callable[[Sequence[Piece]], Iterator[Sequence[tuple[Piece, Sample]]]]
"""Runs pieces, in any order."""


class SearchTask(NamedTuple):
    """The task of a search.

    Attributes:
        config: The run; its seed is the first one.
        goal: One of GOALS.
        names: The parameters to search.
        seeds: Number of seeds in the last round of a generation.
    """

    config: RunConfig
    goal: str
    names: Sequence[str]
    seeds: int


class Search:
    """A search for settings.

    Attributes:
        best: The best settings found; empty if the defaults are best.
    """

    def __init__(self, task: SearchTask, run: Runner, notes: Path) -> None:
        """Starts or resumes a search.

        Args:
            task: The task of the search.
            run: Runs pieces.
            notes: File of the values found so far, to which new ones are added.

        Raises:
            UsageError: The file belongs to another search.
        """
        self._config, self._names, self._figure = task.config, task.names, FIGURES[GOALS[task.goal]]
        settings = task.config.robot_settings
        self._defaults = {name: settings.get(name, PARAMETERS[name].default) for name in task.names}
        self._sign = -1 if task.goal == "finished" else 1
        self._rounds = [max(2, task.seeds // _KEPT**i) for i in reversed(range(_ROUNDS))]
        self._run, self._next = run, task.config.seed
        about = task.config.command(), task.goal, *task.names, *self._rounds, code_version()
        self._notes = _Notes(notes, json.dumps(about))
        self.best: Settings = ()

    @property
    def seeds(self) -> tuple[int, int]:
        """First and last of the seeds used for choosing."""
        return self._config.seed, self._next - 1

    def go(self, trials: int, progress: Callable[[int], object]) -> None:
        """Tries about this many settings; `progress` is called with the number tried so far."""
        cmaes = library("cmaes", "study")
        size = min(trials, 8 + int(3 * math.log(len(self._names))))
        search = cmaes.CMA(
            mean=np.array([_place(*it) for it in self._defaults.items()]),
            sigma=_SPREAD,
            bounds=np.tile([0.0, 1.0], (len(self._names), 1)),
            seed=self._config.seed,
            population_size=size,
        )
        finalists: dict[Settings, None] = {(): None}
        for done in range(size, trials + 1, size):
            asked = [search.ask() for _ in range(size)]
            order = self._ranked([self._settings(it) for it in asked])
            search.tell([(it, float(order.index(self._settings(it)))) for it in asked])
            finalists[order[0]] = None
            progress(done)
        left = list(finalists)
        for seeds in (2 * self._rounds[-1], 6 * self._rounds[-1]):
            left = self._round(left, seeds)[:_FINALISTS]
        self.best = left[0]

    def _ranked(self, tried: Sequence[Settings]) -> list[Settings]:
        """The settings, best first; those that reached a later round come before all others."""
        left, behind = list(dict.fromkeys(tried)), list[Settings]()
        for seeds in self._rounds:
            left = self._round(left, seeds)
            if seeds != self._rounds[-1]:
                kept = max(1, len(left) // _KEPT)
                left, behind = left[:kept], left[kept:] + behind
        return left + behind

    def _round(self, settings: Sequence[Settings], seeds: int) -> list[Settings]:
        """Runs settings on new seeds; returns them best first."""
        first, self._next = self._next, self._next + seeds
        missing = [it for it in settings if (it, first, seeds) not in self._notes]
        for it, sample in zip(missing, samples_of(self._config, missing, first, seeds, self._run), strict=True):
            value = self._sign * float(self._figure.of(sample, np.arange(seeds)))
            touches = float(sample.bumped.mean()) > _BUMPED_MAX
            self._notes.add((it, first, seeds), value + _UNFIT * touches)
        return sorted(settings, key=lambda it: self._notes[it, first, seeds])

    def _settings(self, places: Any) -> Settings:
        """The settings at a point of the search space; parameters at their defaults are omitted."""
        values = {name: _value(name, float(place)) for name, place in zip(self._names, places, strict=True)}
        return tuple((name, value) for name, value in values.items() if value != self._defaults[name])


def samples_of(config: RunConfig, settings: Sequence[Settings], first: int, seeds: int, run: Runner) -> list[Sample]:
    """A sample for each of some settings, all on the same seeds."""
    parts = [(at, min(_PART, seeds - at)) for at in range(0, seeds, _PART)]
    pieces = [
        Piece(replace(config, seed=first + at, settings={**config.settings, **dict(it)}), count)
        for it in settings
        for at, count in parts
    ]
    known = {str(piece): sample for done in run(pieces) for piece, sample in done}
    found = [known[str(piece)] for piece in pieces]
    return [
        replace(
            joined(found[i * len(parts) : (i + 1) * len(parts)]),
            name=" ".join(f"{name}={value}" for name, value in it) or "defaults",
        )
        for i, it in enumerate(settings)
    ]


class _Notes(dict[_Key, float]):
    """The values found by a search, in a file of JSON lines: settings, first seed, number of seeds, and value."""

    def __init__(self, path: Path, about: str) -> None:
        super().__init__()
        self._path = path
        lines = read_text(path, _NOTES_MAX).splitlines() if path.exists() else [about]
        if lines[:1] != [about]:
            raise UsageError(f"{path} is of another search, or of another version; choose another folder with --out")
        for line in lines[1:]:
            with suppress(ValueError):  # the last line of a search that was killed
                settings, first, seeds, value = json.loads(line)
                self[tuple((name, number) for name, number in settings), first, seeds] = value
        path.parent.mkdir(parents=True, exist_ok=True)
        whole = (json.dumps([*key, value]) for key, value in self.items())
        write_bytes(path, "".join(f"{line}\n" for line in (about, *whole)).encode())

    def add(self, key: _Key, value: float) -> None:
        self[key] = value
        with self._path.open("a", encoding="ascii") as file:
            file.write(json.dumps([*key, value]) + "\n")


def _place(name: str, value: int) -> float:
    """Position of a value within its range on a logarithmic scale, 0 to 1."""
    it = PARAMETERS[name]
    return math.log1p(value - it.minimum) / math.log1p(it.maximum - it.minimum)


def _value(name: str, place: float) -> int:
    it = PARAMETERS[name]
    return it.minimum + round(math.expm1(place * math.log1p(it.maximum - it.minimum)))
