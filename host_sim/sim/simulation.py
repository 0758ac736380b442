"""A run: robots in one environment after the other, their memories carried over."""

import gc
import math
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from host_sim.client.pacing import BegunTick, Lockstep, Pace
from host_sim.client.robot_client import RobotClient
from host_sim.client.supervision import settle
from host_sim.protocol.generated import NOTHING_SENSED, PARAMETERS, REST, Drive, Senses
from host_sim.sim.native_loop import BLOCK_TICKS, NativeLoop, suits
from host_sim.sim.world_record import Begun, Edited, EpisodeResult, Refused, RobotResult, WorldRecord
from host_sim.world.arena import Arena
from host_sim.world.body import Body
from host_sim.world.body_kinds import BodyKind
from host_sim.world.change_effects import edits_of
from host_sim.world.changes import Change
from host_sim.world.edits import Edit, EditError
from host_sim.world.geometry import SimParams
from host_sim.world.layouts import World
from host_sim.world.names import FAST, PYMUNK

if TYPE_CHECKING:
    from host_sim.world.crates import Crates


class ChangeSchedule:
    """Changes, each due before the senses of a tick.

    Attributes:
        next_tick: Tick of the next change; far away if no more are due.
    """

    def __init__(self, changes: Sequence[Change], tick_s: float) -> None:
        """Takes the changes; none are due before `enter`.

        Args:
            changes: The changes. Those due in the same tick keep their order.
            tick_s: Length of a tick, s.
        """
        self._changes, self._tick_s = changes, tick_s
        self._coming: list[tuple[int, Change]] = []
        self.next_tick = sys.maxsize

    def enter(self, number: int, tick: int) -> None:
        """Begins an environment; the first one restarts the run. Changes still due in the previous one are dropped.

        Args:
            number: Number of the environment.
            tick: Its first tick.
        """
        kept = [] if number == 1 else [coming for coming in self._coming if coming[1].number is None]
        begun = (None, 1) if number == 1 else (number,)
        new = [change for change in self._changes if change.number in begun]
        kept += [(tick + round(change.after_s / self._tick_s), change) for change in new]
        self._coming = sorted(kept, key=lambda coming: (coming[0], self._changes.index(coming[1])))
        self._look_ahead()

    def due(self, tick: int) -> list[Change]:
        """Returns the changes that are due by a tick, each only once."""
        count = sum(at <= tick for at, _ in self._coming)
        due = [change for _, change in self._coming[:count]]
        del self._coming[:count]
        self._look_ahead()
        return due

    def _look_ahead(self) -> None:
        self.next_tick = self._coming[0][0] if self._coming else sys.maxsize


SPACES_MAX = 32
"""Number of pymunk spaces that may wait to be freed. A space and its handlers form a cycle that holds 260 kB in C, of
which Python's garbage collector knows nothing."""

WHEEL_MM_S_MAX = math.ceil(
    math.radians(PARAMETERS["turn_speed_deg_s"].maximum) * PARAMETERS["wheel_track_mm"].maximum / 2
)
"""The highest speed that a robot may command, whatever its parameters, mm/s."""


