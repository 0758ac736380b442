"""Reset and clock control of the STM32F4 (RM0090 7.3)."""

from collections.abc import Callable

from host_sim.emulator.clock import Clock
from host_sim.emulator.rcc import Oscillators, Rcc, RccFaults
from host_sim.emulator.registers import Register

_PLLCFGR_RESET = 0x24003010
_PLLSRC = 1 << 22


class RccF4(Rcc):
    """The F4's: the PLL has a register of its own."""

    csr_offset = 0x74

    def __init__(
        self, clock: Clock, oscillators: Oscillators, flash_hz: Callable[[], int], faults: RccFaults
    ) -> None:
        """As in `Rcc`."""
        self._pllcfgr = Register("PLLCFGR", _PLLCFGR_RESET)
        self.cfgr = Register("CFGR", on_write=self._switch)
        registers = {
            0x04: self._pllcfgr,
            0x08: self.cfgr,
            0x0C: Register("CIR"),
            0x10: Register("AHB1RSTR"),
            0x20: Register("APB1RSTR"),
            0x24: Register("APB2RSTR"),
            0x30: Register("AHB1ENR", 0x00100000),
            0x40: Register("APB1ENR"),
            0x44: Register("APB2ENR"),
            0x70: Register("BDCR"),
        }
        super().__init__(registers, clock, oscillators, flash_hz, faults)

    def pll_hz(self, internal: int, crystal: int) -> int:
        """As in `Rcc`."""
        setting = self._pllcfgr.value
        source = crystal if setting & _PLLSRC else internal
        m, n, p = setting & 0x3F, setting >> 6 & 0x1FF, ((setting >> 16 & 3) + 1) * 2
        return source * n // max(m, 1) // p

    def prescalers(self) -> tuple[int, int]:
        """As in `Rcc`."""
        return self.cfgr.value >> 10 & 7, self.cfgr.value >> 13 & 7
