"""Reset and clock control of the F4 (RM0090 7.3)."""

from collections.abc import Callable

from host_sim.emulator.clock import Clock
from host_sim.emulator.rcc import HSE, HSI, Oscillators, Rcc, RccFaults, plain
from host_sim.emulator.registers import BoardError, Register

_PLLSRC, _PLLCFGR_RESET = 1 << 22, 0x24003010
_PLL_IN, _PLL_INSIDE = (950_000, 2_100_000), (100_000_000, 432_000_000)
"""Hz, from and to: behind its first divisor, and of its oscillator (datasheet, 5.3.10)."""


class RccF4(Rcc):
    """The F4's: the PLL has a register of its own."""

    csr_offset = 0x74

    def __init__(
        self, clock: Clock, oscillators: Oscillators, flash_hz: Callable[[], int], faults: RccFaults
    ) -> None:
        """As in `Rcc`."""
        self.cfgr = Register("CFGR", on_write=self._switch)
        self._pllcfgr = Register("PLLCFGR", _PLLCFGR_RESET, on_write=self._write_pllcfgr)
        without_effect = plain({0x0C: "CIR", 0x10: "AHB1RSTR", 0x20: "APB1RSTR", 0x24: "APB2RSTR", 0x40: "APB1ENR"})
        without_effect |= plain({0x44: "APB2ENR", 0x70: "BDCR"})
        registers = without_effect | {0x04: self._pllcfgr, 0x08: self.cfgr, 0x30: Register("AHB1ENR", 0x00100000)}
        super().__init__(registers, clock, oscillators, flash_hz, faults)

    def pll_source(self) -> int:
        """As in `Rcc`."""
        return HSE if self._pllcfgr.value & _PLLSRC else HSI

    def pll_hz(self) -> int:
        """As in `Rcc`."""
        setting = self._pllcfgr.value
        m, n, p = setting & 0x3F, setting >> 6 & 0x1FF, ((setting >> 16 & 3) + 1) * 2
        return self._source_hz() * n // max(m, 1) // p

    def prescalers(self) -> tuple[int, int]:
        """As in `Rcc`."""
        return self.cfgr.value >> 10 & 7, self.cfgr.value >> 13 & 7

    def check_pll(self) -> None:
        """As in `Rcc`."""
        fed = self._source_hz() // max(self._pllcfgr.value & 0x3F, 1)
        inside = fed * (self._pllcfgr.value >> 6 & 0x1FF)
        for name, hz, (low, high) in (("input", fed, _PLL_IN), ("oscillator", inside, _PLL_INSIDE)):
            if not low <= hz <= high:
                raise BoardError(f"RCC CR was written to start the PLL with its {name} at {hz} Hz, not {low}..{high}")

    def _write_pllcfgr(self, value: int) -> None:
        if self.pll_is_on():
            raise BoardError("RCC PLLCFGR was written while the PLL is on")
        self._pllcfgr.value = value
