"""Reset and clock control of the STM32F1 (RM0008 7.3)."""

from collections.abc import Callable

from host_sim.emulator.clock import Clock
from host_sim.emulator.rcc import Oscillators, Rcc, RccFaults
from host_sim.emulator.registers import Register

_PLLSRC, _PLLXTPRE, _MUL_SHIFT = 1 << 16, 1 << 17, 18
_MUL_MAX = 16


class RccF1(Rcc):
    """The F1's: the PLL is set up in CFGR."""

    csr_offset = 0x24

    def __init__(
        self, clock: Clock, oscillators: Oscillators, flash_hz: Callable[[], int], faults: RccFaults
    ) -> None:
        """As in `Rcc`."""
        self.cfgr = Register("CFGR", on_write=self._switch)
        registers = {
            0x04: self.cfgr,
            0x08: Register("CIR"),
            0x0C: Register("APB2RSTR"),
            0x10: Register("APB1RSTR"),
            0x14: Register("AHBENR", 0x14),
            0x18: Register("APB2ENR"),
            0x1C: Register("APB1ENR"),
            0x20: Register("BDCR"),
        }
        super().__init__(registers, clock, oscillators, flash_hz, faults)

    def pll_hz(self, internal: int, crystal: int) -> int:
        """As in `Rcc`."""
        setting = self.cfgr.value
        source = crystal >> bool(setting & _PLLXTPRE) if setting & _PLLSRC else internal // 2
        return source * min((setting >> _MUL_SHIFT & 0xF) + 2, _MUL_MAX)

    def prescalers(self) -> tuple[int, int]:
        """As in `Rcc`."""
        return self.cfgr.value >> 8 & 7, self.cfgr.value >> 11 & 7
