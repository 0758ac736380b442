"""Takes a run through its environments: as fast as possible, in real time, or at the pace of people who watch."""

import sys
import time
from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import replace
from typing import TYPE_CHECKING

from host_sim.cli.interruption import interrupted_between_ticks
from host_sim.cli.outputs import Outputs
from host_sim.cli.progress_line import ProgressLine
from host_sim.cli.run_options import RunOptions
from host_sim.recording.summary import environment_line
from host_sim.sim.make import start_robots
from host_sim.sim.simulation import Simulation
from host_sim.world.memory_kinds import sides_of

if TYPE_CHECKING:
    from host_sim.live.listener import Listener

_PAUSE_STEP_S = 0.05
_MEMORIES_MAX = 4
_SIGNS = ".LR"
"""The content of a cell: nothing, left or right."""


def open_listener(stack: ExitStack, options: RunOptions) -> "Listener | None":
    """The listener for browsers; None if the run is not watched, or watched in the terminal."""
    if not options.watch or options.terminal:
        return None
    from host_sim.live.listener import Listener  # a run that is not watched begins without the server

    listener = Listener(options.listen, options.port)
    stack.callback(listener.socket.close)
    return listener


def run_through(outputs: Outputs, listener: "Listener | None") -> None:
    """Takes a run through its environments."""
    if outputs.options.watch:
        _show(outputs, listener)
    else:
        _run_unwatched(outputs)


def _run_unwatched(outputs: Outputs) -> None:
    """Runs all environments, as fast as possible or in real time."""
    simulation, talks = outputs.simulation, outputs.options.talks
    with ProgressLine(shown=talks) as progress:
        _say_refused(simulation, progress.clear)
        simulation.watch = each(simulation.watch, _progress_shown(progress))
        with interrupted_between_ticks(simulation):
            for episode in simulation.run():
                outputs.episodes.append(episode)
                if talks:
                    progress.clear()
                    print(environment_line(len(outputs.episodes), episode))
                if outputs.options.real_time and len(outputs.episodes) < simulation.environments:
                    _pause(simulation)


def _progress_shown(line: ProgressLine) -> Callable[[Simulation], object]:
    """Returns a function that shows a run's progress."""
    began = time.monotonic()

    def show(simulation: Simulation) -> None:
        if line.is_due():
            robot_s = simulation.tick * simulation.params.tick_s
            memories = " ".join(
                "".join(_SIGNS[side] for side in sides_of(client.memory))
                for client in simulation.clients[:_MEMORIES_MAX]
            )
            eaten = simulation.arena.food.eaten
            line.show(
                f"environment {simulation.record.begun[-1].number} of {simulation.environments}   "
                f"eaten {sum(eaten)} of {len(eaten)}   memory {memories}   {robot_s:.0f} s   "
                f"{robot_s / (time.monotonic() - began):.0f} x real time"
            )

    return show


def _pause(simulation: Simulation) -> None:
    """Pauses so that people see how an environment ended. Robot time stands still; nothing is logged."""
    from host_sim.live.paced_run import PAUSE_S
    from host_sim.live.robot_orders import discard_reports

    end_s = time.monotonic() + PAUSE_S
    while time.monotonic() < end_s:
        discard_reports(simulation)
        time.sleep(_PAUSE_STEP_S)


def _say_refused(simulation: Simulation, before: Callable[[], object] = lambda: None) -> None:
    """Reports each change that cannot be made, when it is due."""
    said = 0

    def say(simulation: Simulation) -> None:
        nonlocal said
        for refused in simulation.record.refused[said:]:
            said += 1
            before()
            seconds = refused.tick * simulation.params.tick_s
            print(f"octet: at {seconds:.2f} s {refused.what} could not happen: {refused.why}", file=sys.stderr)

    simulation.watch = each(simulation.watch, say)


def each(*watchers: Callable[[Simulation], object]) -> Callable[[Simulation], object]:
    """A function that calls several watchers."""

    def watch(simulation: Simulation) -> None:
        for watcher in watchers:
            watcher(simulation)

    return watch


def _show(outputs: Outputs, listener: "Listener | None") -> None:
    """Runs with people watching: in the browser, or in the terminal if there is no listener."""
    from host_sim.live.paced_run import PacedRun

    simulation, options = outputs.simulation, outputs.options
    live = PacedRun(
        simulation,
        outputs.recorder,
        lambda seed: start_robots(simulation.clients, replace(options, seed=seed)),
        episodes=outputs.episodes,
        stays=options.stays,
        waits=listener is not None and (options.stays or listener.is_open),
        speed=options.speed,
    )
    if listener is None:
        from host_sim.live.terminal_view import watch_in_terminal

        watch_in_terminal(live)
        outputs.cut_short = live.closed
        return
    from host_sim.live.browser import watch_run

    _say_refused(simulation)
    if options.talks:
        live.ended = lambda episode: print(environment_line(simulation.record.begun[-1].number, episode))
    watch_run(live, listener, sys.stdout if options.talks else sys.stderr)
    outputs.cut_short = live.closed
