"""Reset and clock control of each family of chips (F1: RM0008 7.3, F4: RM0090 7.3, G4: RM0440 7.4)."""

from collections.abc import Mapping
from typing import ClassVar

from host_sim.emulator.rcc import HSE, HSI, PLL, Rcc
from host_sim.emulator.registers import BoardError, Register, plain

_PLLSRC, _PLLXTPRE, _MUL_SHIFT, _MUL_MAX = 1 << 16, 1 << 17, 18, 16
_PLL_SETUP = 0x3F << 16
_F4_PLLSRC = 1 << 22
_G4_FROM_HSE, _G4_OUTPUT_R, _G4_CAN_SHIFT, _G4_CAN_PCLK1 = 3, 1 << 24, 24, 2


class RccF1(Rcc):
    """Reset and clock control of the F1: CFGR configures the PLL."""

    csr_offset = 0x24

    def layout(self) -> dict[int, Register]:
        """As in `Rcc`."""
        self.cfgr = Register("CFGR", on_write=self._write_cfgr)
        without_effect = plain(
            {0x08: "CIR", 0x0C: "APB2RSTR", 0x10: "APB1RSTR", 0x18: "APB2ENR", 0x1C: "APB1ENR", 0x20: "BDCR"}
        )
        return without_effect | {0x04: self.cfgr, 0x14: Register("AHBENR", 0x14)}

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


class RccF4(Rcc):
    """Reset and clock control of the F4, whose PLL has a register of its own."""

    csr_offset, brown_out = 0x74, 1 << 25
    pll_in: ClassVar[tuple[int, int]] = (950_000, 2_100_000)
    """Range of the PLL's input after its first divisor, Hz (datasheet, 5.3.10)."""
    pll_inside: ClassVar[tuple[int, int]] = (100_000_000, 432_000_000)
    """Range of the PLL's oscillator, Hz."""
    pllcfgr_at: ClassVar[tuple[int, int]] = (0x04, 0x24003010)
    """Offset and reset value of PLLCFGR."""
    cfgr_at: ClassVar[tuple[int, int]] = (0x08, 0)
    without_effect: ClassVar[Mapping[int, str]] = {
        0x0C: "CIR", 0x10: "AHB1RSTR", 0x20: "APB1RSTR", 0x24: "APB2RSTR", 0x40: "APB1ENR", 0x44: "APB2ENR",
        0x70: "BDCR",
    }  # fmt: skip
    others: ClassVar[Mapping[int, tuple[str, int]]] = {0x30: ("AHB1ENR", 0x00100000)}
    """Names and reset values of registers that are not 0 after a reset."""

    def layout(self) -> dict[int, Register]:
        """As in `Rcc`."""
        self.cfgr = Register("CFGR", self.cfgr_at[1], on_write=self._switch)
        self._pllcfgr = Register("PLLCFGR", self.pllcfgr_at[1], on_write=self._write_pllcfgr)
        others = {offset: Register(*other) for offset, other in self.others.items()}
        own = {self.pllcfgr_at[0]: self._pllcfgr, self.cfgr_at[0]: self.cfgr}
        return plain(self.without_effect) | others | own

    def pll_source(self) -> str:
        """As in `Rcc`."""
        return HSE if self._pllcfgr.value & _F4_PLLSRC else HSI

    def pll_factors(self) -> tuple[int, int, int]:
        """The PLL's input divisor, multiplier and output divisor."""
        setting = self._pllcfgr.value
        return max(setting & 0x3F, 1), setting >> 6 & 0x1FF, ((setting >> 16 & 3) + 1) * 2

    def pll_hz(self) -> int:
        """As in `Rcc`."""
        m, n, p = self.pll_factors()
        return self._source_hz() * n // m // p

    def prescalers(self) -> tuple[int, int]:
        """As in `Rcc`."""
        return self.cfgr.value >> 10 & 7, self.cfgr.value >> 13 & 7

    def check_pll(self) -> None:
        """As in `Rcc`."""
        m, n, _ = self.pll_factors()
        fed = self._source_hz() // m
        for name, hz, (low, high) in (("input", fed, self.pll_in), ("oscillator", fed * n, self.pll_inside)):
            if not low <= hz <= high:
                raise BoardError(f"RCC CR was written to start the PLL with its {name} at {hz} Hz, not {low}..{high}")

    def _write_pllcfgr(self, value: int) -> None:
        if self.pll_is_on():
            raise BoardError("RCC PLLCFGR was written while the PLL is on")
        self._pllcfgr.value = value


class RccG4(RccF4):
    """Reset and clock control of the G4; CAN's clock is selectable."""

    csr_offset, forget, brown_out, trimmed = 0x94, 23, 0, 0
    sources = ("", HSI, HSE, PLL)
    bits: ClassVar[Mapping[str, tuple[int, int]]] = {HSI: (8, 10), HSE: (16, 17), PLL: (24, 25)}
    pll_in, pll_inside = (2_660_000, 16_000_000), (96_000_000, 344_000_000)
    pllcfgr_at, cfgr_at = (0x0C, 0x1000), (0x08, 5)
    without_effect: ClassVar[Mapping[int, str]] = {
        0x18: "CIER", 0x4C: "AHB2ENR", 0x50: "AHB3ENR", 0x5C: "APB1ENR2", 0x60: "APB2ENR",
        0x88: "CCIPR", 0x90: "BDCR",
    }  # fmt: skip
    others: ClassVar[Mapping[int, tuple[str, int]]] = {
        0x04: ("ICSCR", 0x40000000), 0x48: ("AHB1ENR", 0x100), 0x58: ("APB1ENR1", 0x400),
    }  # fmt: skip

    def pll_source(self) -> str:
        """As in `Rcc`."""
        return HSE if self._pllcfgr.value & 3 == _G4_FROM_HSE else HSI

    def pll_factors(self) -> tuple[int, int, int]:
        """As in `RccF4`."""
        setting = self._pllcfgr.value
        return (setting >> 4 & 15) + 1, setting >> 8 & 127, ((setting >> 25 & 3) + 1) * 2

    def check_pll(self) -> None:
        """As in `Rcc`."""
        super().check_pll()
        if not self._pllcfgr.value & _G4_OUTPUT_R:
            raise BoardError(
                "RCC CR was written to start the PLL without its output R, which the core's clock comes from"
            )

    def prescalers(self) -> tuple[int, int]:
        """As in `Rcc`."""
        return self.cfgr.value >> 8 & 7, self.cfgr.value >> 11 & 7

    def can_hz(self) -> int:
        """As in `Rcc`; PLLQ is not modelled."""
        choice = self.registers[0x88].value >> _G4_CAN_SHIFT & 3
        if choice == _G4_CAN_PCLK1:
            return self.apb1_hz()
        return self._oscillators.crystal if choice == 0 and self._ready(HSE) else 0

    def usart_hz(self) -> int:
        """As in `Rcc`: USART2 is on the other bus."""
        return self.apb1_hz()
