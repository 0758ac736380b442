"""What a tick costs: instructions from the senses that are seen in the FIFO to the drive in the mailbox."""

from dataclasses import dataclass, field

from host_sim.bench.short_run import step_through
from host_sim.client.frame_log import FrameLog
from host_sim.client.handshake import handshake
from host_sim.client.robot_client import RobotClient
from host_sim.emulator.board import EmulatedBoard
from host_sim.emulator.can_frame import CanFrame
from host_sim.emulator.start import start_board
from host_sim.protocol.codec import Protocol
from host_sim.sim.make import assemble
from host_sim.sim.run_config import RunConfig

_READY_S = 5.0


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
    board = start_board(name)
    try:
        cost = TickCost(board)
        client = RobotClient(board, Protocol(), FrameLog(), status=board.status, bus=name)
        handshake(client, _READY_S)
        step_through(assemble([client], RunConfig(seed=seed)), ticks)
        client.log.close()
    finally:
        board.close()
    return cost.counts
