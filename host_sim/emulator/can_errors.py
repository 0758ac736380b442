"""A CAN controller's error counters, after ISO 11898-1."""

from dataclasses import dataclass

WARNING, PASSIVE, BUS_OFF = 96, 128, 256
_PENALTY = 8
_REC_AFTER_PASSIVE = 120
_EWGF, _EPVF, _BOFF = 1, 2, 4
_LEC_SHIFT, _TEC_SHIFT, _REC_SHIFT = 4, 16, 24
_BIT_DOMINANT, _NO_ACKNOWLEDGE = 5, 3


@dataclass
class ErrorCounters:
    """Counts up where frames fail, down where they pass.

    Attributes:
        tec: Of sending.
        rec: Of receiving.
        last: Code of the last error, as in the register ESR.
        bus_off: Counted out: takes no part in the bus any more.
    """

    tec: int = 0
    rec: int = 0
    last: int = 0
    bus_off: bool = False

    @property
    def passive(self) -> bool:
        """Whether the controller may no longer destroy other nodes' frames."""
        return max(self.tec, self.rec) >= PASSIVE

    def sent(self) -> None:
        """A frame has passed."""
        self.tec, self.last = max(self.tec - 1, 0), 0

    def received(self) -> None:
        """A frame of another node has passed."""
        self.rec = _REC_AFTER_PASSIVE if self.rec >= PASSIVE else max(self.rec - 1, 0)
        self.last = 0

    def send_failed(self, *, acknowledged: bool) -> None:
        """A frame was destroyed, or nobody acknowledged it; the latter takes a lone node no farther than passive."""
        self.last = _BIT_DOMINANT if acknowledged else _NO_ACKNOWLEDGE
        if acknowledged or not self.passive:
            self.tec += _PENALTY
        self.bus_off = self.bus_off or self.tec >= BUS_OFF

    def recover(self) -> None:
        """128 times 11 recessive bits have passed."""
        self.tec, self.rec, self.last, self.bus_off = 0, 0, 0, False

    def esr(self) -> int:
        """All that as the register has it."""
        flags = _EWGF if max(self.tec, self.rec) >= WARNING else 0
        flags |= _EPVF if self.passive else 0
        flags |= _BOFF if self.bus_off else 0
        counts = min(self.tec, 255) << _TEC_SHIFT | min(self.rec, 255) << _REC_SHIFT
        return flags | self.last << _LEC_SHIFT | counts
