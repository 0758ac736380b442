"""Runs cells: injects their faults, and notes how each run ends."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import NamedTuple

from host_sim.base.errors import OctetError, RobotError, UsageError
from host_sim.client.commands import stop
from host_sim.client.robot_client import RobotClient
from host_sim.lab.campaign.cell import KILL_EVENTS, Cell
from host_sim.lab.campaign.host_events import CLOCK_EVENTS, clock_events
from host_sim.lab.campaign.killed import ASK, Tell, run_to_be_killed
from host_sim.lab.campaign.links import check_events, open_setup
from host_sim.lab.campaign.outcome import Outcome
from host_sim.lab.campaign.run_files import FILE_EVENTS, NoFiles, is_memory_held, make_folder, open_files
from host_sim.lab.campaign.setup import Happen, Setup
from host_sim.protocol.generated import TICK_SPAN, Side
from host_sim.sim.make import make
from host_sim.sim.simulation import Simulation
from host_sim.transport.faulty_link import FaultyLink
from host_sim.transport.rule import Event
from host_sim.world.memory_kinds import sides_of

_PROPER = {1: Side.LEFT, 3: Side.LEFT, 4: Side.RIGHT, 6: Side.RIGHT}
_REFUSING = ("stale", "damaged", "foreign", "refused")
_SIGNS_MAX = 10
"""A waiting robot in lockstep sends signs of life: this many extra frames do not indicate a fault."""


class Group(NamedTuple):
    """The cells of one configuration; the first has no fault."""

    number: int
    cells: Sequence[Cell]

    def __str__(self) -> str:
        return str(self.cells[0])


def run_group(groups: Sequence[Group]) -> tuple[int, list[Outcome]]:
    """The number of the only group, and the outcomes of its cells."""
    (group,) = groups
    return group.number, list(run_all(group.cells))


def run_all(cells: Iterable[Cell]) -> Iterator[Outcome]:
    """Runs cells, comparing each with the same run without a fault, which is run only once."""
    clean: dict[Cell, Outcome] = {}
    for cell in cells:
        without = replace(cell, faults=(), changes=(), events=(), fault="")
        if without not in clean:
            clean[without] = run_cell(without)
        outcome = run_cell(cell) if cell.items else clean[without]
        outcome.compare(clean[without])
        yield outcome


def run_cell(cell: Cell) -> Outcome:
    """Runs one cell.

    Raises:
        UsageError: There is no such link, or an event of the cell is impossible there.
    """
    outcome = Outcome(cell, waiting=cell.events)
    try:
        _run_there(outcome)
    except RobotError as error:
        outcome.end, outcome.broke = str(error).partition(";")[0], True
    return outcome


def _run_there(outcome: Outcome) -> None:
    cell, is_killed = outcome.cell, any(event.name in KILL_EVENTS for event in outcome.cell.events)
    with ExitStack() as stack:
        setup = stack.enter_context(open_setup(cell.link, cell.command_of_own))
        folder = make_folder(cell.events, stack)
        check_events({*setup.events, *FILE_EVENTS, *CLOCK_EVENTS}, cell.link, cell.events)
        if is_killed and not _run_killed(outcome, setup, folder):
            return
        files = open_files(folder, stack)
        files.told += ["the simulator was killed, and another one went on with its memory"] * is_killed
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

    def run(tell: Tell) -> None:
        with ExitStack() as stack:
            files = open_files(folder, stack, tell)
            elsewhere = {name: partial(tell, ASK, name) for name in setup.of_opener}
            _run(outcome, setup, files, {**setup.events, **elsewhere, **files.events, **clock_events(stack)})

    was_killed, told = run_to_be_killed(run, lambda name, size: setup.events[name](size))
    of = {kind: [each[1] for each in told if each[0] == kind] for kind in ("oldest", "saving", "ended", "broke")}
    outcome.oldest = max(of["oldest"], default=0)
    outcome.end = outcome.seen = next(iter(of["broke"] + of["ended"]), "")
    outcome.lost = "" if is_memory_held(folder, of["saving"]) else "the memory"
    outcome.broke = bool(of["broke"])
    if was_killed:
        outcome.waiting = ()
    return was_killed


def _note_end(outcome: Outcome, error: Exception, files: NoFiles) -> None:
    if isinstance(error, RobotError):
        outcome.end = outcome.seen = str(error).partition(";")[0]
    elif isinstance(error, OctetError) and files.struck:
        outcome.end = outcome.seen = files.without_folder(str(error))
    else:
        outcome.end, outcome.broke = f"{type(error).__name__}: {error}", True


def _run(outcome: Outcome, setup: Setup, files: NoFiles, events: Mapping[str, Happen]) -> None:
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
            outcome.seen = ", ".join([*([outcome.seen] if outcome.seen else []), *files.told])


def _watch(outcome: Outcome, events: Mapping[str, Happen], simulation: Simulation) -> None:
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
            happen(events, event)


def happen(events: Mapping[str, Happen], event: Event) -> None:
    """Triggers an event."""
    events[event.name](event.size)


def _note(outcome: Outcome, client: RobotClient) -> None:
    frames, sides = client.frames, sides_of(client.memory)
    of_line = {
        "repeated": frames.repeated,
        "duplicate": frames.duplicate if frames.duplicate > _SIGNS_MAX else 0,
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
    outcome.wrong = tuple(pattern for pattern, side in _PROPER.items() if sides[pattern] not in (0, side))
    robots = sum(client.faults.get(kind, 0) for kind in _REFUSING)
    outcome.refusals = frames.refused + robots
    if isinstance(client.connection.link, FaultyLink):
        outcome.strikes = client.connection.link.schedule.count
        outcome.struck = tuple(map(str, client.connection.link.schedule.struck))
