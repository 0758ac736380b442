"""The timers of STM32F1 and G4 (RM0008 14, 15; RM0440 28, 29) as a robot uses them: PWM, encoders, pulses."""

from collections.abc import Callable
from math import inf

from host_sim.emulator.clock import NEVER, SECOND, Clock
from host_sim.emulator.registers import KeptPeripheral, Register

_NAMES = {
    0x00: "CR1", 0x04: "CR2", 0x08: "SMCR", 0x0C: "DIER", 0x10: "SR", 0x18: "CCMR1", 0x1C: "CCMR2", 0x20: "CCER",
    0x24: "CNT", 0x28: "PSC", 0x2C: "ARR", 0x34: "CCR1", 0x38: "CCR2", 0x3C: "CCR3", 0x40: "CCR4",
}  # fmt: skip
_CR1, _SMCR, _DIER, _SR, _CCMR1, _CCER, _CNT, _PSC, _ARR, _RCR, _BDTR = (
    0x00, 0x08, 0x0C, 0x10, 0x18, 0x20, 0x24, 0x28, 0x2C, 0x30, 0x44,
)  # fmt: skip
_COUNT_MASK = 0xFFFF
_CEN, _UIE, _UIF, _BIF = 1, 1, 1, 1 << 7
_ENCODER_BOTH, _EXTERNAL, _FROM_INPUT_1 = 3, 7, 5
_INPUTS = 0x0303
_INPUT_1, _BOTH_INPUTS = 0x0001, 0x0101
_BREAK_ON, _BREAK_HIGH, _OUTPUTS_ON = 1 << 12, 1 << 13, 1 << 15
_FILTER_AT, _FILTER_CYCLES = 16, (0, 2, 4, 8, 12, 16, 24, 32, 48, 64, 80, 96, 128, 160, 192, 256)
_PWM_1, _MODE_MASK = 6, 7


class Timer(KeptPeripheral):
    """TIM2 to TIM4: counts edges at its inputs."""

    def __init__(self, name: str, *, wide: bool = False) -> None:
        """At rest; a wide one has 32 bits."""
        top = 0xFFFFFFFF if wide else _COUNT_MASK
        super().__init__(name, _NAMES, {0x14: Register("EGR")}, resets={_ARR: top}, zeros_clear=[_SR])

    def follows_encoder(self) -> bool:
        """Whether it is in encoder mode, counting both edges of both inputs."""
        return self._runs(_ENCODER_BOTH) and self.get(_CCMR1) & _INPUTS == _BOTH_INPUTS

    def counts_input_1(self) -> bool:
        """Whether it counts pulses at input 1."""
        from_1 = self.get(_SMCR) >> 4 & 7 == _FROM_INPUT_1
        return self._runs(_EXTERNAL) and from_1 and self.get(_CCMR1) & 3 == _INPUT_1

    def count(self, more: int) -> None:
        """Counts up, or down if negative."""
        self.registers[_CNT].value = (self.get(_CNT) + more) % (self.get(_ARR) + 1)

    def _runs(self, mode: int) -> bool:
        return bool(self.get(_CR1) & _CEN) and self.get(_SMCR) & 7 == mode


class MotorTimer(KeptPeripheral):
    """TIM1: PWM of the motors, and an update event after a number of periods.

    Attributes:
        on_update: Called at each update event.
    """

    def __init__(
        self, clock: Clock, bus_hz: Callable[[], int], pend: Callable[[], None], *, filters: bool = False
    ) -> None:
        """At rest.

        Args:
            clock: The board's clock.
            bus_hz: Returns its clock frequency, Hz.
            pend: Makes its update interrupt pending.
            filters: Whether it can filter its break input, as a G4's can.
        """
        self._clock, self._bus_hz, self._pend, self._filters = clock, bus_hz, pend, filters
        self.on_update: Callable[[], None] = lambda: None
        self._next = NEVER
        self._cr1, self._bdtr = Register("CR1", on_write=self._write_cr1), Register("BDTR")
        kept = {offset: name for offset, name in _NAMES.items() if offset != _CR1} | {_RCR: "RCR"}
        others = {0x00: self._cr1, 0x14: Register("EGR", on_write=self._generate), _BDTR: self._bdtr}
        super().__init__("TIM1", kept, others, resets={_ARR: _COUNT_MASK}, zeros_clear=[_SR])
        self._set_alarm = clock.add(self._due)

    def reset(self) -> None:
        """As in `Peripheral`."""
        super().reset()
        self._next = NEVER
        self._set_alarm(NEVER)

    def duty(self, output: str) -> float:
        """Fraction of time for which an output is high, 0..1; if it is a complementary one, it is on alone.

        Args:
            output: Its name, such as ch1, or ch2n if it is complementary.
        """
        channel, enable = int(output[2]), 2 if output.endswith("n") else 0
        mode = self.get(0x18 + 4 * (channel > 2)) >> (4 if channel % 2 else 12) & _MODE_MASK  # noqa: PLR2004
        enabled = self.get(_CCER) >> 4 * (channel - 1) + enable & 1
        on = enabled and self._bdtr.value & _OUTPUTS_ON and self._cr1.value & _CEN
        if not on or mode != _PWM_1:
            return 0.0
        return min(self.get(0x30 + 4 * channel) / (self.get(_ARR) + 1), 1.0)

    def break_at(self, *, low: bool, lasts_s: float = inf) -> None:
        """Sets the level at its break input; if it is no spike, it disables the outputs in hardware."""
        cycles = _FILTER_CYCLES[self._bdtr.value >> _FILTER_AT & 15] if self._filters else 0
        if lasts_s < cycles / self._bus_hz():
            return
        if self._bdtr.value & _BREAK_ON and low != bool(self._bdtr.value & _BREAK_HIGH):
            self._bdtr.value &= ~_OUTPUTS_ON
            self.registers[_SR].value |= _BIF

    def period(self) -> int:
        """Time from one update event to the next, fs."""
        cycles = (self.get(_PSC) + 1) * (self.get(_ARR) + 1) * (self.get(_RCR) + 1)
        return cycles * (SECOND // self._bus_hz())

    def _write_cr1(self, value: int) -> None:
        started = value & ~self._cr1.value & _CEN
        self._cr1.value = value
        if started:
            self._next = self._clock.now + self.period()
        elif not value & _CEN:
            self._next = NEVER
        self._set_alarm(self._next)

    def _generate(self, value: int) -> None:
        self.registers[_SR].value |= value & _UIF

    def _due(self) -> int:
        if self._next <= self._clock.now:
            self._next += self.period()
            self.registers[_SR].value |= _UIF
            if self.get(_DIER) & _UIE:
                self._pend()
            self.on_update()
        return self._next
