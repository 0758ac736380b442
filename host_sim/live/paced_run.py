"""A run that people watch and interact with: paced by the wall clock, with commands carried out between ticks."""

import asyncio
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field, replace

from host_sim.base.errors import RefusedError
from host_sim.client.commands import erase_memory
from host_sim.live.page_commands import (
    FULL_SPEED,
    EraseMemory,
    Freeze,
    MoveRobot,
    NewSeed,
    NextEnvironment,
    OneDecision,
    PageCommand,
    Play,
    Speed,
    WriteCell,
)
from host_sim.live.robot_orders import command_robot, discard_reports, index_of
from host_sim.protocol.generated import Drive, Reason
from host_sim.recording.run_recorder import RunRecorder
from host_sim.sim.simulation import Simulation
from host_sim.sim.world_record import EpisodeResult
from host_sim.world.edits import Edit, EditError
from host_sim.world.geometry import SimParams

COMMANDS_MAX = 256
"""Maximum number of commands that wait for the next tick; more are refused."""

PAUSE_S = 2.0
"""Pause after each environment except at full speed, s of wall-clock time, so that its end can be seen."""

_SLICE_S = 0.008
_IDLE_S = 0.02
_LATE_S = 0.1
_RATE_S = 0.5

_STEPS = {Reason.WANDER: Reason.WANDER, Reason.LOOK_AROUND: Reason.WANDER, Reason.TOWARD_FOOD: Reason.TOWARD_FOOD}
"""The reasons of small steps: several of them with the same value here make one decision."""

Reject = Callable[[str], None]


