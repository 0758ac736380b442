"""CAN controllers of the boards and the wire between nodes; the models are written in C (`models/`)."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

from host_sim.emulator.c_models import c_models
from host_sim.emulator.clock import SECOND, Clock
from host_sim.emulator.registers import BoardError, Peripheral, Register

_NS = SECOND // 10**9
_EXTENDED, _REMOTE, _ID = 1 << 31, 1 << 30, (1 << 29) - 1


class CanFrame(NamedTuple):
    """A CAN frame of any kind.

    Attributes:
        id: Identifier, 11 or 29 bits.
        data: 0..8 bytes; for a remote frame, only the length matters.
        extended: Whether the identifier has 29 bits.
        remote: Whether it is a remote frame, which requests data.
    """

    id: int
    data: bytes = b""
    extended: bool = False
    remote: bool = False


@dataclass(frozen=True)
class CanFaults:
    """Faults of a CAN controller.

    Attributes:
        init_stuck: Whether initialization is never acknowledged.
        stuck_mailboxes: Bit n is set if frames in mailbox n are never sent.
    """

    init_stuck: bool = False
    stuck_mailboxes: int = 0


class CanController(Peripheral):
    """A controller, its wire, and one more node on the wire that represents the rest of the bus.

    Attributes:
        model: The C model of the controller.
        node: The part common to all controllers, `struct can_node`.
        wire: The bus, `struct can_wire`.
    """

    called: str
    """Name of the peripheral, as in the reference manual."""
    kind: str
    """Name of its kind in C."""
    control: int
    """Offset of the register by which a driver connects it to the bus."""

    def __init__(
        self,
        names: Mapping[int, str],
        clock: Clock,
        bus_hz: Callable[[], int],
        faults: CanFaults,
        heard: Callable[[CanFrame], None],
        *details: int,
    ) -> None:
        """Creates a controller that is not on the bus.

        Args:
            names: Register names by offset.
            clock: The board's clock.
            bus_hz: Returns the frequency of the controller's clock, Hz.
            faults: Faults to simulate.
            heard: Called with each frame that the board has sent.
            details: What the function that opens its kind takes besides the model and the wire.

        Raises:
            OctetError: The models are not built.
        """
        self.ffi, self.library = ffi, library = c_models()
        self._clock, self._bus_hz, self._heard = clock, bus_hz, heard
        self._frame: Any = ffi.new("struct frame *")
        self._data = ffi.buffer(self._frame.data)
        self.wire: Any = ffi.new("struct can_wire *")
        library.wire_open(self.wire)
        self.model: Any = ffi.new(f"struct {self.kind} *")
        getattr(library, f"{self.kind}_open")(self.model, self.wire, *details)
        self.node: Any = self.model.node
        self.node.init_stuck, self.node.stuck_mailboxes = faults.init_stuck, faults.stuck_mailboxes
        super().__init__(self.called, {offset: self._register(offset, name) for offset, name in names.items()})
        clock.join_wire(self.wire, self._take)

    def reset(self) -> None:
        """As in `Peripheral`."""
        super().reset()
        getattr(self.library, f"{self.kind}_reset")(self.model)

    def set_clocked(self, clocked: bool) -> None:
        """As in `Peripheral`."""
        super().set_clocked(clocked)
        self.node.clocked = clocked

    def access_directly(self, space: Any, base: int) -> None:
        """Lets a `struct register_space` access the registers without calling Python.

        Writes to `control` still come here, since the controller then needs its clock frequency.
        """
        space.can, space.can_base = self.ffi.addressof(self.node), base
        for offset in self.registers:
            word = self.library.space_can_word(offset)
            space.can_readable[word] = True
            space.can_writable[word] = offset != self.control

    def put(self, frame: CanFrame) -> None:
        """Queues a frame from the rest of the bus; it is lost if the queue is full."""
        flags = (_EXTENDED if frame.extended else 0) | (_REMOTE if frame.remote else 0)
        self._frame.id, self._frame.len = frame.id | flags, len(frame.data)
        self._data[:] = frame.data.ljust(8, b"\0")
        self.library.wire_put(self.wire, self._frame)
        self._clock.expect_now()

    def _register(self, offset: int, name: str) -> Register:
        node, read, write = self.ffi.addressof(self.node), self.library.node_read, self.library.node_write

        def on_read() -> int:
            value: int = read(node, offset)
            if value < 0:
                self._refuse()
            return value

        def on_write(value: int) -> None:
            self.wire.now_ns = self._clock.now // _NS
            if offset == self.control:
                self.node.clock_hz = self._bus_hz()
            if not write(node, offset, value):
                self._refuse()
            self._clock.expect_now()

        return Register(name, on_read=on_read, on_write=on_write)

    def _take(self) -> None:
        if self.node.refusal[0] != b"\0":
            self._refuse()
        while self.wire.heard.count:
            self.library.wire_fetch(self.wire, self._frame)
            frame = self._frame
            remote = bool(frame.id & _REMOTE)
            data = bytes(frame.len) if remote else self._data[: frame.len]
            self._heard(CanFrame(frame.id & _ID, data, bool(frame.id & _EXTENDED), remote))

    def _refuse(self) -> None:
        reason = self.ffi.string(self.node.refusal).decode()
        self.node.refusal = b""
        raise BoardError(reason)


_MAILBOX, _OUTPUT, _BANK = 0x180, 0x1B0, 0x240
_NAMED = {0x00: "MCR", 0x04: "MSR", 0x08: "TSR", 0x0C: "RF0R", 0x10: "RF1R", 0x14: "IER", 0x18: "ESR", 0x1C: "BTR"}
_FILTERS = {0x200: "FMR", 0x204: "FM1R", 0x20C: "FS1R", 0x214: "FFA1R", 0x21C: "FA1R"}


class BxCan(CanController):
    """bxCAN, the controller of F1 and F4; see `CanController`."""

    called, kind, control = "CAN1", "bxcan", 0x00

    def __init__(
        self,
        clock: Clock,
        bus_hz: Callable[[], int],
        faults: CanFaults,
        heard: Callable[[CanFrame], None],
        banks: int = 14,
    ) -> None:
        """Starts in sleep mode, with `banks` filter banks."""
        names = _NAMED | _FILTERS
        boxes = ((_MAILBOX, ("TI", "TDT", "TDL", "TDH"), 3), (_OUTPUT, ("RI", "RDT", "RDL", "RDH"), 2))
        for base, words, count in boxes:
            names |= {base + 16 * n + 4 * i: f"{word}{n}R" for n in range(count) for i, word in enumerate(words)}
        names |= {_BANK + 8 * bank + 4 * half: f"F{bank}R{half + 1}" for bank in range(banks) for half in range(2)}
        super().__init__(names, clock, bus_hz, faults, heard, banks)


_FD_NAMES = {0x000: "CREL", 0x004: "ENDN", 0x018: "CCCR", 0x01C: "NBTP", 0x040: "ECR", 0x044: "PSR", 0x050: "IR"}
_FD_NAMES |= {0x054: "IE", 0x058: "ILS", 0x05C: "ILE", 0x080: "RXGFC", 0x090: "RXF0S", 0x094: "RXF0A"}
_FD_NAMES |= {0x098: "RXF1S", 0x09C: "RXF1A", 0x0C0: "TXBC", 0x0C4: "TXFQS", 0x0C8: "TXBRP", 0x0CC: "TXBAR"}
_FD_NAMES |= {0x0D0: "TXBCR", 0x0D4: "TXBTO", 0x0D8: "TXBCF"}


class FdCan(CanController):
    """FDCAN of the G4 in classic CAN mode, with its message RAM; see `CanController`."""

    called, kind, control = "FDCAN1", "fdcan", 0x018

    def __init__(
        self, clock: Clock, bus_hz: Callable[[], int], faults: CanFaults, heard: Callable[[CanFrame], None]
    ) -> None:
        """Starts in initialization mode."""
        _, library = c_models()
        ram = {library.FDCAN_RAM_AT + 4 * word: f"RAM[{word}]" for word in range(library.FDCAN_RAM_WORDS)}
        super().__init__(_FD_NAMES | ram, clock, bus_hz, faults, heard)
