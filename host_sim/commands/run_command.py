"""`tools/octet run`: a robot, its environments, and what they leave behind."""

import sys
import time
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from pathlib import Path

from host_sim.commands.run_options import RunOptions, WatchOptions
from host_sim.commands.watch_command import watch_run
from host_sim.errors import RefusedError, RobotError, UsageError
from host_sim.kept.keeper import Keeper
from host_sim.kept.memory_file import load_memory, save_memory
from host_sim.kept.picture import draw_run
from host_sim.kept.replay_page import write_page
from host_sim.kept.story import Story
from host_sim.kept.summary import Summary, environment_line, summarize
from host_sim.kept.trajectory import Trajectory
from host_sim.live.live_run import BOREDOM_LIMIT, LiveRun
from host_sim.live.live_server import Door
from host_sim.live.progress import Progress
from host_sim.live.terminal_view import watch_in_terminal
from host_sim.robots.connection import connect
from host_sim.wire.lockstep import Lockstep, Pace, RealTime
from host_sim.wire.protocol import Protocol
from host_sim.wire.record import Recorder
from host_sim.wire.session import Session
from host_sim.world.arena import Arena
from host_sim.world.environment import World
from host_sim.world.simulation import Chapter, Simulation
from host_sim.world.world_file import world_path

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
        door = _open_door(stack, options.watch)
        recorder = Recorder(options.out / LOG)
        stack.callback(recorder.close)
        session = _open_session(stack, options, recorder)
        _start(session, options, memory)
        began = time.monotonic()
        chapters, trajectory = _simulate(session, options, door)
        session.stop()
        wall_s = time.monotonic() - began
        log_sha256 = recorder.close()
    summary = summarize(options, session, chapters, log_sha256, wall_s)
    _leave(options, summary, chapters, trajectory)
    return summary


def _make_folder(path: Path) -> None:
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UsageError(f"cannot make the folder {path}: {error.strerror}; choose another with --out") from None


def _open_door(stack: ExitStack, watch: WatchOptions | None) -> Door | None:
    if watch is None or watch.terminal:
        return None
    door = Door(watch.listen, watch.port)
    stack.callback(door.socket.close)
    return door


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
        session.greet(_EXTERNAL_S, again_s=_AGAIN_S)
    else:
        session.greet(_SPAWNED_S)
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


def _simulate(session: Session, options: RunOptions, door: Door | None) -> tuple[list[Chapter], Trajectory]:
    world = World()
    pace: Pace = RealTime(session, world.tick_s) if options.real_time else Lockstep(session)
    simulation = Simulation(world, session, pace, options.seed, options.environments, options.limit_s)
    keeper = Keeper(simulation, options.settings.get("boredom_limit", BOREDOM_LIMIT))
    simulation.watch = keeper
    try:
        if options.watch is None:
            return _race(simulation, options), keeper.trajectory
        return _show(simulation, options, keeper.story, door), keeper.trajectory
    finally:
        simulation.record.write(world_path(options.out / LOG))


def _race(simulation: Simulation, options: RunOptions) -> list[Chapter]:
    progress = Progress(simulation.session, options.environments, simulation.world.tick_s)
    if options.talks:
        simulation.watch = _each(simulation.watch, progress)
    chapters: list[Chapter] = []
    try:
        for chapter in simulation.run():
            chapters.append(chapter)
            if options.talks:
                progress.clear()
                print(environment_line(len(chapters), chapter))
    except RobotError:
        progress.clear()
        raise
    return chapters


def _each(*watchers: Callable[[int, Arena], object]) -> Callable[[int, Arena], object]:
    """One watcher that calls several."""

    def watch(number: int, arena: Arena) -> None:
        for watcher in watchers:
            watcher(number, arena)

    return watch


def _show(simulation: Simulation, options: RunOptions, story: Story, door: Door | None) -> list[Chapter]:
    """Lets people watch and meddle: in a browser, or without a door in the terminal."""
    assert options.watch is not None
    profile = simulation.session.protocol.choices("COMMAND", "profile")[options.profile]
    live = LiveRun(
        simulation,
        story,
        lambda seed: simulation.session.start(seed, profile, options.settings, None),
        stays=options.watch.stays,
        speed=options.watch.speed,
        boredom_limit=options.settings.get("boredom_limit", BOREDOM_LIMIT),
    )
    if door is None:
        watch_in_terminal(live)
        return live.chapters
    if options.talks:
        live.ended = lambda chapter: print(environment_line(len(live.chapters), chapter))
    watch_run(live, door, lambda line: print(line, file=sys.stdout if options.talks else sys.stderr, flush=True))
    return live.chapters


def _leave(options: RunOptions, summary: Summary, chapters: Sequence[Chapter], trajectory: Trajectory) -> None:
    """Writes and prints what is left of a run."""
    summary.write(options.out / SUMMARY)
    draw_run(options.out / PICTURE, World(), chapters, summary.memory)
    if trajectory.ticks:
        write_page(options.out / PAGE, trajectory, f"seed {options.seed}")
    if options.memory is not None:
        save_memory(options.memory, summary.memory)
    if options.json:
        sys.stdout.write(summary.to_json())
    elif options.talks:
        print(summary.for_people())
        print(f"left      {', '.join(str(options.out / name) for name in (PAGE, PICTURE, SUMMARY, LOG))}")
