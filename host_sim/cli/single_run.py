"""A run from its start to its output files: as fast as possible, in real time, or at the speed set by viewers."""

import os
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from host_sim.base.errors import BrainError, DoubtfulError, OctetError, UsageError
from host_sim.base.files import run_folder
from host_sim.base.paths import as_called
from host_sim.base.terminal import ProgressLine
from host_sim.cli.interruption import interrupted_between_ticks, stop_soon
from host_sim.cli.outputs import FILES, PAGE, PICTURE, SUMMARY, Outputs, print_result
from host_sim.cli.own_source import log_words
from host_sim.cli.run_options import RunOptions
from host_sim.client.commands import stop
from host_sim.client.frame_log import FrameLog
from host_sim.client.robot_client import RobotClient
from host_sim.protocol.generated import CELL_COUNT
from host_sim.recording.memory_file import MemorySaver, check_writable, load_memory, memory_lock, memory_path
from host_sim.recording.run_recorder import RunRecorder
from host_sim.recording.summary import Summary, environment_line
from host_sim.recording.world_file import world_path
from host_sim.sim.make import Memory, make, start_robots
from host_sim.sim.simulation import Simulation
from host_sim.world.memory_kinds import sides_of

if TYPE_CHECKING:
    from host_sim.live.listener import Listener

_PAUSE_STEP_S = 0.05
_MEMORIES_MAX = 4
_WHERE = {"fd": "on a socket pair", "none": "in this process"}
_CELL_LETTERS = ".LR"
"""The content of a cell: nothing, left or right."""


def open_listener(stack: ExitStack, options: RunOptions) -> "Listener | None":
    """The listener for browsers; None if the run is not watched, or watched in the terminal."""
    if not options.watch or options.terminal:
        return None
    from host_sim.live.listener import Listener  # a run that is not watched begins without the server

    listener = Listener(options.listen, options.port)
    stack.callback(listener.socket.close)
    return listener


def run_loop(outputs: Outputs, listener: "Listener | None") -> None:
    """Runs all environments of a run, watched or unwatched."""
    if outputs.options.watch:
        _show(outputs, listener)
    else:
        _run_unwatched(outputs)


def _run_unwatched(outputs: Outputs) -> None:
    """Runs all environments, as fast as possible or in real time."""
    simulation, verbose = outputs.simulation, outputs.options.verbose
    with ProgressLine(shown=verbose) as progress:
        _print_refused(simulation, progress.clear)
        simulation.watch = each(simulation.watch, _progress_shown(progress))
        with interrupted_between_ticks(simulation):
            for episode in simulation.run():
                outputs.episodes.append(episode)
                if verbose:
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
                "".join(_CELL_LETTERS[side] for side in sides_of(client.memory))
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


def _print_refused(simulation: Simulation, before: Callable[[], object] = lambda: None) -> None:
    """Reports each change that cannot be made, when it is due."""
    printed = 0

    def print_new(simulation: Simulation) -> None:
        nonlocal printed
        for refused in simulation.record.refused[printed:]:
            printed += 1
            before()
            seconds = refused.tick * simulation.params.tick_s
            print(f"octet: at {seconds:.2f} s {refused.what} could not happen: {refused.why}", file=sys.stderr)

    simulation.watch = each(simulation.watch, print_new)


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
    from host_sim.live.server import LiveServer
    from host_sim.report.octet_page import live_page

    _print_refused(simulation)
    if options.verbose:
        live.ended = lambda episode: print(environment_line(simulation.record.begun[-1].number, episode))
    server = LiveServer(live, listener, live_page(options.profile, options.robot_settings), outputs.recording)
    watch_run(live, server, sys.stdout if options.verbose else sys.stderr)
    outputs.cut_short, outputs.over_s = live.closed, live.over_s


_NOTHING = (0,) * CELL_COUNT


def run_single(options: RunOptions) -> None:
    """Runs all environments, and writes log, world file, summary, picture and page, however the run ends.

    Raises:
        UsageError: The options are invalid; nothing was changed.
        OctetError: The run could not continue; what was recorded up to there was written.
    """
    options.read_files()
    with _memories(options) as loaded, run_folder(options.out):
        _print_empty_memories(options, loaded)
        with ExitStack() as stack:
            listener = open_listener(stack, options)
            log = FrameLog(options.log)
            stack.callback(log.drop)
            memories = _first_memories(options, loaded)
            simulation = stack.enter_context(
                make(options, log, memories, lambda client: _print_robot(options, client))
            )
            recorder = RunRecorder.of(simulation, options.boredom_limit)
            _save_memories(stack, simulation, options, loaded)
            outputs = Outputs(options, simulation, recorder, log)
            try:
                run_loop(outputs, listener)
                _stop(outputs)
                _print_programs(options, simulation)
            except BaseException as end:
                _write_partial_run(outputs, end)
                raise
            if not outputs.has_begun_or_is_first:
                return
            summary = outputs.write()
    print_result(options, summary, (*(options.out / name for name in (PAGE, PICTURE, SUMMARY)), options.log))
    _check_incidents(summary)


