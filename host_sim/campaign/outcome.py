"""What comes of a cell: whether it was safe, whether the fault was seen, and whether anything wrong was learned."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from host_sim.campaign.cells import Cell
from host_sim.client.commands import stop
from host_sim.client.frame_log import FrameLog
from host_sim.client.pacing import HOLD_TICKS
from host_sim.client.robot_client import RobotClient
from host_sim.errors import OctetError
from host_sim.protocol.generated import TICK_SPAN, Side
from host_sim.protocol.memory_kinds import sides_of
from host_sim.sim.make import make
from host_sim.sim.simulation import Simulation

_PROPER = {1: Side.LEFT, 3: Side.LEFT, 4: Side.RIGHT, 6: Side.RIGHT}


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
        broke: Whether it ended with an error that is not one of ours.
    """

    cell: Cell
    oldest: int = 0
    seen: str = ""
    end: str = ""
    doubts: tuple[str, ...] = ()
    wrong: tuple[int, ...] = ()
    digest: str = ""
    broke: bool = False

    @property
    def problems(self) -> list[str]:
        """Why the campaign fails here; empty if it does not."""
        is_misled = self.wrong and not (self.cell.is_of_body or self.end or self.doubts)
        found = {
            "unsafe": self.oldest > HOLD_TICKS,
            "unseen": bool(self.cell.fault) and not self.seen,
            "wrong without a word": bool(is_misled),
            "broke": self.broke,
        }
        return [name for name, is_so in found.items() if is_so]

    @property
    def rest_ms(self) -> int:
        """The longest time for which wheels turned without a new drive, ms."""
        return self.oldest * 20


def run_all(cells: Iterable[Cell]) -> Iterator[Outcome]:
    """Runs cells, each configuration's run without a fault first: what differs from that has been seen."""
    clean = ""
    for cell in cells:
        outcome = _run(cell)
        clean = outcome.digest if not cell.fault else clean
        if cell.is_of_body and not outcome.seen and outcome.digest != clean:
            outcome.seen = "what it does"
        yield outcome


def _run(cell: Cell) -> Outcome:
    outcome, log = Outcome(cell), FrameLog()

    def watch(simulation: Simulation) -> None:
        for drive in simulation.drives:
            if drive.left_mm_s or drive.right_mm_s:
                outcome.oldest = max(outcome.oldest, (simulation.tick - 1 - drive.tick) % TICK_SPAN)

    try:
        with make(cell.config, log, ready=lambda client: _note(outcome, client)) as simulation:
            simulation.watch = watch
            (client,) = simulation.clients
            try:
                for _ in simulation.run():
                    stop(client)
            finally:
                _note(outcome, client)
    except OctetError as error:
        outcome.end = outcome.seen = str(error).partition(";")[0]
    except Exception as error:
        outcome.end, outcome.broke = f"{type(error).__name__}: {error}", True
    outcome.digest = log.close()
    return outcome


def _note(outcome: Outcome, client: RobotClient) -> None:
    frames, sides = client.frames, sides_of(client.memory)
    counts = {
        "repeated": frames.repeated,
        "duplicate": frames.duplicate,
        "lost": frames.lost,
        "refused": frames.refused,
        **client.faults,
    }
    outcome.seen = ", ".join(f"{count} {name}" for name, count in counts.items() if count)
    outcome.doubts = tuple(map(str, client.incidents))
    outcome.wrong = tuple(pattern for pattern, side in _PROPER.items() if sides[pattern] not in (0, side))
