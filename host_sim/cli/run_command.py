"""`tools/octet run`: a robot, its environments, and what they leave behind."""

import sys
import time
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from pathlib import Path

from host_sim.backends.connection import connect
from host_sim.cli.run_options import RunOptions, WatchOptions
from host_sim.cli.watch_command import watch_run
from host_sim.client.frame_log import Recorder
from host_sim.client.pacing import Lockstep, Pace, RealTime
from host_sim.client.session import Session
from host_sim.errors import RefusedError, RobotError, UsageError
from host_sim.live.paced_run import BOREDOM_LIMIT, PacedRun
from host_sim.live.progress import Progress
from host_sim.live.server import Listener
from host_sim.live.terminal_view import watch_in_terminal
from host_sim.protocol.codec import Protocol
from host_sim.recording.memory_file import load_memory, save_memory
from host_sim.recording.run_recorder import RunRecorder
from host_sim.recording.summary import Summary, environment_line, summarize
from host_sim.recording.trajectory import Trajectory
from host_sim.recording.world_file import world_path, write_world
from host_sim.report.picture import draw_run
from host_sim.report.replay_page import write_page
from host_sim.sim.simulation import EpisodeResult, Simulation
from host_sim.view.history import LearningHistory
from host_sim.world.arena import Arena
from host_sim.world.params import SimParams

LOG, SUMMARY, PICTURE, PAGE = "run.log", "summary.json", "arena.png", "replay.html"
"""What a run leaves in its output folder."""

_SPAWNED_S, _EXTERNAL_S, _AGAIN_S = 5.0, 15.0, 0.5
_NOTHING = (0,) * 8


def run(options: RunOptions) -> Summary:
    """Does a run and leaves log, world file, summary, picture and page in its folder.

    Raises:
        UsageError: The options cannot be meant; nothing was changed.
        OctetError: The run could not go on; the log up to there is kept.
    """
    memory = None if options.memory is None else load_memory(options.memory)
    _make_folder(options.out)
    with ExitStack() as stack:
        listener = _open_listener(stack, options.watch)
        recorder = Recorder(options.out / LOG)
        stack.callback(recorder.close)
        session = _open_session(stack, options, recorder)
        _start(session, options, memory)
        began = time.monotonic()
        episodes, trajectory = _simulate(session, options, listener)
        session.stop()
        wall_s = time.monotonic() - began
        log_sha256 = recorder.close()
    summary = summarize(options, session, episodes, log_sha256, wall_s)
    _write_outputs(options, summary, episodes, trajectory)
    return summary


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


def _open_session(stack: ExitStack, options: RunOptions, recorder: Recorder) -> Session:
    connection = connect(stack, options.bus, options.robot, options.node, board=options.board)
    session = Session(
        connection.link,
        Protocol(options.node),
        recorder,
        lockstep=not options.real_time,
        status=connection.status,
        bus=connection.bus,
    )
    if options.robot == "external":
        session.handshake(_EXTERNAL_S, again_s=_AGAIN_S)
    else:
        session.handshake(_SPAWNED_S)
    if options.talks:
        print(f"robot     node {options.node} on {session.bus}, profile {options.profile}, seed {options.seed}")
    return session


def _start(session: Session, options: RunOptions, memory: Sequence[int] | None) -> None:
    if memory is None and options.memory is not None:
        memory = _NOTHING  # a file that is not there yet: begin with what it will be saved over
    profile = session.protocol.choices("COMMAND", "profile")[options.profile]
    try:
        session.start(options.seed, profile, options.settings, memory)
    except RefusedError as refused:
        raise UsageError(f"{refused}; give values within the robot's range") from refused


def _simulate(
    session: Session, options: RunOptions, listener: Listener | None
) -> tuple[list[EpisodeResult], Trajectory]:
    params = SimParams()
    pace: Pace = RealTime(session, params.tick_s) if options.real_time else Lockstep(session)
    simulation = Simulation(params, session, pace, options.seed, options.environments, options.limit_s)
    run_recorder = RunRecorder(simulation, options.settings.get("boredom_limit", BOREDOM_LIMIT))
    simulation.watch = run_recorder
    try:
        if options.watch is None:
            return _race(simulation, options), run_recorder.trajectory
        return _show(simulation, options, run_recorder.history, listener), run_recorder.trajectory
    finally:
        write_world(simulation.record, world_path(options.out / LOG))


def _race(simulation: Simulation, options: RunOptions) -> list[EpisodeResult]:
    progress = Progress(simulation.session, options.environments, simulation.params.tick_s)
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


def _each(*watchers: Callable[[int, Arena], object]) -> Callable[[int, Arena], object]:
    """One watcher that calls several."""

    def watch(number: int, arena: Arena) -> None:
        for watcher in watchers:
            watcher(number, arena)

    return watch


def _show(
    simulation: Simulation, options: RunOptions, history: LearningHistory, listener: Listener | None
) -> list[EpisodeResult]:
    """Lets people watch and meddle: in a browser, or without a door in the terminal."""
    assert options.watch is not None
    profile = simulation.session.protocol.choices("COMMAND", "profile")[options.profile]
    live = PacedRun(
        simulation,
        history,
        lambda seed: simulation.session.start(seed, profile, options.settings, None),
        stays=options.watch.stays,
        speed=options.watch.speed,
        boredom_limit=options.settings.get("boredom_limit", BOREDOM_LIMIT),
    )
    if listener is None:
        watch_in_terminal(live)
        return live.episodes
    if options.talks:
        live.ended = lambda episode: print(environment_line(len(live.episodes), episode))
    watch_run(live, listener, lambda line: print(line, file=sys.stdout if options.talks else sys.stderr, flush=True))
    return live.episodes


def _write_outputs(
    options: RunOptions, summary: Summary, episodes: Sequence[EpisodeResult], trajectory: Trajectory
) -> None:
    """Writes and prints what is left of a run."""
    summary.write(options.out / SUMMARY)
    draw_run(options.out / PICTURE, SimParams(), episodes, summary.memory)
    if trajectory.ticks:
        write_page(options.out / PAGE, trajectory, f"seed {options.seed}")
    if options.memory is not None:
        save_memory(options.memory, summary.memory)
    if options.json:
        sys.stdout.write(summary.to_json())
    elif options.talks:
        print(summary.for_people())
        print(f"left      {', '.join(str(options.out / name) for name in (PAGE, PICTURE, SUMMARY, LOG))}")
