"""The three transmit mailboxes of the bxCAN, and their common status register."""

from collections.abc import Callable

from host_sim.emulator.can_frame import CanFrame
from host_sim.emulator.can_mailbox import ABRQ, TERR, TXOK, Mailbox
from host_sim.emulator.registers import Register

COUNT = 3
_BASE, _STRIDE, _TSR = 0x180, 0x10, 0x08
_CODE_SHIFT, _TME_SHIFT, _LOW_SHIFT = 24, 26, 29


class TransmitMailboxes:
    """Chooses what is sent next.

    Attributes:
        registers: By their offset from the beginning of the bxCAN.
        by_request: TXFP: first requested, first sent; otherwise the lowest identifier, then the lowest mailbox.
        stuck: Numbers of mailboxes whose frames never leave, not even when given up.
    """

    def __init__(self, requested: Callable[[CanFrame], None], stuck: frozenset[int]) -> None:
        """Three empty mailboxes.

        Args:
            requested: Told of each frame that the image wants sent.
            stuck: As the attribute.
        """
        self._requested = requested
        self.stuck = stuck
        self._boxes = [Mailbox(number, self._request) for number in range(COUNT)]
        self.registers = {_TSR: Register("TSR", on_read=self._read_status, on_write=self._write_status)} | {
            _BASE + _STRIDE * number + offset: register
            for number, box in enumerate(self._boxes)
            for offset, register in box.registers.items()
        }
        self.reset()

    def reset(self) -> None:
        """All empty again."""
        self.by_request = False
        self._order: list[int] = []
        self._on_wire: int | None = None
        for box in self._boxes:
            box.reset()

    def offer(self) -> CanFrame | None:
        """The frame to send next; it counts as on the wire until `sent`, `failed` or the next offer."""
        waiting = [number for number in self._by_priority() if number not in self.stuck]
        self._on_wire = waiting[0] if waiting else None
        return self._boxes[waiting[0]].frame() if waiting else None

    def lost_arbitration(self) -> None:
        """The frame offered last did not win the bus."""
        self._on_wire = None

    def sent(self) -> None:
        """The frame offered last is through."""
        if self._on_wire is not None:
            self._end(self._on_wire, TXOK)

    def failed(self, *, once: bool) -> None:
        """The frame offered last was destroyed: it stays, to be sent again, unless given up meanwhile.

        Args:
            once: NART: there is no second try.
        """
        number, self._on_wire = self._on_wire, None
        if number is not None and (once or self._boxes[number].aborting):
            self._end(number, TERR)

    def _request(self, number: int) -> None:
        self._order.append(number)
        self._requested(self._boxes[number].frame())

    def _end(self, number: int, status: int) -> None:
        self._boxes[number].end(status)
        self._order.remove(number)
        if number == self._on_wire:
            self._on_wire = None

    def _by_priority(self) -> list[int]:
        if self.by_request:
            return self._order
        return sorted(self._order, key=lambda number: (self._boxes[number].frame().rank, number))

    def _read_status(self) -> int:
        pending = self._by_priority()
        value = sum(box.status << 8 * number for number, box in enumerate(self._boxes))
        free = [number for number in range(COUNT) if number not in pending]
        value |= (free[0] if free else pending[-1]) << _CODE_SHIFT
        value |= sum(1 << number for number in free) << _TME_SHIFT
        if len(pending) > 1:
            value |= 1 << pending[-1] << _LOW_SHIFT
        return value

    def _write_status(self, value: int) -> None:
        for number, box in enumerate(self._boxes):
            written = value >> 8 * number & 0xFF
            box.clear(written & ~ABRQ)
            if written & ABRQ and box.pending:
                self._give_up(number)

    def _give_up(self, number: int) -> None:
        """At once, unless its frame is on the wire: that one is let go to its end."""
        self._boxes[number].aborting = True
        if number != self._on_wire and number not in self.stuck:
            self._end(number, 0)
