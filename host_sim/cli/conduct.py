"""Conducts a run from its start to its output files."""

import argparse
import sys
import time
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path

from host_sim.cli.run_options import RunOptions, WatchOptions, run_options
from host_sim.client.commands import stop
from host_sim.client.frame_log import FrameLog
from host_sim.client.robot_client import RobotClient
from host_sim.errors import RobotError
from host_sim.live.browser import watch_run
from host_sim.live.paced_run import PacedRun
from host_sim.live.progress import Progress
from host_sim.live.server import Listener
from host_sim.live.terminal_view import watch_in_terminal
from host_sim.protocol.generated import CELL_COUNT, PARAMETERS
from host_sim.recording.memory_file import MemorySaver, load_memory, memory_path
from host_sim.recording.run_folder import run_folder
from host_sim.recording.run_recorder import RunRecorder
from host_sim.recording.summary import Summary, environment_line, summarize
from host_sim.recording.trajectory import Trajectory
from host_sim.recording.world_file import world_path, write_world
from host_sim.report.picture import write_picture
from host_sim.report.replay_page import write_page
from host_sim.sim.make import Memory, make, start_robots
from host_sim.sim.simulation import EpisodeResult, Simulation

LOG, SUMMARY, PICTURE, PAGE = "run.log", "summary.json", "arena.png", "replay.html"
"""The files in a run's output folder."""

_NOTHING = (0,) * CELL_COUNT


def conduct_watched(arguments: argparse.Namespace, watch: WatchOptions) -> Summary:
    """Conducts a run that people watch.

    The page sets the pace, so the robot waits for it (lockstep). `--bus auto` means `fd` here: in a network namespace
    with its own bus, no browser could reach the page.
    """
    options = run_options(arguments, "fd" if arguments.bus == "auto" else arguments.bus, watch)
    return conduct(replace(options, config=replace(options.config, real_time=False)))


def conduct(options: RunOptions) -> Summary:
    """Conducts a run and writes log, world file, summary, picture and page to its folder.

    Raises:
        UsageError: The options are invalid; nothing was changed.
        OctetError: The run could not continue; its log up to there was written.
    """
    loaded = [load_memory(path) for path in _memory_paths(options)]
    with run_folder(options.out):
        with ExitStack() as stack:
            listener = _open_listener(stack, options.watch)
            log = FrameLog(options.out / LOG)
            stack.callback(log.close)
            memories = _first_memories(options, loaded)
            simulation = stack.enter_context(
                make(options.config, log, memories, lambda client: _print_robot(options, client))
            )
            recorder = RunRecorder.of(simulation, _boredom_limit(options))
            _save_memories(stack, simulation, options, loaded)
            began = time.monotonic()
            episodes = _simulate(simulation, recorder, options, listener)
            for client in simulation.clients:
                stop(client)
            wall_s = time.monotonic() - began
            log_sha256 = log.close()
        summary = summarize(options.config, simulation.clients, episodes, log_sha256, wall_s)
        _write_outputs(options, summary, recorder.trajectory)
    return summary


def _print_robot(options: RunOptions, client: RobotClient) -> None:
    if options.talks:
        config = options.config
        print(f"robot     node {client.node} on {client.bus}, profile {config.profile}, seed {config.seed}")


def _boredom_limit(options: RunOptions) -> int:
    return options.config.settings.get("boredom_limit", PARAMETERS["boredom_limit"].default)


def _first_memories(options: RunOptions, loaded: Sequence[Memory | None]) -> list[Memory | None]:
    """Each robot's memory at its start, from its file.

    Where the file does not exist yet: a robot that is started here has an empty memory; that of an external one is
    erased.
    """
    missing = _NOTHING if options.config.robot == "external" else None
    return [memory or missing for memory in loaded]


def _save_memories(
    stack: ExitStack, simulation: Simulation, options: RunOptions, loaded: Sequence[Memory | None]
) -> None:
    """Saves each memory as soon as it has changed, and once more when the run ends, however it does."""
    savers = [
        MemorySaver(path, memory, lambda line: print(f"octet: {line}", file=sys.stderr))
        for path, memory in zip(_memory_paths(options), loaded, strict=True)
    ]
    if not savers:
        return

    def save(simulation: Simulation) -> None:
        for saver, client in zip(savers, simulation.clients, strict=True):
            saver.save(client.memory)

    stack.callback(save, simulation)
    simulation.watch = _each(simulation.watch, save)


def _memory_paths(options: RunOptions) -> list[Path]:
    config = options.config
    return (
        [] if options.memory is None else [memory_path(options.memory, node, config.robots) for node in config.nodes]
    )


def _open_listener(stack: ExitStack, watch: WatchOptions | None) -> Listener | None:
    if watch is None or watch.terminal:
        return None
    listener = Listener(watch.listen, watch.port)
    stack.callback(listener.socket.close)
    return listener


def _simulate(
    simulation: Simulation, recorder: RunRecorder, options: RunOptions, listener: Listener | None
) -> Sequence[EpisodeResult]:
    try:
        if options.watch is None:
            return _run_through(simulation, options)
        return _show(simulation, recorder, options, listener)
    finally:
        write_world(simulation.record, world_path(options.out / LOG))


def _run_through(simulation: Simulation, options: RunOptions) -> list[EpisodeResult]:
    """Runs all environments, as fast as possible or in real time."""
    progress = Progress()
    if options.talks:
        simulation.watch = _each(simulation.watch, progress)
    episodes: list[EpisodeResult] = []
    try:
        for episode in simulation.run():
            episodes.append(episode)
            if options.talks:
                progress.clear()
                print(environment_line(len(episodes), episode))
    except RobotError:
        progress.clear()
        raise
    return episodes


def _each(*watchers: Callable[[Simulation], object]) -> Callable[[Simulation], object]:
    """A function that calls several watchers."""

    def watch(simulation: Simulation) -> None:
        for watcher in watchers:
            watcher(simulation)

    return watch


def _show(
    simulation: Simulation, recorder: RunRecorder, options: RunOptions, listener: Listener | None
) -> Sequence[EpisodeResult]:
    """Runs with people watching: in the browser, or in the terminal if there is no listener."""
    assert options.watch is not None
    live = PacedRun(
        simulation,
        recorder,
        lambda seed: start_robots(simulation.clients, replace(options.config, seed=seed)),
        stays=options.watch.stays,
        waits=options.watch.stays and listener is not None,
        speed=options.watch.speed,
    )
    if listener is None:
        watch_in_terminal(live)
        return live.episodes
    if options.talks:
        live.ended = lambda episode: print(environment_line(len(live.episodes), episode))
    watch_run(live, listener, lambda line: print(line, file=sys.stdout if options.talks else sys.stderr, flush=True))
    return live.episodes


def _write_outputs(options: RunOptions, summary: Summary, trajectory: Trajectory) -> None:
    """Writes and prints the results of a run."""
    summary.write(options.out / SUMMARY)
    if trajectory.ticks:
        write_picture(options.out / PICTURE, trajectory)
        write_page(options.out / PAGE, trajectory, f"seed {options.config.seed}")
    if options.json:
        sys.stdout.write(summary.to_json())
    elif options.talks:
        print(summary.for_people())
        print(f"wrote     {', '.join(str(options.out / name) for name in (PAGE, PICTURE, SUMMARY, LOG))}")
