"""The cost of a tick: instructions from seeing the senses in the FIFO to the drive in the mailbox.

Waiting for earlier frames to be sent is not counted: that time is spent on the wire.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

from host_sim.client.commands import handshake
from host_sim.client.connection import Connection
from host_sim.client.frame_log import FrameLog
from host_sim.client.robot_client import RobotClient
from host_sim.emulator.board import EmulatedBoard, start_board
from host_sim.emulator.registers import Register
from host_sim.lab.bench.short_run import step_through
from host_sim.protocol.codec import Protocol
from host_sim.sim.make import assemble
from host_sim.sim.run_config import RunConfig

_READY_S = 5.0
_TXBAR = 0x0CC
"""Offset of TXBAR, which only FDCAN has."""


class _Layout(NamedTuple):
    """The registers of a CAN controller to watch: their offsets, and how to interpret them."""

    transmit: int
    is_taken: Callable[[int], bool]
    """Whether a mailbox is in use, given the value of `transmit`."""
    received: int
    level: int
    """Mask in `received` of the number of frames waiting."""
    release: int
    releases: Callable[[int], bool]
    requests: Sequence[int]
    received_id: Callable[[int], int]
    """Identifier of the next frame, given the value of `received`."""
    requested_id: Callable[[int], int | None]
    """Identifier of the frame sent by a write to one of `requests`."""


def _layout_of(registers: Mapping[int, Register]) -> _Layout:
    if _TXBAR in registers:
        return _Layout(
            *(0x0C8, bool, 0x090, 15, 0x094, lambda _place: True, (_TXBAR,)),
            received_id=lambda status: registers[0x40B0 + 72 * (status >> 8 & 3)].read() >> 18,
            requested_id=lambda buffer: registers[0x4278 + 72 * (buffer.bit_length() - 1)].read() >> 18,
        )
    return _Layout(
        *(0x08, lambda status: status >> 26 & 7 != 7, 0x0C, 3, 0x0C, lambda value: bool(value & 1 << 5)),  # noqa: PLR2004
        requests=(0x180, 0x190, 0x1A0),
        received_id=lambda _status: registers[0x1B0].read() >> 21,
        requested_id=lambda value: value >> 21 if value & 1 else None,
    )


class TickCost:
    """Counts each tick of a board, to within a basic block, by watching the registers of its CAN controller.

    Attributes:
        counts: Number of instructions of each tick so far.
    """

    def __init__(self, board: EmulatedBoard) -> None:
        protocol = Protocol()
        self._senses, self._drive = protocol.id_of("SENSES"), protocol.id_of("DRIVE")
        self._core, self._registers = board.hardware.core, board.hardware.can.registers
        board.hardware.space.watch()
        self._begun: int | None = None
        self._is_news = True
        self._transmit_status, self._seen = 0, 0
        self.counts: list[int] = []
        self._layout = layout = _layout_of(self._registers)
        _watch(self._registers[layout.transmit], self._note_waiting, lambda _value: None)
        _watch(self._registers[layout.received], self._note_status, lambda _value: None)
        _watch(self._registers[layout.release], lambda _value: None, self._note_release)
        for mailbox in layout.requests:
            _watch(self._registers[mailbox], lambda _value: None, self._note_request)

    def _note_status(self, value: int) -> None:
        if not (value & self._layout.level and self._is_news):
            return
        self._is_news = False
        if self._layout.received_id(value) == self._senses:
            self._begun = self._core.instructions

    def _note_waiting(self, status: int) -> None:
        """Subtracts the instructions since the last poll if mailboxes were in use then and nothing has changed."""
        now = self._core.instructions
        if status == self._transmit_status and self._layout.is_taken(status) and self._begun is not None:
            self._begun += now - self._seen
        self._transmit_status, self._seen = status, now

    def _note_release(self, value: int) -> None:
        self._is_news = self._is_news or self._layout.releases(value)

    def _note_request(self, value: int) -> None:
        self._transmit_status = 0
        if self._layout.requested_id(value) == self._drive and self._begun is not None:
            self.counts.append(self._core.instructions - self._begun)
            self._begun = None


def _watch(register: Register, on_read: Callable[[int], None], on_write: Callable[[int], None]) -> None:
    """Calls functions with every value read from a register, and every value written to it."""
    read, write = register.on_read, register.on_write
    assert read is not None
    assert write is not None

    def seen() -> int:
        value = read()
        on_read(value)
        return value

    def written(value: int) -> None:
        write(value)
        on_write(value)

    register.on_read, register.on_write = seen, written


def count_ticks(name: str, seed: int, ticks: int) -> list[int]:
    """The number of instructions of each tick of a run on an emulated board.

    Raises:
        OctetError: The board's image is not built, or the board fails.
    """
    board = start_board(name)
    try:
        cost = TickCost(board)
        client = RobotClient(Connection(board, name, board.status, now=board.now), Protocol(), FrameLog())
        handshake(client, _READY_S)
        step_through(assemble([client], RunConfig(seed=seed)), ticks)
        client.log.close()
    finally:
        board.close()
    return cost.counts
