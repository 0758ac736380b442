"""A run that people watch and meddle with: paced by the wall's clock, its commands carried out between two ticks."""

import asyncio
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field

from host_sim.client.commands import erase_memory, freeze, write_cells
from host_sim.errors import RefusedError
from host_sim.live.page_commands import (
    FULL_SPEED,
    EraseMemory,
    Freeze,
    LiftRobot,
    NewSeed,
    NextEnvironment,
    OneDecision,
    PageCommand,
    Play,
    PutRobot,
    Speed,
    WriteCell,
)
from host_sim.recording.run_recorder import RunRecorder
from host_sim.sim.simulation import EpisodeResult, Simulation
from host_sim.world.edits import Edit, EditError, Lift, Put
from host_sim.world.params import SimParams

COMMANDS_MAX = 256
"""So many commands may wait for the next tick; more are refused."""

_SLICE_S = 0.008
_IDLE_S = 0.02
_LATE_S = 0.1
_RATE_S = 0.5

Reject = Callable[[str], None]


@dataclass
class PacedRun:
    """Takes a simulation through its run, a few ticks at a time, with the event loop's other work in between.

    Attributes:
        simulation: Not begun yet.
        recorder: Takes the simulation down; we tell it what people do.
        restart: Restarts the robots with another seed.
        ended: Told of each environment that has ended.
        stays: Whether to wait for commands after the last environment rather than end.
        speed: Times real time, or `FULL_SPEED`.
        playing: Whether it goes on.
        done: Whether the last environment is behind it.
        episodes: The environments that have ended.
        layout: Counts the changes of the arena, by a person or with a new environment.
        change: Counts the changes of anything that a page shows while no tick passes.
        rate: Ticks a second, lately.
        late: Ticks that began more than 0.1 s after their time.
        refused: Commands that were none, or too many at once.
    """

    simulation: Simulation
    recorder: RunRecorder
    restart: Callable[[int], None]
    ended: Callable[[EpisodeResult], object] = lambda _: None
    stays: bool = True
    speed: float = 1.0
    playing: bool = True
    done: bool = False
    episodes: list[EpisodeResult] = field(default_factory=list)
    layout: int = 0
    change: int = 0
    rate: float = 0.0
    late: int = 0
    refused: int = 0
    _commands: deque[tuple[PageCommand, Reject]] = field(default_factory=deque)
    _closed: bool = False
    _stop_at_action: int | None = None
    _next_s: float = 0.0
    _rate_from: tuple[int, float] = (0, 0.0)

    @property
    def params(self) -> SimParams:
        """The measures."""
        return self.simulation.params

    def offer(self, command: PageCommand, reject: Reject) -> None:
        """Takes a command, to be carried out before the next tick.

        Args:
            command: What to do.
            reject: Told in words if it cannot be done.
        """
        if len(self._commands) < COMMANDS_MAX:
            self._commands.append((command, reject))
        else:
            self.refused += 1

    def close(self) -> None:
        """Lets the run end with the tick under way."""
        self._closed = True

    def begin(self) -> None:
        """Enters the first environment."""
        self._enter(1)

    async def play(self) -> None:
        """Goes on from `begin` until all is done, or closed.

        Raises:
            RobotError: The robot is gone.
        """
        while not self._closed and (self.stays or not self.done):
            self._execute_all()
            if self.playing and not self.done:
                self._run_slice()
                await asyncio.sleep(self._spare_s())
            else:
                self._idle()
                await asyncio.sleep(_IDLE_S)
        self._end_episode()

    def _enter(self, number: int) -> None:
        self.done = number > self.simulation.environments
        if not self.done:
            self.simulation.enter(number)
            self.layout += 1
            self.change += 1

    def _go_on(self) -> None:
        if not self.done:
            self._end_episode()
            self._enter(self.simulation.record.begun[-1].number + 1)

    def _end_episode(self) -> None:
        if not self.done:
            episode = self.simulation.leave()
            self.episodes.append(episode)
            self.ended(episode)

    def _run_slice(self) -> None:
        """Does the ticks that are due, as long as others can wait."""
        began = time.monotonic()
        if began - self._next_s > _LATE_S:
            self.late += self._next_s > 0.0 and self.speed != FULL_SPEED
            self._next_s = began
        now = began
        while now >= self._next_s and now - began < _SLICE_S and self.playing and not self.done:
            self._tick()
            self._next_s = now if self.speed == FULL_SPEED else self._next_s + self.params.tick_s / self.speed
            now = time.monotonic()
        self._measure(now)

    def _tick(self) -> None:
        simulation = self.simulation
        simulation.step()
        if self._stop_at_action is not None and simulation.drives[0].action != self._stop_at_action:
            self._stand_still()
        if simulation.over:
            self._go_on()

    def _spare_s(self) -> float:
        return 0.0 if self.speed == FULL_SPEED else max(0.0, min(_IDLE_S, self._next_s - time.monotonic()))

    def _measure(self, now: float) -> None:
        tick, then = self._rate_from
        if now - then >= _RATE_S:
            self.rate = (self.simulation.tick - tick) / (now - then)
            self._rate_from = self.simulation.tick, now

    def _idle(self) -> None:
        """A robot in lockstep says that it hears nothing while we pause; that is as it should be, and no news."""
        self._next_s = self.rate = 0.0
        for client in self.simulation.clients:
            while client.link.receive(0.0) is not None:
                pass
            client.status()

    def _stand_still(self) -> None:
        self.playing, self._stop_at_action = False, None
        self.change += 1

    def _execute_all(self) -> None:
        while self._commands:
            command, reject = self._commands.popleft()
            try:
                self._execute(command)
            except (EditError, RefusedError) as error:
                reject(str(error))
            self.change += 1

    def _execute(self, command: PageCommand) -> None:
        match command:
            case Play(on):
                self.playing, self._stop_at_action = on, None
            case OneDecision():
                self.playing, self._stop_at_action = True, self.simulation.drives[0].action
            case Speed(factor):
                self.speed, self._next_s = factor, 0.0
            case NextEnvironment():
                self._go_on()
            case NewSeed(seed):
                self._start_over(seed)
            case WriteCell() | EraseMemory() | Freeze():
                self._command(command)
            case _:
                self._edit(command)

    def _edit(self, command: LiftRobot | PutRobot | Edit) -> None:
        if self.done:
            raise EditError("the run is over: choose a new seed")
        match command:
            case LiftRobot(node):
                self.simulation.edit(Lift(self._index(node)))
            case PutRobot(pose, node):
                self.simulation.edit(Put(pose, self._index(node)))
            case _:
                self.simulation.edit(command)
        self.layout += 1

    def _start_over(self, seed: int) -> None:
        self._end_episode()
        self.simulation.seed = seed
        self.simulation.set_clock()
        self.restart(seed)
        for history in self.recorder.histories:
            history.frozen, history.trial = False, None
        self._enter(1)

    def _command(self, command: WriteCell | EraseMemory | Freeze) -> None:
        """Tells the robot, in its own words: a real one obeys as well."""
        index = self._index(command.node)
        client, history = self.simulation.clients[index], self.recorder.histories[index]
        self.simulation.set_clock()
        match command:
            case WriteCell(cell, side):
                write_cells(client, {cell: side})
            case EraseMemory():
                erase_memory(client)
            case Freeze(on):
                freeze(client, on)
                history.frozen = on
        history.relearn(self.simulation.tick, client.memory)

    def _index(self, node: int | None) -> int:
        """The place of a robot among the robots; None is the first.

        Raises:
            EditError: There is no such robot.
        """
        nodes = self.simulation.nodes
        if node is not None and node not in nodes:
            raise EditError(f"there is no robot {node}; there are {', '.join(map(str, nodes))}")
        return 0 if node is None else nodes.index(node)
