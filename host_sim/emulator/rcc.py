"""Reset and clock control: the part common to all families."""

from abc import abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar

from host_sim.emulator.clock import SECOND, Clock
from host_sim.emulator.registers import BoardError, Peripheral, Register

HSI, HSE, PLL = "HSI", "HSE", "PLL"
"""The oscillators."""

_STARTUP = {HSI: 0, PLL: SECOND // 5000}
"""Time from ON to READY; that of the crystal is in `RccFaults`."""

_HPRE_SHIFT = 4
_ALL_FLAGS = 0xFE000000
RESET_FLAGS = {"power": 1 << 27 | 1 << 26, "software": 1 << 28 | 1 << 26, "watchdog": 1 << 29 | 1 << 26}
"""CSR flags by cause of reset; each cause also sets the pin flag."""


@dataclass(frozen=True)
class RccFaults:
    """Faults of the clocks.

    Attributes:
        crystal_dead: Whether the external oscillator never starts.
        pll_dead: Whether the PLL never locks.
        crystal_s: Time that the external oscillator takes to start, s.
    """

    crystal_dead: bool = False
    pll_dead: bool = False
    crystal_s: float = 0.001


@dataclass(frozen=True)
class Oscillators:
    """Frequencies, Hz.

    Attributes:
        internal: HSI.
        crystal: HSE.
        core_max: Fastest core clock that the chip allows.
        apb1_max: Fastest clock of the slower peripheral bus.
        apb2_max: Fastest clock of the faster peripheral bus.
    """

    internal: int
    crystal: int
    core_max: int
    apb1_max: int
    apb2_max: int


class Rcc(Peripheral):
    """Generates the clocks, and gates those of the peripherals."""

    cfgr: Register
    csr_offset: int
    sources: ClassVar[Sequence[str]] = (HSI, HSE, PLL)
    """The sources of the core clock, as numbered by SW in CFGR."""
    bits: ClassVar[Mapping[str, tuple[int, int]]] = {HSI: (0, 1), HSE: (16, 17), PLL: (24, 25)}
    """Bit numbers of ON and READY of each source in CR."""
    forget: ClassVar[int] = 24
    """Bit RMVF of CSR."""
    brown_out: ClassVar[int] = 0
    """Flag of CSR that a loss of power sets, too."""
    trimmed: ClassVar[int] = 0x80
    """What is set in CR after a reset beside HSI's bits."""

    def __init__(
        self, clock: Clock, oscillators: Oscillators, flash_hz: Callable[[], int], faults: RccFaults
    ) -> None:
        """Creates the clocks in their power-up state.

        Args:
            clock: The board's clock.
            oscillators: Frequencies of the oscillators.
            flash_hz: Returns the fastest core clock that the flash allows with its current settings, Hz.
            faults: Faults to simulate.
        """
        self._clock, self._oscillators, self._flash_hz = clock, oscillators, flash_hz
        self._dead = {source for source, dead in ((HSE, faults.crystal_dead), (PLL, faults.pll_dead)) if dead}
        self._startup = _STARTUP | {HSE: round(faults.crystal_s * SECOND)}
        self._ready_at: dict[str, int] = {}
        self._gates: dict[tuple[int, int], Peripheral] = {}
        self._cr = Register(
            "CR", self.trimmed | 1 << self.bits[HSI][0], on_read=self._read_cr, on_write=self._write_cr
        )
        self._csr = Register("CSR", on_write=self._write_csr)
        super().__init__("RCC", {0x00: self._cr, self.csr_offset: self._csr, **self.layout()}, clocked=True)
        self.restart("power")

    @abstractmethod
    def layout(self) -> dict[int, Register]:
        """The other registers of the family by offset, among them `cfgr`."""

    @abstractmethod
    def pll_source(self) -> str:
        """The oscillator selected as the PLL's source."""

    @abstractmethod
    def pll_hz(self) -> int:
        """The PLL's configured output frequency, Hz."""

    def check_pll(self) -> None:
        """Checks the setup of the PLL when it is switched on.

        Raises:
            BoardError: It cannot lock with this setup.
        """

    @abstractmethod
    def prescalers(self) -> tuple[int, int]:
        """Fields PPRE1 and PPRE2 of CFGR."""

    def add_gate(self, peripheral: Peripheral, offset: int, bit: int) -> None:
        """Adds a clock gate: the peripheral is clocked while the bit of the register is set."""
        self._gates[offset, bit] = peripheral
        register = self.registers[offset]
        register.on_write = lambda value: self._write_gates(offset, value)

    def restart(self, cause: str) -> None:
        """Resets the chip, and adds the cause to the flags noted since the image last cleared them.

        Args:
            cause: A key of `RESET_FLAGS`.
        """
        if cause == "power":
            self._csr.value = self.brown_out
        self.reset()
        self._csr.value |= RESET_FLAGS[cause]

    def reset(self) -> None:
        """As in `Peripheral`; the noted causes are kept."""
        noted = self._csr.value & _ALL_FLAGS
        super().reset()
        self._csr.value = noted
        self._ready_at = {HSI: self._clock.now}
        self._clock.set_hz(self._oscillators.internal)

    def core_hz(self) -> int:
        """Frequency of the core clock, Hz."""
        return self._hclk()

    def follows_crystal(self) -> bool:
        """Whether the core clock is derived from the crystal, and thus exact."""
        source = self.sources[self.cfgr.value >> 2 & 3]
        return (self.pll_source() if source == PLL else source) == HSE

    def can_hz(self) -> int:
        """Frequency of CAN's clock, Hz."""
        return self.apb1_hz()

    def usart_hz(self) -> int:
        """Frequency of the serial port's clock, Hz."""
        return self.apb2_hz()

    def adc_hz(self) -> int:
        """Frequency of the clock that the ADC's prescaler divides, Hz."""
        return self.core_hz()

    def apb1_hz(self) -> int:
        """Frequency of the slower peripheral bus, Hz."""
        return self._hclk() >> max(self.prescalers()[0] - 3, 0)

    def apb2_hz(self) -> int:
        """Frequency of the faster peripheral bus, Hz."""
        return self._hclk() >> max(self.prescalers()[1] - 3, 0)

    def pll_is_on(self) -> bool:
        """Whether the PLL is switched on: its setup is locked then."""
        return bool(self._cr.value >> self.bits[PLL][0] & 1)

    def _source_hz(self) -> int:
        return self._oscillators.crystal if self.pll_source() == HSE else self._oscillators.internal

    def _write_gates(self, offset: int, value: int) -> None:
        self.registers[offset].value = value
        for (at, bit), peripheral in self._gates.items():
            if at == offset:
                peripheral.set_clocked(bool(value >> bit & 1))

    def _ready(self, source: str) -> bool:
        return self._clock.now >= self._ready_at.get(source, self._clock.now + 1)

    def _read_cr(self) -> int:
        return self._cr.value | sum(1 << ready for source, (_, ready) in self.bits.items() if self._ready(source))

    def _write_cr(self, value: int) -> None:
        starts_pll = value & ~self._cr.value & 1 << self.bits[PLL][0]
        if any(not value >> self.bits[source][0] & 1 for source in self._in_use()):
            raise BoardError("RCC CR was written to stop the clock that the core runs from")
        if starts_pll and not self._ready(self.pll_source()):
            raise BoardError("RCC CR was written to start the PLL from an oscillator that does not run")
        if starts_pll:
            self.check_pll()
        self._cr.value = value & ~sum(1 << ready for _, ready in self.bits.values())
        for source, (on, _) in self.bits.items():
            if not value >> on & 1:
                self._ready_at.pop(source, None)
            elif source not in self._ready_at and source not in self._dead:
                self._ready_at[source] = self._clock.now + self._startup[source]

    def _in_use(self) -> set[str]:
        source = self.sources[self.cfgr.value >> 2 & 3]
        return {source, self.pll_source()} if source == PLL else {source}

    def _switch(self, value: int) -> None:
        """Writes CFGR: SWS follows SW if the selected clock runs."""
        source = value & 3
        if not self._ready(self.sources[source]):
            source = self.cfgr.value >> 2 & 3
        # The new source takes effect at once, the new divisors some cycles later.
        self.cfgr.value = self.cfgr.value & ~0xF | value & 3 | source << 2
        self.check_speeds()
        self.cfgr.value = value & ~0xC | source << 2
        self.check_speeds()
        self._clock.set_hz(self._hclk())

    def check_speeds(self) -> None:
        """Checks all clock limits; called whenever a clock or a limit changes.

        Raises:
            BoardError: A clock is faster than its limit.
        """
        limits = {
            "core": (self._hclk(), self._oscillators.core_max),
            "core, with the flash's wait states,": (self._hclk(), self._flash_hz()),
            "APB1": (self.apb1_hz(), self._oscillators.apb1_max),
            "APB2": (self.apb2_hz(), self._oscillators.apb2_max),
        }
        for name, (hz, limit) in limits.items():
            if hz > limit:
                raise BoardError(f"the clocks were set so that the {name} runs at {hz} Hz, where {limit} is allowed")

    def _hclk(self) -> int:
        source = self.sources[self.cfgr.value >> 2 & 3]
        speeds = {HSI: self._oscillators.internal, HSE: self._oscillators.crystal}
        hz = self.pll_hz() if source == PLL else speeds[source]
        divisor = self.cfgr.value >> _HPRE_SHIFT & 0xF
        return hz >> max(divisor - 7, 0)

    def _write_csr(self, value: int) -> None:
        """Writes CSR; its low bits are ON and READY of the slow oscillator."""
        slow = value & 1
        noted = 0 if value >> self.forget & 1 else self._csr.value & _ALL_FLAGS
        self._csr.value = noted | slow | slow << 1
