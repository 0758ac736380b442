"""A run: one robot, one environment after the other, its memory carried over."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

from host_sim.client.pacing import Pace
from host_sim.client.session import Session
from host_sim.robot_io import Drive, Senses
from host_sim.sim.world_record import Begun, Edited, WorldRecord
from host_sim.world.arena import Arena
from host_sim.world.editing import make_edit
from host_sim.world.edits import Edit
from host_sim.world.geometry import Point
from host_sim.world.layouts import Layout, generate
from host_sim.world.params import SimParams

BOREDOM, EAT, REMEMBERED, TRIAL = 6, 7, 4, 5
"""Reasons, as in octet.dbc."""

_NOTHING_SENSED = Senses(0, 0, False, False, 0, 0, 0)
_AT_REST = Drive(0, 0, 0, 0, 0, 0, False)


@dataclass
class EpisodeResult:
    """What happened in one environment.

    Attributes:
        layout: The layout.
        tick_s: Length of a tick.
        ticks: How many there were.
        trail: Where the robot was and why it did what it did, (x in mm, y in mm, reason), for each tick.
        eaten: For each piece of food, whether it was eaten.
        finished: Whether all was eaten.
        begun: Number of actions begun, by reason.
        collisions: How often the body began to touch something.
        memory: The eight cells at the end.
    """

    layout: Layout
    tick_s: float
    ticks: int = 0
    trail: list[tuple[float, float, int]] = field(default_factory=list)
    eaten: list[bool] = field(default_factory=list)
    finished: bool = False
    begun: dict[int, int] = field(default_factory=dict)
    collisions: int = 0
    memory: tuple[int, ...] = (0,) * 8

    @property
    def robot_s(self) -> float:
        """Robot time spent here, s."""
        return round(self.ticks * self.tick_s, 3)


@dataclass
class Simulation:
    """Puts a started robot through its environments: `run` does it all; `enter`, `step` and `leave` do it bit by bit.

    Attributes:
        params: The measures.
        session: The conversation with the robot.
        pace: How world and robot keep time.
        seed: Of the environments.
        environments: How many.
        limit_s: Robot time after which an environment ends, finished or not.
        watch: Called after each tick with the environment's number and arena, for progress.
        record: Which environments there were, and what a person did to them.
        tick: Number of the next tick.
        arena: Of the environment entered last.
        episode: What has happened there so far.
        senses: Of the last tick.
        drive: Of the last tick.
    """

    params: SimParams
    session: Session
    pace: Pace
    seed: int
    environments: int
    limit_s: float
    watch: Callable[[int, Arena], object] = lambda *_: None
    record: WorldRecord = field(init=False)
    tick: int = 0
    arena: Arena = field(init=False)
    episode: EpisodeResult = field(init=False)
    senses: Senses = _NOTHING_SENSED
    drive: Drive = _AT_REST
    _odometer: Point = (0.0, 0.0)
    _action: int = -1

    def __post_init__(self) -> None:
        self.record = WorldRecord(self.seed, self.environments, round(self.limit_s / self.params.tick_s))

    @property
    def over(self) -> bool:
        """Whether the environment has ended: all food eaten, or time up."""
        return not self.arena.food_left or self.episode.ticks >= self.record.limit_ticks

    def run(self) -> Iterator[EpisodeResult]:
        """Runs it.

        Yields:
            Each environment's chapter when it has ended.

        Raises:
            RobotError: The robot is gone.
        """
        for number in range(1, self.environments + 1):
            self.enter(number)
            while not self.over:
                self.step()
            yield self.leave()

    def enter(self, number: int) -> None:
        """Begins the environment of that number."""
        layout = generate(self.seed, number, self.params)
        self.arena = Arena(layout, self.params, self._odometer)
        self.episode = EpisodeResult(layout, self.params.tick_s)
        self.record.begin(Begun(self.seed, number, self.tick))

    def step(self) -> None:
        """Does one tick.

        Raises:
            RobotError: The robot is gone.
        """
        arena, episode = self.arena, self.episode
        drive = self._exchange(arena)
        if drive.eat:
            arena.eat()
        arena.move(drive.left_mm_s, drive.right_mm_s)
        episode.ticks += 1
        x, y, _ = arena.pose
        episode.trail.append((x, y, drive.reason))
        if drive.action != self._action:
            self._action = drive.action
            episode.begun[drive.reason] = episode.begun.get(drive.reason, 0) + 1
        self.watch(self.record.begun[-1].number, arena)

    def leave(self) -> EpisodeResult:
        """Ends the environment, finished or not."""
        arena, episode = self.arena, self.episode
        self._odometer = arena.odometer
        episode.layout = arena.layout
        episode.eaten, episode.finished = arena.eaten, not arena.food_left
        episode.collisions, episode.memory = arena.collisions, self.session.memory
        return episode

    def edit(self, edit: Edit) -> None:
        """Lets a person change the world before the next tick.

        Raises:
            EditError: It cannot be done; nothing was changed.
        """
        make_edit(self.arena, edit, self.params)
        self.record.add(Edited(self.tick, edit))

    def set_clock(self) -> None:
        """Dates what is recorded from now on with the next tick."""
        self.session.recorder.time_us = round(self.tick * self.params.tick_s * 1e6)

    def _exchange(self, arena: Arena) -> Drive:
        self.set_clock()
        self.senses = arena.sense(self.tick)
        self.drive = drive = self.pace.exchange(self.senses)
        self.tick += 1
        return drive