def _print_programs(options: RunOptions, simulation: Simulation) -> None:
    for client in simulation.clients if options.source and options.verbose else ():
        with suppress(OctetError):  # the robot has ended, which was reported
            _, stopped, told = client.connection.status().partition("the program: ")
            if options.program:
                print(f"program   {options.profile}: {told if stopped else 'still running at the end of the run'}")
            for line in client.connection.printed().splitlines():
                print(f"printed   {line}")


def _stop(outputs: Outputs) -> None:
    if outputs.cut_short:
        stop_soon(outputs.simulation.clients)
        return
    for client in outputs.simulation.clients:
        stop(client)


@contextmanager
def _memories(options: RunOptions) -> Iterator[list[Memory | None]]:
    """Loads the memory files and locks them until the run has ended."""
    paths = _memory_paths(options)
    with ExitStack() as locks:
        for path in paths:
            _check_no_output(path, options)
            check_writable(path)
            locks.enter_context(memory_lock(path))
        yield [load_memory(path) for path in paths]


def _check_no_output(memory: Path, options: RunOptions) -> None:
    """Refuses a memory file that the run would overwrite."""
    outputs = [options.out / name for name in FILES] + [world_path(options.log)]
    # Not Path.resolve: that fails for a link to itself.
    if os.path.realpath(memory) in map(os.path.realpath, outputs):
        raise UsageError(f"the run would overwrite {memory}: choose another file with --memory")


def _print_empty_memories(options: RunOptions, loaded: Sequence[Memory | None]) -> None:
    """Prints which memories start empty."""
    if not options.verbose:
        return
    for path, memory in zip(_memory_paths(options), loaded, strict=True):
        if memory is None:
            print(f"memory    {path} does not exist yet: the robot begins with an empty memory")


def _write_partial_run(outputs: Outputs, end: BaseException) -> None:
    """Writes the files of a run that ended early. Further errors are suppressed in favour of `end`."""
    with suppress(OctetError):
        if isinstance(end, KeyboardInterrupt):
            stop_soon(outputs.simulation.clients)
    if not outputs.has_begun_or_is_first:
        return
    with suppress(OctetError):
        outputs.write()
        if isinstance(end, BrainError):
            end.args = (f"{end}{_debugger(outputs.options, end)}",)
        if isinstance(end, KeyboardInterrupt):
            end.args = ("the log so far was written",)  # `main` prints it


def _debugger(options: RunOptions, mistake: BrainError) -> str:
    """A line with the command that opens the debugger at the tick of a mistake; empty if it has no tick."""
    if mistake.tick is None:
        return ""
    words = log_words(options.log, options.profile)
    return as_called(f"\n  debugger  tools/octet debug {words} --node {mistake.node} --tick {mistake.tick}")


def _check_incidents(summary: Summary) -> None:
    if incidents := summary.content["incidents"]:
        first, *more = incidents
        others = f" (and {len(more)} more in {SUMMARY})" if more else ""
        raise DoubtfulError(f"result unreliable: {first}{others}")


def _print_robot(options: RunOptions, client: RobotClient) -> None:
    if options.verbose:
        bus = _WHERE.get(client.connection.bus, f"on {client.connection.bus}")
        print(f"robot     {client.node} {bus}, profile {options.profile}, seed {options.seed}")


def _first_memories(options: RunOptions, loaded: Sequence[Memory | None]) -> list[Memory | None]:
    """Each robot's memory at its start, from its file.

    If the file does not exist yet, a robot started here begins with an empty memory, and an external one is erased.
    """
    missing = _NOTHING if options.robot == "external" else None
    return [memory or missing for memory in loaded]


def _save_memories(
    stack: ExitStack, simulation: Simulation, options: RunOptions, loaded: Sequence[Memory | None]
) -> None:
    """Saves each memory as soon as it has changed, and again at the end of the run, however it ends."""
    savers = [
        MemorySaver(path, memory, lambda line: print(f"octet: {line}", file=sys.stderr))
        for path, memory in zip(_memory_paths(options), loaded, strict=True)
    ]
    if not savers:
        return

    def save(how: Callable[..., None]) -> None:
        for saver, client in zip(savers, simulation.clients, strict=True):
            how(saver, client.memory, doubtful=bool(client.incidents))

    stack.callback(save, MemorySaver.finish)
    simulation.watch = each(simulation.watch, lambda _: save(MemorySaver.save))


def _memory_paths(options: RunOptions) -> list[Path]:
    memory = options.memory
    return [] if memory is None else [memory_path(memory, node, options.robots) for node in options.nodes]
