"""The core's own timer (PM0214 4.5), polled."""

from host_sim.emulator.clock import Clock
from host_sim.emulator.errors import BoardError
from host_sim.emulator.registers import Peripheral, Register

_ENABLE, _TICKINT, _CLKSOURCE, _COUNTFLAG = 1, 2, 4, 1 << 16
_MAX = 0xFFFFFF
_DIVISOR = 8


class SysTick(Peripheral):
    """Counts down from LOAD to 0, over and over."""

    def __init__(self, clock: Clock) -> None:
        """At rest.

        Args:
            clock: The board's.
        """
        self._clock = clock
        self._since = self._wraps = 0
        self._ctrl = Register("CTRL", on_read=self._read_ctrl, on_write=self._write_ctrl)
        self._load = Register("LOAD", on_write=self._write_load)
        super().__init__(
            "SysTick",
            {
                0x0: self._ctrl,
                0x4: self._load,
                0x8: Register("VAL", on_read=self._read_val, on_write=self._restart, steady=False),
                0xC: Register("CALIB"),
            },
            clocked=True,
        )

    def _counted(self) -> int:
        """Counts since the last restart."""
        if not self._ctrl.value & _ENABLE:
            return 0
        return (self._clock.cycles - self._since) // (1 if self._ctrl.value & _CLKSOURCE else _DIVISOR)

    def _restart(self, value: int) -> None:  # noqa: ARG002 - whatever is written, the count is 0
        self._since, self._wraps = self._clock.cycles, 0

    def _read_val(self) -> int:
        return -self._counted() % (self._load.value + 1)

    def _read_ctrl(self) -> int:
        wraps = self._counted() // (self._load.value + 1)
        flag = _COUNTFLAG if wraps > self._wraps else 0
        self._wraps = wraps
        return self._ctrl.value | flag

    def _write_ctrl(self, value: int) -> None:
        if value & _TICKINT:
            raise BoardError("SysTick's interrupt was enabled, which is not modelled")
        self._ctrl.value = value
        self._restart(0)

    def _write_load(self, value: int) -> None:
        self._load.value = value & _MAX
