"""The result of every memory, for a robot that no longer learns.

Cell 0 is never read, so there are 3^7 = 2,187 memories. A robot reads only the cells of the patterns that it meets,
and all memories that agree in these have the same run. For each seed a tree of runs is searched: for each cell that a
run is the first to read, two more runs try the other values. About 400 runs give the exact results of all memories.
"""

import itertools
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple
from zipfile import BadZipFile

import numpy as np
from numpy.typing import NDArray

from host_sim.base.errors import UsageError
from host_sim.base.files import replacing
from host_sim.lab.study.sample import TRAPPED_S, Floats
from host_sim.lab.study.trial import Trial
from host_sim.protocol.generated import CELL_COUNT, Side
from host_sim.sim.fleet import Frozen, run_fleet
from host_sim.world.geometry import SimParams
from host_sim.world.memory_kinds import Memory

MEMORIES: Sequence[Memory] = [(0, *cells) for cells in itertools.product(Side, repeat=CELL_COUNT - 1)]
"""All memories of the kind `sides`."""

FOLDER = "maps"
_CELLS = np.array(MEMORIES)
_PARTS = "[0-9]*.npz"


class SeedMap(NamedTuple):
    """The results of all memories in one environment.

    Attributes:
        key: Condition and seed of the trial.
        values: Shape (memories, 3), in the order of `MEMORIES`: number of ticks, 1 if all food was eaten, and 1 if a
            contact took more than 60 s.
    """

    key: tuple[str, int]
    values: NDArray[np.uint16]


class _Branch(NamedTuple):
    """A memory to try, for all that agree with it on the first `settled` cells that its run reads."""

    memory: Memory
    settled: int

    def others(self, met: Sequence[int]) -> Iterator["_Branch"]:
        """The branches with another value in one of the further cells that the run has read, in their order."""
        for place, cell in enumerate(met[self.settled :], self.settled):
            kept = {it: self.memory[it] for it in met[:place]}
            for side in {*Side} - {self.memory[cell]}:
                memory = {**dict.fromkeys(range(CELL_COUNT), Side.NOTHING), **kept, cell: side}
                yield _Branch(tuple(memory.values()), place + 1)


def map_of(trial: Trial) -> SeedMap:
    """Computes the results of all memories in a trial's first environment from the runs that differ."""
    config, values = trial.config, np.zeros((len(MEMORIES), 3), np.uint16)
    left, trapped = [_Branch((0,) * CELL_COUNT, 0)], TRAPPED_S / SimParams().tick_s
    while left:
        robots = run_fleet(config, frozen=[Frozen(config.seed, it.memory) for it in left])
        branches = list[_Branch]()
        for it in robots:
            branch, met = left[it.robot - 1], list(it.met)
            same = (_CELLS[:, met] == np.array(branch.memory)[met]).all(axis=1)
            values[same] = it.ticks, it.finished, it.contacts.longest_ticks > trapped
            branches += branch.others(met)
        left = branches
    return SeedMap(trial.key, values)


class Atlas(NamedTuple):
    """The results of all memories under one condition.

    Attributes:
        seconds: Robot time of each environment, s: shape (seeds, memories).
        finished: Whether all food was eaten, same shape.
        trapped: Whether a contact took more than 60 s, same shape.
    """

    seconds: Floats
    finished: NDArray[np.bool_]
    trapped: NDArray[np.bool_]

    @property
    def mean_s(self) -> Floats:
        """Mean robot time of each memory, s: shape (memories,)."""
        return np.asarray(self.seconds.mean(0))

    @property
    def best(self) -> Memory:
        """The memory with the least mean time."""
        return MEMORIES[int(np.argmin(self.mean_s))]


class Maps:
    """The seed maps in a study's folder, in one file for each part."""

    def __init__(self, folder: Path) -> None:
        """Reads all parts.

        Raises:
            UsageError: A part cannot be read.
        """
        self._folder, self._known = folder / FOLDER, dict[tuple[str, int], NDArray[np.uint16]]()
        for path in sorted(self._folder.glob(_PARTS)):
            self._read(path)

    def done(self) -> set[tuple[str, int]]:
        """The keys of the completed trials."""
        return {*self._known}

    def add(self, maps: Sequence[SeedMap]) -> None:
        """Writes maps as a new part."""
        self._folder.mkdir(exist_ok=True)
        number = len([*self._folder.glob(_PARTS)])
        conditions, seeds = zip(*(it.key for it in maps), strict=True)
        with replacing(self._folder / f"{number:06d}.npz") as path, path.open("wb") as file:
            np.savez_compressed(file, conditions=conditions, seeds=seeds, values=[it.values for it in maps])
        self._known.update(maps)

    def _read(self, path: Path) -> None:
        try:
            with path.open("rb") as file, np.load(file, allow_pickle=False) as part:
                keys = zip(part["conditions"].tolist(), part["seeds"].tolist(), strict=True)
                self._known.update(zip(keys, part["values"], strict=True))
        except (OSError, ValueError, LookupError, BadZipFile) as error:
            raise UsageError(f"cannot read the maps in {path}: {error}") from None

    def atlas(self, condition: str, seeds: Sequence[int]) -> Atlas:
        """The atlas of a condition.

        Raises:
            KeyError: The map of a seed is missing.
        """
        values = np.array([self._known[condition, seed] for seed in seeds])
        ticks, finished, trapped = np.moveaxis(values, -1, 0)
        return Atlas(ticks * SimParams().tick_s, finished > 0, trapped > 0)
