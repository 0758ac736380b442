"""What a tick costs: instructions from the senses that are seen in the FIFO to the drive in the mailbox."""

from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory

from host_sim.backends.connection import Connection
from host_sim.bench.short_run import run_ticks
from host_sim.emulator.board import EmulatedBoard
from host_sim.emulator.can_frame import CanFrame
from host_sim.emulator.start import start_board
from host_sim.protocol.codec import Protocol


@dataclass
class TickCost:
    """Counts each tick of a board, to within a basic block.

    Attributes:
        board: Which one.
        counts: Instructions of each tick so far.
    """

    board: EmulatedBoard
    counts: list[int] = field(default_factory=list)
    _begun: int = 0

    def __post_init__(self) -> None:
        protocol = Protocol()
        self._senses, self._drive = protocol.id_of("SENSES"), protocol.id_of("DRIVE")
        self._core, can = self.board.hardware.core, self.board.hardware.can
        can.on_requested = self._note_requested
        for fifo in can.fifos:
            fifo.on_seen = self._note_seen

    def _note_seen(self, frame: CanFrame) -> None:
        if frame.id == self._senses:
            self._begun = self._core.instructions

    def _note_requested(self, frame: CanFrame) -> None:
        if frame.id == self._drive:
            self.counts.append(self._core.instructions - self._begun)


def count_ticks(name: str, seed: int, ticks: int) -> list[int]:
    """Instructions of each tick of a real run.

    Args:
        name: Of the board.
        seed: Of environments and random turns.
        ticks: How many.

    Raises:
        OctetError: The board or its image cannot be had, or it fails.
    """
    with ExitStack() as stack:
        folder = Path(stack.enter_context(TemporaryDirectory()))
        board = start_board(name)
        cost = TickCost(board)
        run_ticks(Connection(board, name, board.status), seed, ticks, folder / "run.log")
    return cost.counts
