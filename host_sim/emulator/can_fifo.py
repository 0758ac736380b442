"""A receive FIFO of the bxCAN."""

from collections import deque
from collections.abc import Callable

from host_sim.emulator.can_frame import CanFrame, disregard
from host_sim.emulator.errors import BoardError
from host_sim.emulator.registers import Register

DEPTH = 3
_FULL, _FOVR, _RFOM = 1 << 3, 1 << 4, 1 << 5
_STANDARD_SHIFT, _EXTENDED_SHIFT, _IDE, _RTR = 21, 3, 1 << 2, 1 << 1


class CanFifo:
    """Keeps three frames, and says when one was lost.

    Attributes:
        locked: A full FIFO keeps what it has; otherwise the newest frame takes the place of the one before.
        overruns: Frames lost so far.
        on_seen: Called with each frame, once, when the image sees that it is there.
    """

    def __init__(self, number: int) -> None:
        """An empty FIFO.

        Args:
            number: 0 or 1.
        """
        self._number = number
        self.on_seen: Callable[[CanFrame], None] = disregard
        self.overruns = 0
        self.reset()

    def reset(self) -> None:
        """Empty again."""
        self.locked = False
        self._frames: deque[CanFrame] = deque()
        self._flags = 0
        self._is_news = True

    def status_register(self) -> Register:
        """RFxR."""
        return Register(f"RF{self._number}R", on_read=self._read_status, on_write=self._write_status)

    def mailbox_registers(self) -> dict[int, Register]:
        """The output mailbox's registers, by their offset within it."""
        readers = {"RI": self._identifier, "RDT": self._length, "RDL": self._low, "RDH": self._high}
        return {
            4 * i: Register(f"{name}{self._number}R", on_read=read, on_write=self._refuse)
            for i, (name, read) in enumerate(readers.items())
        }

    def push(self, frame: CanFrame) -> None:
        """A frame has come."""
        if len(self._frames) == DEPTH:
            self._flags |= _FOVR
            self.overruns += 1
            if self.locked:
                return
            self._frames.pop()
        self._frames.append(frame)
        if len(self._frames) == DEPTH:
            self._flags |= _FULL

    def _read_status(self) -> int:
        if self._frames and self._is_news:
            self._is_news = False
            self.on_seen(self._frames[0])
        return len(self._frames) | self._flags

    def _write_status(self, value: int) -> None:
        self._flags &= ~(value & (_FULL | _FOVR))
        if value & _RFOM and self._frames:
            self._frames.popleft()
            self._is_news = True

    def _head(self) -> CanFrame:
        if not self._frames:
            raise BoardError(f"the output mailbox of CAN1 FIFO {self._number} was read, but the FIFO is empty")
        return self._frames[0]

    def _identifier(self) -> int:
        frame = self._head()
        remote = _RTR if frame.remote else 0
        if frame.extended:
            return frame.id << _EXTENDED_SHIFT | _IDE | remote
        return frame.id << _STANDARD_SHIFT | remote

    def _length(self) -> int:
        return len(self._head().data)

    def _low(self) -> int:
        return int.from_bytes(self._data()[:4], "little")

    def _high(self) -> int:
        return int.from_bytes(self._data()[4:], "little")

    def _data(self) -> bytes:
        frame = self._head()
        return bytes(8) if frame.remote else frame.data.ljust(8, b"\0")

    def _refuse(self, _value: int) -> None:
        raise BoardError(f"the output mailbox of CAN1 FIFO {self._number} was written, which is read-only")