@dataclass
class PacedRun:
    """Plays a simulation a few ticks at a time, with the event loop's other work in between.

    Attributes:
        simulation: The simulation, before its first environment.
        recorder: Records the simulation, and what people do to the robots' memories.
        restart: Restarts the robots with another seed.
        ended: Called with the result of each environment.
        stays: Whether to wait for commands after the last environment rather than end.
        waits: Whether the first tick waits for someone to watch; `seen` ends the wait.
        speed: Speed as a multiple of real time, or `FULL_SPEED`.
        playing: Whether the run is not paused.
        done: Whether the last environment has ended.
        ended_at: Tick at which the current environment ended, before the pause; None while it goes on.
        episodes: The results of the environments so far.
        started_over: Number of episodes before the run was last started over.
        layout: Number of changes of the arena, whoever made them, new environments among them.
        change: Number of changes that a page shows and that happened between ticks.
        rate: Current rate, ticks per second.
        late: Number of ticks that began more than 0.1 s late.
        refused: Number of messages that were not valid commands, or were too many at once.
        closed: Whether somebody has ended it.
        over_s: When `play` ended, on the monotonic clock; 0.0 until then.
    """

    simulation: Simulation
    recorder: RunRecorder
    restart: Callable[[int], None]
    ended: Callable[[EpisodeResult], object] = lambda _: None
    stays: bool = True
    waits: bool = False
    speed: float = 1.0
    playing: bool = True
    done: bool = False
    ended_at: int | None = None
    episodes: list[EpisodeResult] = field(default_factory=list)
    started_over: int = 0
    layout: int = 0
    change: int = 0
    rate: float = 0.0
    late: int = 0
    refused: int = 0
    closed: bool = False
    over_s: float = 0.0
    _commands: deque[tuple[PageCommand, Reject]] = field(default_factory=deque)
    _decided: Drive | None = None
    _next_s: float = 0.0
    _resume_s: float = 0.0
    _rate_from: tuple[int, float] = (0, 0.0)

    @property
    def params(self) -> SimParams:
        """The dimensions of the world."""
        return self.simulation.params

    def offer(self, command: PageCommand, reject: Reject) -> None:
        """Queues a command, to be carried out before the next tick. Of several `NewSeed`, only the last is.

        Args:
            command: The command.
            reject: Called with a message if the command cannot be carried out.
        """
        if isinstance(command, NewSeed):
            self._commands = deque(other for other in self._commands if not isinstance(other[0], NewSeed))
        if len(self._commands) < COMMANDS_MAX:
            self._commands.append((command, reject))
        else:
            self.refused += 1

    @property
    def start_tick(self) -> int:
        """The first tick since the run was last started over."""
        return next(it.first_tick for it in reversed(self.simulation.record.begun) if it.number == 1)

    def seen(self) -> None:
        """Begins the run if it waits for someone to watch."""
        self.change += self.waits
        self.waits = False

    def close(self) -> None:
        """Ends the run after the current tick."""
        self.closed = True

    def begin(self) -> None:
        """Enters the first environment."""
        self._enter(1)

    async def play(self) -> None:
        """Plays the run after `begin`, until it is done or closed.

        Raises:
            RobotError: A robot has ended or does not answer.
        """
        while not self.closed and (self.stays or not self.done):
            self._execute_all()
            if self.playing and not (self.done or self.waits or self._pauses()):
                self._run_slice()
                await asyncio.sleep(self._spare_s())
            else:
                self._idle()
                await asyncio.sleep(_IDLE_S)
        self._end_episode()
        self.over_s = time.monotonic()

    def _enter(self, number: int) -> None:
        self.simulation.enter(number)
        self.done, self.ended_at = False, None
        self.layout += 1
        self.change += 1

    @property
    def _number(self) -> int:
        """The number of the current environment."""
        return self.simulation.record.begun[-1].number

    @property
    def _is_last(self) -> bool:
        return self._number >= self.simulation.environments

    def _enter_next(self) -> None:
        if self._is_last:
            raise EditError("this is the last environment: start over to see more")
        self._end_episode()
        self._enter(self._number + 1)

    def _end_episode(self) -> None:
        """Ends the environment unless it has already ended."""
        if self.ended_at is None:
            self.ended_at = self.simulation.tick
            self._resume_s = time.monotonic() + PAUSE_S
            self.change += 1
            episode = self.simulation.leave()
            self.episodes.append(episode)
            self.ended(episode)

    def _pauses(self) -> bool:
        """Whether the pause after an environment continues; after it, begins the next environment."""
        if self.ended_at is None:
            return False
        if self.speed != FULL_SPEED and time.monotonic() < self._resume_s:
            return True
        self._enter_next()
        return False

    def _run_slice(self) -> None:
        """Runs the ticks that are due, for at most `_SLICE_S` and until there is a command."""
        began = time.monotonic()
        if began - self._next_s > _LATE_S:
            self.late += self._next_s > 0.0 and self.speed != FULL_SPEED
            self._next_s = began
        now = began
        while now >= self._next_s and now - began < _SLICE_S and self.playing and self.ended_at is None:
            self._run_ticks(now)
            now = time.monotonic()
            if self._commands:
                break
        self._measure(now)

    def _run_ticks(self, now: float) -> None:
        """Runs some of the ticks that are due; one by one where one of them may be the last before a pause."""
        simulation = self.simulation
        first, changes = simulation.tick, simulation.record.edits_tried
        tick_s = 0.0 if self.speed == FULL_SPEED else self.params.tick_s / self.speed
        due = 1 + int((now - self._next_s) / tick_s) if tick_s else simulation.block_ticks
        simulation.step(min(due, simulation.block_ticks) if self._decided is None else 1)
        self._next_s = self._next_s + (simulation.tick - first) * tick_s if tick_s else now
        self.layout += simulation.record.edits_tried - changes
        if self._has_decided(simulation.drives[0]):
            self._pause()
        if simulation.over:
            self._end_episode()
            self.done = self._is_last

    def _has_decided(self, drive: Drive) -> bool:
        """Whether the robot has made the decision at which to pause."""
        before = self._decided
        if before is None or drive.action == before.action:
            return False
        step = _STEPS.get(Reason(drive.reason))
        return step is None or step != _STEPS.get(Reason(before.reason))

    def _spare_s(self) -> float:
        return 0.0 if self.speed == FULL_SPEED else max(0.0, min(_IDLE_S, self._next_s - time.monotonic()))

    def _measure(self, now: float) -> None:
        tick, then = self._rate_from
        if now - then >= _RATE_S:
            self.rate = (self.simulation.tick - tick) / (now - then)
            self._rate_from = self.simulation.tick, now

    def _idle(self) -> None:
        """Discards the reports of robots while the run is paused."""
        self._next_s = self.rate = 0.0
        discard_reports(self.simulation)

    def _pause(self) -> None:
        self.playing, self._decided = False, None
        self.change += 1

    def _execute_all(self) -> None:
        """Carries out waiting commands for at most `_SLICE_S`, so that many of them do not delay the pages."""
        began = time.monotonic()
        while self._commands and time.monotonic() - began < _SLICE_S:
            command, reject = self._commands.popleft()
            try:
                self._execute(command)
            except (EditError, RefusedError) as error:
                reject(str(error))
            self.change += 1

    def _execute(self, command: PageCommand) -> None:
        match command:
            case Play(on):
                self.playing, self._decided = on, None
            case OneDecision():
                self.playing, self._decided = True, self.simulation.drives[0]
            case Speed(factor):
                self._set_speed(factor)
            case NextEnvironment():
                self._enter_next()
            case NewSeed(seed, keep):
                self._start_over(seed, keep)
            case WriteCell() | EraseMemory() | Freeze():
                command_robot(self.simulation, self.recorder, command)
            case _:
                self._edit(command)

    def _set_speed(self, factor: float) -> None:
        if factor != 1.0 and not self.simulation.clients[0].inbox.lockstep:
            raise EditError("the robot has a clock of its own and runs at its own speed")
        self.speed, self._next_s = factor, 0.0

    def _edit(self, command: MoveRobot | Edit) -> None:
        if self.done:
            raise EditError("the run is over: start over to see more")
        if self.ended_at is not None:
            raise EditError("this environment is over: the next one begins in a moment")
        if isinstance(command, MoveRobot):
            command = replace(command.edit, robot=index_of(self.simulation, command.node))
        self.simulation.edit(command)
        self.layout += 1

    def _start_over(self, seed: int, keep: bool) -> None:
        """Starts over. The memory is erased before the start, so that this is not an event of the new run."""
        simulation = self.simulation
        self._end_episode()
        self.started_over = len(self.episodes)
        simulation.seed = seed
        simulation.set_clock()
        if not keep:
            for client in simulation.clients:
                erase_memory(client)
        self.restart(seed)
        for index, client in enumerate(simulation.clients):
            self.recorder.between(index, client.memory, [])
        self._enter(1)
