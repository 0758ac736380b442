"""Reset and clock control of the F1 (RM0008 7.3)."""

from collections.abc import Callable

from host_sim.emulator.clock import Clock
from host_sim.emulator.rcc import HSE, HSI, Oscillators, Rcc, RccFaults, plain
from host_sim.emulator.registers import BoardError, Register

_PLLSRC, _PLLXTPRE, _MUL_SHIFT, _MUL_MAX = 1 << 16, 1 << 17, 18, 16
_PLL_SETUP = 0x3F << 16


class RccF1(Rcc):
    """Reset and clock control of the F1: CFGR configures the PLL."""

    csr_offset = 0x24

    def __init__(
        self, clock: Clock, oscillators: Oscillators, flash_hz: Callable[[], int], faults: RccFaults
    ) -> None:
        """As in `Rcc`."""
        self.cfgr = Register("CFGR", on_write=self._write_cfgr)
        without_effect = plain(
            {0x08: "CIR", 0x0C: "APB2RSTR", 0x10: "APB1RSTR", 0x18: "APB2ENR", 0x1C: "APB1ENR", 0x20: "BDCR"}
        )
        registers = without_effect | {0x04: self.cfgr, 0x14: Register("AHBENR", 0x14)}
        super().__init__(registers, clock, oscillators, flash_hz, faults)

    def pll_source(self) -> str:
        """As in `Rcc`."""
        return HSE if self.cfgr.value & _PLLSRC else HSI

    def pll_hz(self) -> int:
        """As in `Rcc`."""
        halved = self.pll_source() == HSI or bool(self.cfgr.value & _PLLXTPRE)
        return (self._source_hz() >> halved) * min((self.cfgr.value >> _MUL_SHIFT & 0xF) + 2, _MUL_MAX)

    def prescalers(self) -> tuple[int, int]:
        """As in `Rcc`."""
        return self.cfgr.value >> 8 & 7, self.cfgr.value >> 11 & 7

    def check_pll(self) -> None:
        """As in `Rcc`."""
        if self.pll_hz() > self._oscillators.core_max:
            raise BoardError(f"RCC CR was written to start the PLL at {self.pll_hz()} Hz, which it cannot make")

    def adc_hz(self) -> int:
        """Frequency of the ADC's clock, Hz."""
        return self.apb2_hz() // (2 * ((self.cfgr.value >> 14 & 3) + 1))

    def _write_cfgr(self, value: int) -> None:
        """Writes CFGR; the PLL's fields keep their values while it is on."""
        kept = _PLL_SETUP if self.pll_is_on() else 0
        self._switch(value & ~kept | self.cfgr.value & kept)
