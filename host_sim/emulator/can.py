"""CAN as a peripheral of the board: the models of bxCAN and of the wire, which are written in C (`models/`)."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

from host_sim.emulator.c_models import c_models
from host_sim.emulator.clock import SECOND, Clock
from host_sim.emulator.registers import BoardError, Peripheral, Register

_NS = SECOND // 10**9
_MCR, _MAILBOX, _OUTPUT, _BANK = 0x00, 0x180, 0x1B0, 0x240
_NAMED = {0x00: "MCR", 0x04: "MSR", 0x08: "TSR", 0x0C: "RF0R", 0x10: "RF1R", 0x14: "IER", 0x18: "ESR", 0x1C: "BTR"}
_FILTERS = {0x200: "FMR", 0x204: "FM1R", 0x20C: "FS1R", 0x214: "FFA1R", 0x21C: "FA1R"}
_EXTENDED, _REMOTE, _ID = 1 << 31, 1 << 30, (1 << 29) - 1


class CanFrame(NamedTuple):
    """One frame of any kind.

    Attributes:
        id: Its identifier, of 11 or 29 bits.
        data: 0..8 bytes; of a remote frame, only the length counts.
        extended: Whether the identifier has 29 bits.
        remote: Whether it asks for data and has none.
    """

    id: int
    data: bytes = b""
    extended: bool = False
    remote: bool = False


@dataclass(frozen=True)
class CanFaults:
    """How a controller can misbehave.

    Attributes:
        init_stuck: Whether initialization is never acknowledged.
        stuck_mailboxes: Bit n is set if the frames of mailbox n never leave.
    """

    init_stuck: bool = False
    stuck_mailboxes: int = 0


def _names(banks: int) -> dict[int, str]:
    """Names of the registers by offset."""
    names = _NAMED | _FILTERS
    for base, words, count in ((_MAILBOX, ("TI", "TDT", "TDL", "TDH"), 3), (_OUTPUT, ("RI", "RDT", "RDL", "RDH"), 2)):
        names |= {base + 16 * n + 4 * i: f"{word}{n}R" for n in range(count) for i, word in enumerate(words)}
    return names | {_BANK + 8 * bank + 4 * half: f"F{bank}R{half + 1}" for bank in range(banks) for half in range(2)}


class BxCan(Peripheral):
    """The controller, with its wire and one more node there that stands for the rest of the world.

    Attributes:
        model: The C model, `struct bxcan`.
        wire: Its bus, `struct can_wire`.
    """

    def __init__(
        self,
        clock: Clock,
        bus_hz: Callable[[], int],
        banks: int,
        faults: CanFaults,
        heard: Callable[[CanFrame], None],
    ) -> None:
        """A controller that sleeps.

        Args:
            clock: The board's.
            bus_hz: Gives the speed of the controller's clock.
            banks: Number of filter banks.
            faults: How it misbehaves.
            heard: Takes what the board has sent.

        Raises:
            OctetError: The models are not built.
        """
        ffi, self._library = c_models()
        self._clock, self._bus_hz, self._heard, self._ffi = clock, bus_hz, heard, ffi
        self._frame: Any = ffi.new("struct frame *")
        self._data = ffi.buffer(self._frame.data)
        self.wire: Any = ffi.new("struct can_wire *")
        self.model: Any = ffi.new("struct bxcan *")
        self._library.wire_open(self.wire)
        self._library.bxcan_open(self.model, self.wire, banks)
        self.model.init_stuck, self.model.stuck_mailboxes = faults.init_stuck, faults.stuck_mailboxes
        super().__init__("CAN1", {offset: self._register(offset, name) for offset, name in _names(banks).items()})
        clock.join_wire(self.wire, self._take)

    def reset(self) -> None:
        """As in `Peripheral`."""
        super().reset()
        self._library.bxcan_reset(self.model)

    def set_clocked(self, clocked: bool) -> None:
        """As in `Peripheral`."""
        super().set_clocked(clocked)
        self.model.clocked = clocked

    def access_directly(self, space: Any, base: int) -> None:
        """Has a `struct register_space` read and write the registers without Python.

        MCR is written here, since the controller then asks for the speed of its clock.
        """
        space.can, space.can_base = self.model, base
        for offset in self.registers:
            space.can_readable[offset // 4] = True
            space.can_writable[offset // 4] = offset != _MCR

    def put(self, frame: CanFrame) -> None:
        """The rest of the world wants to send a frame; where too many are waiting already, it is lost."""
        flags = (_EXTENDED if frame.extended else 0) | (_REMOTE if frame.remote else 0)
        self._frame.id, self._frame.len = frame.id | flags, len(frame.data)
        self._data[:] = frame.data.ljust(8, b"\0")
        self._library.wire_put(self.wire, self._frame)
        self._clock.expect_now()

    def _register(self, offset: int, name: str) -> Register:
        model, read, write = self.model, self._library.bxcan_read, self._library.bxcan_write

        def on_read() -> int:
            value: int = read(model, offset)
            if value < 0:
                self._refuse()
            return value

        def on_write(value: int) -> None:
            self.wire.now_ns = self._clock.now // _NS
            if offset == _MCR:
                model.clock_hz = self._bus_hz()
            if not write(model, offset, value):
                self._refuse()
            self._clock.expect_now()

        return Register(name, on_read=on_read, on_write=on_write)

    def _take(self) -> None:
        if self.model.refusal[0] != b"\0":
            self._refuse()
        while self.wire.heard.count:
            self._library.wire_fetch(self.wire, self._frame)
            frame = self._frame
            remote = bool(frame.id & _REMOTE)
            data = bytes(frame.len) if remote else self._data[: frame.len]
            self._heard(CanFrame(frame.id & _ID, data, bool(frame.id & _EXTENDED), remote))

    def _refuse(self) -> None:
        reason = self._ffi.string(self.model.refusal).decode()
        self.model.refusal = b""
        raise BoardError(reason)
