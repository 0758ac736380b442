"""Reset and clock control: what both families have alike."""

from abc import abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from host_sim.emulator.clock import SECOND, Clock
from host_sim.emulator.errors import BoardError
from host_sim.emulator.registers import Peripheral, Register

_STARTUP = {0: 0, 16: SECOND // 1000, 24: SECOND // 5000}
"""Time from an oscillator's ON bit in CR, by its number, to the READY bit above it: HSI, HSE, PLL."""

HSE_ON, PLL_ON = 16, 24
_SOURCES = (0, HSE_ON, PLL_ON)
_HPRE_SHIFT = 4
_RMVF = 1 << 24
_ALL_FLAGS = 0xFE000000
RESET_FLAGS = {"power": 1 << 27 | 1 << 26, "software": 1 << 28 | 1 << 26, "watchdog": 1 << 29 | 1 << 26}
"""Flags of CSR by the cause of a reset; each drives the reset pin too."""


@dataclass(frozen=True)
class RccFaults:
    """How the clocks can misbehave.

    Attributes:
        crystal_dead: The external oscillator never starts.
        pll_dead: The PLL never locks.
    """

    crystal_dead: bool = False
    pll_dead: bool = False


@dataclass(frozen=True)
class Oscillators:
    """Speeds in Hz.

    Attributes:
        internal: HSI.
        crystal: HSE.
        core_max: Fastest core clock that the chip allows.
        apb1_max: The same for the slower peripheral bus.
    """

    internal: int
    crystal: int
    core_max: int
    apb1_max: int


class Rcc(Peripheral):
    """Makes the clocks, and opens their gates."""

    cfgr: Register
    csr_offset: int

    def __init__(
        self,
        registers: Mapping[int, Register],
        clock: Clock,
        oscillators: Oscillators,
        flash_hz: Callable[[], int],
        faults: RccFaults,
    ) -> None:
        """As after power-up.

        Args:
            registers: What the family adds, by offset; CFGR is among them.
            clock: Of the core.
            oscillators: Their speeds.
            flash_hz: Gives the fastest clock that the flash can follow as it is set up.
            faults: How it misbehaves.
        """
        self._clock, self._oscillators, self._flash_hz = clock, oscillators, flash_hz
        self._dead = {bit for bit, dead in ((HSE_ON, faults.crystal_dead), (PLL_ON, faults.pll_dead)) if dead}
        self._ready_at: dict[int, int] = {}
        self._gates: dict[tuple[int, int], Peripheral] = {}
        self._cr = Register("CR", 1, on_read=self._read_cr, on_write=self._write_cr)
        self._csr = Register("CSR", on_write=self._write_csr)
        super().__init__("RCC", {0x00: self._cr, self.csr_offset: self._csr, **registers}, clocked=True)
        self.restart("power")

    @abstractmethod
    def pll_hz(self, internal: int, crystal: int) -> int:
        """The PLL's speed as it is set up, from the speeds of its sources."""

    @abstractmethod
    def prescalers(self) -> tuple[int, int]:
        """Fields PPRE1 and PPRE2 of CFGR."""

    def add_gate(self, offset: int, bit: int, peripheral: Peripheral) -> None:
        """A peripheral has a clock while that bit of that register is set."""
        self._gates[offset, bit] = peripheral
        register = self.registers[offset]
        register.on_write = lambda value: self._write_gates(offset, value)

    def restart(self, cause: str) -> None:
        """A reset of the chip: `reset`, and its cause is added to those noted since the image last cleared them.

        Args:
            cause: A key of `RESET_FLAGS`.
        """
        if cause == "power":
            self._csr.value = 0
        self.reset()
        self._csr.value |= RESET_FLAGS[cause]

    def reset(self) -> None:
        """As in `Peripheral`; the causes noted stay."""
        noted = self._csr.value & _ALL_FLAGS
        super().reset()
        self._csr.value = noted
        self._ready_at = {0: self._clock.now}
        self._clock.set_hz(self._oscillators.internal)

    def apb1_hz(self) -> int:
        """Speed of the bus that CAN hangs on."""
        return self._hclk() >> max(self.prescalers()[0] - 3, 0)

    def apb2_hz(self) -> int:
        """Speed of the bus that USART1 hangs on."""
        return self._hclk() >> max(self.prescalers()[1] - 3, 0)

    def _write_gates(self, offset: int, value: int) -> None:
        self.registers[offset].value = value
        for (at, bit), peripheral in self._gates.items():
            if at == offset:
                peripheral.clocked = bool(value >> bit & 1)

    def _ready(self, source: int) -> bool:
        return self._clock.now >= self._ready_at.get(source, self._clock.now + 1)

    def _read_cr(self) -> int:
        return self._cr.value | sum(2 << source for source in _SOURCES if self._ready(source))

    def _write_cr(self, value: int) -> None:
        self._cr.value = value & ~sum(2 << source for source in _SOURCES)
        for source in _SOURCES:
            if not value >> source & 1:
                self._ready_at.pop(source, None)
            elif source not in self._ready_at and source not in self._dead:
                self._ready_at[source] = self._clock.now + _STARTUP[source]

    def _switch(self, value: int) -> None:
        """Takes a new CFGR: SWS follows SW if that clock runs."""
        source = value & 3
        if not self._ready(_SOURCES[source]):
            source = self.cfgr.value >> 2 & 3
        self.cfgr.value = value & ~0xC | source << 2
        self._check_speeds()
        self._clock.set_hz(self._hclk())

    def _check_speeds(self) -> None:
        limits = {
            "core": (self._hclk(), self._oscillators.core_max),
            "core, with the flash's wait states,": (self._hclk(), self._flash_hz()),
            "APB1": (self.apb1_hz(), self._oscillators.apb1_max),
        }
        for name, (hz, limit) in limits.items():
            if hz > limit:
                raise BoardError(f"RCC CFGR was written so that the {name} runs at {hz} Hz, where {limit} is allowed")

    def _hclk(self) -> int:
        oscillators = self._oscillators
        internal, crystal = oscillators.internal, oscillators.crystal
        source = self.cfgr.value >> 2 & 3
        hz = (internal, crystal, self.pll_hz(internal, crystal) if source > 1 else 0)[source]
        divisor = self.cfgr.value >> _HPRE_SHIFT & 0xF
        return hz >> max(divisor - 7, 0)

    def _write_csr(self, value: int) -> None:
        """The low bits are the slow oscillator's: on, and ready."""
        slow = value & 1
        noted = 0 if value & _RMVF else self._csr.value & _ALL_FLAGS
        self._csr.value = noted | slow | slow << 1
