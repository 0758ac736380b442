"""Each robot's learning curves over time: trials, blocked time, cells known, meals."""

from dataclasses import dataclass, field

from host_sim.live.paced_run import PacedRun
from host_sim.protocol.generated import AVOIDING, ROW
from host_sim.world.memory_kinds import sides_of

SAMPLES_MAX = 600
"""Maximum number of samples; beyond it, every other one goes."""

NAMES = ("trials", "blocked", "cells", "meals")
"""The values in a sample of each robot; blocked is in ticks."""

_REASON = ROW.index("reason")

Sample = tuple[int, int, int, int]


@dataclass
class Curves:
    """Samples a run now and then, since it was last started over.

    Attributes:
        live: The run.
        ticks: The tick of each sample.
        robots: The samples of each robot.
        version: Number of times that earlier samples were dropped.
        start: The first tick since the run was last started over.
    """

    live: PacedRun
    ticks: list[int] = field(default_factory=list)
    robots: list[list[Sample]] = field(default_factory=list)
    version: int = 0
    start: int = -1
    _upto: int = 0
    _blocked: list[int] = field(default_factory=list)
    _trials: list[int] = field(default_factory=list)

    def sample(self) -> None:
        """Adds a sample if the run has gone on since the last one, which is a change that boards show."""
        live = self.live
        start, tick = live.start_tick, live.simulation.tick
        if start != self.start:
            self._begin(start)
        if self.ticks and self.ticks[-1] == tick:
            return
        if len(self.ticks) >= SAMPLES_MAX:
            self._thin()
        self._count_blocked()
        self.ticks.append(tick)
        for robot, samples in enumerate(self.robots):
            samples.append(self._sample(robot))
        self.live.change += 1

    def _begin(self, start: int) -> None:
        histories = self.live.recorder.histories
        self.start = self._upto = start
        self.ticks, self.robots = [], [[] for _ in histories]
        self._blocked, self._trials = [0] * len(histories), [history.trials for history in histories]
        self.version += 1

    def _thin(self) -> None:
        self.ticks = self.ticks[::2]
        self.robots = [samples[::2] for samples in self.robots]
        self.version += 1

    def _sample(self, robot: int) -> Sample:
        live = self.live
        trials = live.recorder.histories[robot].trials - self._trials[robot]
        cells = sum(map(bool, sides_of(live.simulation.clients[robot].memory)))
        return trials, self._blocked[robot], cells, self._meals(robot)

    def _meals(self, robot: int) -> int:
        """Pieces of food eaten in all environments since the start, including the current one."""
        live = self.live
        done = sum(episode.robots[robot].food_eaten for episode in live.episodes[live.started_over :])
        current = live.simulation.episode.robots[robot].food_eaten if live.ended_at is None else 0
        return done + current

    def _count_blocked(self) -> None:
        tracks = self.live.recorder.trajectory.tracks
        first, end = max(self._upto, tracks[0].first_tick), tracks[0].ticks
        for robot, track in enumerate(tracks):
            at = (first - track.first_tick) * len(ROW) + _REASON
            reasons = track.rows_flat[at :: len(ROW)]
            self._blocked[robot] += sum(reasons.count(reason) for reason in AVOIDING)
        self._upto = end