@dataclass
class Simulation:
    """Takes started robots through their environments: all at once with `run`, or with `enter`, `step` and `leave`.

    `make` builds one.

    Attributes:
        world: The world from which the environments are drawn.
        clients: The robots, at least one, in the order of their start poses.
        pace: Keeps world and robots in step.
        seed: Seed for the environments.
        environments: Number of environments.
        limit_s: Robot time after which an environment ends, finished or not, s.
        watch: Called with the simulation after each step.
        changes: The scheduled changes of world and bodies.
        block_ticks: Maximum number of ticks per step at full speed with the loop in C; `watch` finds them in
            `loop`. Set it to 1 to have `watch` called for each tick.
        physics: The physics that finds overlaps, one of `PHYSICS`.
        native: Whether to use the loop in C if possible: in lockstep, with robots in this process or behind a
            socket that need no distances.
        kind: Properties of the robots' bodies; None: ideal.
        params: The dimensions of the world.
        record: The environments so far, and the changes made by people.
        tick: Number of the next tick.
        arena: The arena of the current environment.
        episode: Result of the current environment so far.
        loop: The loop in C; None where it cannot be used.
        senses: Each robot's senses at the last tick.
        drives: Each robot's drive at the last tick.
    """

    world: World
    clients: Sequence[RobotClient]
    pace: Pace
    seed: int
    environments: int
    limit_s: float
    watch: Callable[["Simulation"], object] = lambda _: None
    changes: Sequence[Change] = ()
    block_ticks: int = BLOCK_TICKS
    physics: str = FAST
    native: bool = True
    kind: BodyKind | None = None
    params: SimParams = field(init=False)
    record: WorldRecord = field(init=False)
    tick: int = 0
    arena: Arena = field(init=False)
    episode: EpisodeResult = field(init=False)
    loop: NativeLoop | None = field(init=False, default=None)
    senses: list[Senses] = field(init=False)
    drives: Sequence[Drive] = field(init=False)
    _before: Sequence[Body] = ()
    _crates: "Crates | None" = None
    _measuring: list[int] = field(default_factory=list)
    _settled: bool = False
    _too_fast: set[int] = field(default_factory=set)
    _schedule: ChangeSchedule = field(init=False)

    def __post_init__(self) -> None:
        robots, self.params = len(self.clients), self.world.params
        limit_ticks = round(self.limit_s / self.params.tick_s)
        self.record = WorldRecord(self.seed, self.environments, limit_ticks, robots, world=self.world, kind=self.kind)
        self._schedule = ChangeSchedule(self.changes, self.params.tick_s)
        self.senses, self.drives = [NOTHING_SENSED] * robots, [REST] * robots

    @property
    def over(self) -> bool:
        """Whether the environment has ended: all food eaten, or time up."""
        return not self.arena.food.left or self.episode.ticks >= self.record.limit_ticks

    @property
    def nodes(self) -> list[int]:
        """The robots' node numbers on the bus."""
        return [client.node for client in self.clients]

    def run(self) -> Iterator[EpisodeResult]:
        """Runs all environments.

        Yields:
            The result of each environment, when it has ended.

        Raises:
            RobotError: A robot has ended or does not answer.
            NoRoomError: An environment has no room for all the robots.
        """
        for number in range(1, self.environments + 1):
            self.enter(number)
            while not self.over:
                self.step(self.block_ticks)
            yield self.leave()

    def enter(self, number: int) -> None:
        """Begins an environment.

        Args:
            number: Number of the environment, from 1.

        Raises:
            NoRoomError: The environment has no room for all the robots.
        """
        layout = self.world.generate(self.seed, number, len(self.clients))
        self.arena = Arena(layout, self.params, self._before, self.physics, self.kind)
        if number == 1:
            self.arena.begin(self.seed)
        if self.world.crates is not None:
            from host_sim.world.crates import Crates  # noqa: PLC0415 - other runs begin sooner without pymunk

            self._crates = Crates(self.arena, self.world.crates)
        self.episode = EpisodeResult(self.params.tick_s, [RobotResult(node) for node in self.nodes])
        self._measuring = [i for i, client in enumerate(self.clients) if client.wants_ranges]
        self._enter_loop()
        self.record.begin(Begun(self.seed, number, self.tick))
        if self.physics == PYMUNK and number % SPACES_MAX == 0:
            gc.collect()
        self._schedule.enter(number, self.tick)
        self._settled = False

    def _enter_loop(self) -> None:
        if self._measuring or self._crates is not None:
            self.loop = None  # the loop in C supports neither distances nor pushing
            return
        if not (self.native and isinstance(self.pace, Lockstep) and suits(self.clients)):
            return
        self.loop = self.loop or NativeLoop(self.clients, self.clients[0].log)
        self.loop.enter(self.arena)

    def step(self, ticks_max: int = 1) -> None:
        """Simulates one tick or, where the loop in C can be used, a block of ticks.

        Args:
            ticks_max: Maximum number of ticks.

        Raises:
            RobotError: A robot has ended or does not answer.
        """
        if self.tick >= self._schedule.next_tick:
            for change in self._schedule.due(self.tick):
                self._make_change(change)
        if self.loop is not None:
            self._step_in_c(self.loop, ticks_max)
            return
        self._step_once()
        self.watch(self)
        if self._crates is not None:
            self._push(self._crates)

    def _step_in_c(self, loop: NativeLoop, ticks_max: int) -> None:
        """Runs a block; a tick that the loop hands over is completed in Python."""
        left = self.record.limit_ticks - self.episode.ticks
        ticks = loop.run(self.tick, max(1, min(ticks_max, left, self._schedule.next_tick - self.tick)))
        self.tick += ticks
        self.episode.ticks += ticks
        try:
            if loop.handed_over:
                self._step_once(loop.take_over())
                ticks += 1
                loop.record(self.senses, self.drives, [robot.food_eaten for robot in self.episode.robots])
        finally:
            if ticks:
                self._take_block(loop)
                self.watch(self)

    def _take_block(self, loop: NativeLoop) -> None:
        before, self.drives = self.drives, [REST] * len(self.clients)
        for i, robot in enumerate(self.episode.robots):
            self.senses[i], self.drives[i] = loop.last(i)
            if loop.ticks > 1 or self.drives[i].action != before[i].action:
                robot.begun = loop.begun(i)
            if loop.ticks > 1 or self.drives[i].eat:
                robot.food_eaten = loop.food_eaten(i)
        self._set_time(self.tick - 1)

    def _step_once(self, tick: BegunTick | None = None) -> None:
        self._set_time(self.tick)
        bodies, before = self.arena.bodies, self.drives
        for i, body in enumerate(bodies):
            self.senses[i] = body.sense(self.tick)
            if (sense := self.clients[i].connection.sense) is not None:
                self.senses[i] = sense(body, self.senses[i], self.tick)
        for i in self._measuring:
            self.clients[i].ranges = self.arena.ranges(i, self.tick)
        self.drives = self.pace.exchange(self.senses) if tick is None else self._go_on(tick)
        for i, (body, drive) in enumerate(zip(bodies, self.drives, strict=True)):
            if drive.eat and body.eat():
                self.episode.robots[i].food_eaten += 1
            body.move(drive.left_mm_s, drive.right_mm_s)
            if abs(drive.left_mm_s) > WHEEL_MM_S_MAX or abs(drive.right_mm_s) > WHEEL_MM_S_MAX:
                self._note_overspeed(i)
            if drive.action != before[i].action:
                begun = self.episode.robots[i].begun
                begun[drive.reason] = begun.get(drive.reason, 0) + 1
        self.tick += 1
        self.episode.ticks += 1

    def _note_overspeed(self, index: int) -> None:
        """Notes once that a robot commanded more than the maximum speed."""
        if index in self._too_fast:
            return
        self._too_fast.add(index)
        told = f"{self.drives[index].left_mm_s} and {self.drives[index].right_mm_s} mm/s"
        self.clients[index].distrust(f"the robot told its wheels {told}; it may do {WHEEL_MM_S_MAX} at most")

    def _go_on(self, tick: BegunTick) -> Sequence[Drive]:
        assert isinstance(self.pace, Lockstep)  # the loop exists only in lockstep
        return self.pace.exchange(self.senses, tick)

    def leave(self) -> EpisodeResult:
        """Ends the environment, finished or not, and returns its result."""
        arena, episode = self.arena, self.episode
        if self.over and not self._settled:
            self._settled = True
            for client in self.clients:
                settle(client)
        self._before = arena.bodies
        episode.eaten = arena.food.eaten
        for robot, body, client in zip(episode.robots, arena.bodies, self.clients, strict=True):
            robot.collisions, robot.memory = body.collisions, client.memory
            robot.stuck_sensors = (body.faults.stuck_on | body.faults.stuck_off).bit_count()
        return episode

    def edit(self, edit: Edit) -> None:
        """Makes a person's change to the world, before the next tick.

        Raises:
            EditError: The change cannot be made; nothing was changed.
        """
        self.arena.edit(edit)
        self.record.add(Edited(self.tick, edit))

    def _push(self, crates: "Crates") -> None:
        for edit in crates.push(self.drives):
            with suppress(EditError):  # a thing that a person has put into a wall, or made very short, stays there
                self.edit(edit)

    def _make_change(self, change: Change) -> None:
        """Applies a change; if it is impossible, records the reason and continues."""
        try:
            for edit in edits_of(change, self.arena, self.params, self.seed):
                self.edit(edit)
            self.record.happened.append(str(change))
        except EditError as error:
            self.record.refused.append(Refused(self.tick, str(change), str(error)))

    def set_clock(self) -> None:
        """Sets the log's time to that of the next tick."""
        self._set_time(self.tick)

    def _set_time(self, tick: int) -> None:
        self.clients[0].log.set_time(round(tick * self.params.tick_s * 1e6))
