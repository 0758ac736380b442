"""What comes of a cell: whether it was safe, whether the fault was seen, and whether anything wrong was learned."""

from collections.abc import Iterable, Iterator, Mapping
from contextlib import ExitStack
from dataclasses import dataclass

from host_sim.campaign.cell import Cell
from host_sim.campaign.run_files import FILE_EVENTS, NoFiles, open_files
from host_sim.campaign.setups import Happen, Setup, check_events, open_setup
from host_sim.campaign.wall_clock import CLOCK_EVENTS, clock_events
from host_sim.client.commands import stop
from host_sim.client.pacing import HOLD_TICKS
from host_sim.client.robot_client import RobotClient
from host_sim.errors import OctetError, RobotError, UsageError
from host_sim.faults.event import Event
from host_sim.faults.faulty_link import FaultyLink
from host_sim.protocol.generated import PARAMETERS, TICK_SPAN, Side
from host_sim.protocol.memory_kinds import sides_of
from host_sim.sim.make import make
from host_sim.sim.simulation import Simulation

_PROPER = {1: Side.LEFT, 3: Side.LEFT, 4: Side.RIGHT, 6: Side.RIGHT}
_TICK_MS = PARAMETERS["tick_ms"].default
_FRESH_TICKS = 25
_DENIALS = ("denied", "contradictions")
_SIGNS_MAX = 10
"""A robot in lockstep that waits says so now and then: some frames more are no sign of a fault."""


@dataclass
class Outcome:
    """What came of one run.

    Attributes:
        cell: The run.
        oldest: Age of the oldest drive with which the wheels turned, in ticks.
        seen: By what the fault was noticed, in words; empty if it was not.
        end: How the run ended before its time, in words; empty if it did not.
        doubts: What makes its result doubtful.
        wrong: Patterns for which a wrong turn was learned.
        digest: Of its log.
        broke: Whether it ended with an error that is not about the robot, its line, or files that were struck.
        lost: What its files do not hold though nobody was told, in words; empty if they hold all.
        struck: The faults that befell frames, as rules for one frame each.
        waiting: Events that did not come to happen.
        moved: Tick after which the robot last answered in time.
        ticks: Number of ticks.
        differs: Whether, in lockstep, its log is another than without the fault.
    """

    cell: Cell
    oldest: int = 0
    seen: str = ""
    end: str = ""
    doubts: tuple[str, ...] = ()
    wrong: tuple[int, ...] = ()
    digest: str = ""
    broke: bool = False
    lost: str = ""
    struck: tuple[str, ...] = ()
    waiting: tuple[Event, ...] = ()
    moved: int = 0
    ticks: int = 0
    differs: bool = False

    @property
    def problems(self) -> list[str]:
        """Why the campaign fails here; empty if it does not."""
        cell = self.cell
        is_misled = self.wrong and (cell.denies or not (cell.changes or self.end or self.doubts))
        found = {
            "unsafe": self.oldest > HOLD_TICKS,
            "unseen": bool(cell.fault) and not self._is_seen and (self.differs or not cell.harmless),
            "did not happen": bool(self.waiting) and not self.end,
            "wrong without a word": bool(is_misled),
            "lost without a word": bool(self.lost),
            "broke": self.broke,
        }
        return [name for name, is_so in found.items() if is_so]

    @property
    def _is_seen(self) -> bool:
        """Whether the fault was noticed: by the robot itself, where it must."""
        return any(sign in self.seen for sign in _DENIALS) if self.cell.denies else bool(self.seen)

    @property
    def recovered(self) -> bool:
        """Whether the run went on to its end with a robot that answers."""
        return not self.end and self.ticks - self.moved < _FRESH_TICKS

    @property
    def rest_ms(self) -> int:
        """The longest time for which wheels turned without a new drive, ms."""
        return self.oldest * _TICK_MS

    @property
    def kind(self) -> str:
        """The worst that is to be said of it, in a word or two; what a smaller schedule must still bring about."""
        learned = "learned wrong turns" if self.wrong else "went on"
        return (*self.problems, *["ended"] * bool(self.end), *["doubted"] * bool(self.doubts), learned)[0]


def run_all(cells: Iterable[Cell]) -> Iterator[Outcome]:
    """Runs cells, each configuration's run without a fault first: what differs from that has been seen."""
    clean = ""
    for cell in cells:
        outcome = run_cell(cell)
        clean = clean if cell.fault else outcome.digest
        compare(outcome, clean)
        yield outcome


def compare(outcome: Outcome, clean: str) -> None:
    """Notes what the digest of the run without a fault shows."""
    cell = outcome.cell
    differs = outcome.digest != clean
    if cell.is_of_body and not outcome.seen and differs:
        outcome.seen = "what it does"
    outcome.differs = differs and not cell.is_real_time


def run_cell(cell: Cell) -> Outcome:
    """One run.

    Raises:
        UsageError: There is no such link, or something in the cell cannot happen there.
    """
    outcome = Outcome(cell)
    try:
        _run_there(outcome)
    except RobotError as error:
        outcome.end, outcome.broke = str(error).partition(";")[0], True
    return outcome


def _run_there(outcome: Outcome) -> None:
    cell = outcome.cell
    with ExitStack() as stack:
        setup, files = stack.enter_context(open_setup(cell.link)), open_files(cell.events, stack)
        check_events({*setup.events, *FILE_EVENTS, *CLOCK_EVENTS}, cell.link, cell.events)
        try:
            _run(outcome, setup, files, {**setup.events, **files.events, **clock_events(stack)})
        except UsageError:
            raise
        except Exception as error:
            _note_end(outcome, error, files)
        outcome.digest, outcome.lost = files.close(), files.lost()


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

    with make(setup.configured(outcome.cell.config), files.log, ready=ready) as simulation:
        outcome.waiting = outcome.cell.events
        (client,) = simulation.clients

        def watch(running: Simulation) -> None:
            files.save(client.memory)
            _watch(outcome, events, running)

        simulation.watch, simulation.native = watch, simulation.native and not outcome.cell.events
        try:
            for _ in simulation.run():
                stop(client)
            files.finish(client.memory)
        finally:
            _note(outcome, client)
            outcome.seen = ", ".join([*([outcome.seen] if outcome.seen else []), *files.told])


def _watch(outcome: Outcome, events: Mapping[str, Happen], simulation: Simulation) -> None:
    """Called after each step: looks at the wheels, then makes happen what is due."""
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
    # What a busy host does to the line says nothing about the body.
    counts = client.faults if outcome.cell.is_of_body else of_line | client.faults
    outcome.seen = ", ".join(f"{count} {name}" for name, count in counts.items() if count)
    outcome.doubts = tuple(map(str, client.incidents))
    outcome.seen = outcome.seen or ", ".join(outcome.doubts)
    outcome.wrong = tuple(pattern for pattern, side in _PROPER.items() if sides[pattern] not in (0, side))
    if isinstance(client.connection.link, FaultyLink):
        outcome.struck = tuple(map(str, client.connection.link.schedule.struck))
