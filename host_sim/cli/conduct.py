"""Conducts a run from its start to the files that it leaves behind."""

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
from host_sim.errors import RobotError, UsageError
from host_sim.live.browser import watch_run
from host_sim.live.paced_run import PacedRun
from host_sim.live.progress import Progress
from host_sim.live.server import Listener
from host_sim.live.terminal_view import watch_in_terminal
from host_sim.protocol.generated import CELL_COUNT, PARAMETERS
from host_sim.recording.memory_file import load_memory, memory_path, save_memory
from host_sim.recording.run_recorder import RunRecorder
from host_sim.recording.summary import Summary, environment_line, summarize
from host_sim.recording.trajectory import Trajectory
from host_sim.recording.world_file import world_path, write_world
from host_sim.report.picture import write_picture
from host_sim.report.replay_page import write_page
from host_sim.sim.make import Memory, make, start_robots
from host_sim.sim.simulation import EpisodeResult, Simulation

LOG, SUMMARY, PICTURE, PAGE = "run.log", "summary.json", "arena.png", "replay.html"
"""What a run leaves in its output folder."""

_NOTHING = (0,) * CELL_COUNT


def conduct_watched(arguments: argparse.Namespace, watch: WatchOptions) -> Summary:
    """Conducts a run that people watch.

    The page keeps the time, so the robot waits for it; a bus in a network of its own would hide the page.
    """
    options = run_options(arguments, "fd" if arguments.bus == "auto" else arguments.bus, watch)
    return conduct(replace(options, config=replace(options.config, real_time=False)))


def conduct(options: RunOptions) -> Summary:
    """Does a run and leaves log, world file, summary, picture and page in its folder.

    Raises:
        UsageError: The options cannot be meant; nothing was changed.
        OctetError: The run could not go on; the log up to there is kept.
    """
    memories = _memories(options)
    _make_folder(options.out)
    with ExitStack() as stack:
        listener = _open_listener(stack, options.watch)
        log = FrameLog(options.out / LOG)
        stack.callback(log.close)
        simulation = stack.enter_context(make(options.config, log, memories, lambda it: _tell(options, it)))
        recorder = RunRecorder.of(simulation, _boredom_limit(options))
        began = time.monotonic()
        episodes = _simulate(simulation, recorder, options, listener)
        for client in simulation.clients:
            stop(client)
        wall_s = time.monotonic() - began
        log_sha256 = log.close()
    summary = summarize(options.config, simulation.clients, episodes, log_sha256, wall_s)
    _write_outputs(options, summary, recorder.trajectory)
    return summary


def _tell(options: RunOptions, client: RobotClient) -> None:
    if options.talks:
        config = options.config
        print(f"robot     node {client.node} on {client.bus}, profile {config.profile}, seed {config.seed}")


def _boredom_limit(options: RunOptions) -> int:
    return options.config.settings.get("boredom_limit", PARAMETERS["boredom_limit"].default)


def _memories(options: RunOptions) -> list[Memory | None]:
    """What each robot is to begin with.

    A robot that we start has nothing learned yet where there is no file; an external one is told so.
    """
    missing = _NOTHING if options.config.robot == "external" else None
    return [load_memory(path) or missing for path in _memory_paths(options)]


def _memory_paths(options: RunOptions) -> list[Path]:
    config = options.config
    return (
        [] if options.memory is None else [memory_path(options.memory, node, config.robots) for node in config.nodes]
    )


def _make_folder(path: Path) -> None:
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UsageError(f"cannot make the folder {path}: {error.strerror}; choose another with --out") from None


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
    """As fast as it goes, or as real time does."""
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
    """One watcher that calls several."""

    def watch(simulation: Simulation) -> None:
        for watcher in watchers:
            watcher(simulation)

    return watch


def _show(
    simulation: Simulation, recorder: RunRecorder, options: RunOptions, listener: Listener | None
) -> Sequence[EpisodeResult]:
    """Lets people watch and interfere: in a browser, or without a listener in the terminal."""
    assert options.watch is not None
    live = PacedRun(
        simulation,
        recorder,
        lambda seed: start_robots(simulation.clients, replace(options.config, seed=seed)),
        stays=options.watch.stays,
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
    """Writes and prints what is left of a run: what was learned first."""
    for path, robot in zip(_memory_paths(options), summary.robots, strict=False):
        save_memory(path, robot["memory"])
    summary.write(options.out / SUMMARY)
    if trajectory.ticks:
        write_picture(options.out / PICTURE, trajectory)
        write_page(options.out / PAGE, trajectory, f"seed {options.config.seed}")
    if options.json:
        sys.stdout.write(summary.to_json())
    elif options.talks:
        print(summary.for_people())
        print(f"wrote     {', '.join(str(options.out / name) for name in (PAGE, PICTURE, SUMMARY, LOG))}")
