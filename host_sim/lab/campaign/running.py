"""Runs cells: injects their faults, and notes how each run ends."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from concurrent.futures import BrokenExecutor
from contextlib import ExitStack
from dataclasses import replace
from functools import partial
from pathlib import Path

from host_sim.base.errors import OctetError, RobotError, UsageError
from host_sim.client.commands import stop
from host_sim.client.robot_client import RobotClient
from host_sim.lab.campaign.cell import KILL_EVENTS, Cell, Outcome
from host_sim.lab.campaign.host_events import ASK, CLOCK_EVENTS, Report, Trigger, clock_events, run_killable
from host_sim.lab.campaign.run_files import FILE_EVENTS, RunFiles, is_memory_held, make_folder
from host_sim.lab.campaign.setups import Setup, check_events, open_setup
from host_sim.lab.workers import processes
from host_sim.protocol.generated import TICK_SPAN, Side
from host_sim.sim.make import make
from host_sim.sim.simulation import Simulation
from host_sim.transport.faulty_link import FaultyLink
from host_sim.transport.rule import Event
from host_sim.world.memory_kinds import sides_of

_CORRECT_SIDES = {1: Side.LEFT, 3: Side.LEFT, 4: Side.RIGHT, 6: Side.RIGHT}
_REFUSAL_COUNTERS = ("stale", "damaged", "foreign", "refused")
_REPEATED_MAX = 10
"""A waiting robot in lockstep sends signs of life: this many extra frames do not indicate a fault."""


def run_all(cells: Sequence[Cell], jobs: int = 1) -> Iterator[Outcome]:
    """Runs cells, comparing each with the same run without a fault, which is run only once.

    Args:
        cells: The cells.
        jobs: Number of processes; with 1, all run in this one.

    Yields:
        The outcome of each cell, in this order.

    Raises:
        OctetError: One of the processes died.
    """
    clean: dict[Cell, Outcome] = {}
    with ExitStack() as stack:
        outcomes = map(run_cell, _runs(cells)) if jobs == 1 else _run_in_parallel(list(_runs(cells)), jobs, stack)
        for cell in cells:
            if cell.without_fault not in clean:
                clean[cell.without_fault] = next(outcomes)
            without = clean[cell.without_fault]
            outcome = next(outcomes) if cell.items else without
            outcome.compare(without)
            yield outcome


def run_one(cell: Cell) -> Outcome:
    """As `run_all`, for one cell."""
    (outcome,) = run_all([cell])
    return outcome


def _runs(cells: Iterable[Cell]) -> Iterator[Cell]:
    """Yields each cell with a fault, and before the first of a configuration the run without one."""
    seen: set[Cell] = set()
    for cell in cells:
        if cell.without_fault not in seen:
            seen.add(cell.without_fault)
            yield cell.without_fault
        if cell.items:
            yield cell


def _run_in_parallel(runs: Sequence[Cell], jobs: int, stack: ExitStack) -> Iterator[Outcome]:
    """Runs cells in processes, which end with the stack: a run mostly waits for a robot that does not answer."""
    pool = stack.enter_context(processes(min(jobs, len(runs))).open())
    stack.callback(pool.shutdown, cancel_futures=True)
    try:
        yield from pool.map(run_cell, runs)
    except BrokenExecutor:
        raise OctetError("a process of the campaign was killed; try fewer --jobs") from None


def run_cell(cell: Cell) -> Outcome:
    """Runs one cell.

    Raises:
        UsageError: There is no such link, or an event of the cell is impossible there.
    """
    outcome = Outcome(cell, waiting=cell.events)
    try:
        _run_with_setup(outcome)
    except RobotError as error:
        outcome.end, outcome.broke = str(error).partition(";")[0], True
    return outcome


def _run_with_setup(outcome: Outcome) -> None:
    cell, is_killed = outcome.cell, any(event.name in KILL_EVENTS for event in outcome.cell.events)
    with ExitStack() as stack:
        setup = stack.enter_context(open_setup(cell.link, cell.command_of_own))
        folder = make_folder(cell.events, stack)
        check_events({*setup.events, *FILE_EVENTS, *CLOCK_EVENTS}, cell.link, cell.events)
        if is_killed and not _run_killed(outcome, setup, folder):
            return
        setup.settle()
        files = RunFiles(folder, stack)
        files.messages += ["the simulator was killed, and another one went on with its memory"] * is_killed
        try:
            _run(outcome, setup, files, {**setup.events, **files.events, **clock_events(stack)})
        except UsageError:
            raise
        except Exception as error:
            _note_end(outcome, error, files)
        outcome.digest, outcome.course = files.close(), files.log.course
        outcome.lost = outcome.lost or files.lost()


def _run_killed(outcome: Outcome, setup: Setup, folder: Path | None) -> bool:
    """Runs until the simulator is killed. A robot that is not its child waits for the next simulator.

    Returns:
        Whether it was killed.
    """

    def run(report: Report) -> None:
        with ExitStack() as stack:
            files = RunFiles(folder, stack, report)
            remote = {name: partial(report, ASK, name) for name in setup.opener_only}
            _run(outcome, setup, files, {**setup.events, **remote, **files.events, **clock_events(stack)})

    was_killed, reports = run_killable(run, lambda name, size: setup.events[name](size))
    of = {kind: [each[1] for each in reports if each[0] == kind] for kind in ("oldest", "saving", "ended", "broke")}
    outcome.oldest = max(of["oldest"], default=0)
    outcome.end = outcome.seen = next(iter(of["broke"] + of["ended"]), "")
    outcome.lost = "" if is_memory_held(folder, of["saving"]) else "the memory"
    outcome.broke = bool(of["broke"])
    if was_killed:
        outcome.waiting = ()
    return was_killed


def _note_end(outcome: Outcome, error: Exception, files: RunFiles) -> None:
    if isinstance(error, RobotError):
        outcome.end = outcome.seen = str(error).partition(";")[0]
    elif isinstance(error, OctetError) and files.struck:
        outcome.end = outcome.seen = files.without_folder(str(error))
    else:
        outcome.end, outcome.broke = f"{type(error).__name__}: {error}", True


def _run(outcome: Outcome, setup: Setup, files: RunFiles, events: Mapping[str, Trigger]) -> None:
    def ready(client: RobotClient) -> None:
        _note(outcome, client)
        setup.found(client)

    # Host load does not indicate a fault.
    config = replace(setup.configured(outcome.cell.config), late_max=100.0)
    with make(config, files.log, [files.memory], ready) as simulation:
        (client,) = simulation.clients

        def watch(running: Simulation) -> None:
            files.save(client.memory)
            _watch(outcome, events, running)
            files.note("oldest", outcome.oldest)

        simulation.watch, simulation.native = watch, simulation.native and not outcome.waiting
        try:
            for _ in simulation.run():
                stop(client)
            files.finish(client.memory)
        finally:
            _note(outcome, client)
            outcome.seen = ", ".join([*([outcome.seen] if outcome.seen else []), *files.messages])


def _watch(outcome: Outcome, events: Mapping[str, Trigger], simulation: Simulation) -> None:
    """Called after each step: checks the wheels, then triggers the events that are due."""
    (drive,) = simulation.drives
    age = (simulation.tick - 1 - drive.tick) % TICK_SPAN
    outcome.ticks = simulation.tick
    if drive.left_mm_s or drive.right_mm_s:
        outcome.oldest = max(outcome.oldest, age)
    if not age:
        outcome.moved = simulation.tick
    for event in outcome.waiting:
        if event.tick <= simulation.tick:
            outcome.waiting = tuple(other for other in outcome.waiting if other is not event)
            trigger(events, event)


def trigger(events: Mapping[str, Trigger], event: Event) -> None:
    """Triggers an event."""
    events[event.name](event.size)


def _note(outcome: Outcome, client: RobotClient) -> None:
    frames, sides = client.frames, sides_of(client.memory)
    of_line = {
        "repeated": frames.repeated,
        "duplicate": frames.duplicate if frames.duplicate > _REPEATED_MAX else 0,
        "lost": frames.lost,
        "refused": frames.refused,
        "outages": client.connection.line.outages,
    }
    # Line faults due to host load say nothing about the body.
    counts = client.faults if outcome.cell.is_of_body else of_line | client.faults
    outcome.seen = ", ".join(f"{count} {name}" for name, count in counts.items() if count)
    outcome.doubts = tuple(map(str, client.incidents))
    outcome.seen = outcome.seen or ", ".join(outcome.doubts)
    outcome.memory = tuple(client.memory)
    outcome.wrong = tuple(pattern for pattern, side in _CORRECT_SIDES.items() if sides[pattern] not in (0, side))
    robots = sum(client.faults.get(kind, 0) for kind in _REFUSAL_COUNTERS)
    outcome.refusals = frames.refused + robots
    if isinstance(client.connection.link, FaultyLink):
        outcome.strikes = client.connection.link.schedule.count
        outcome.struck = tuple(map(str, client.connection.link.schedule.struck))
