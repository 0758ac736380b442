"""The A/D converters of STM32F1 (RM0008 11) and G4 (RM0440 21), and the DMA that stores their samples."""

from abc import abstractmethod
from collections.abc import Callable, Mapping, Sequence

from host_sim.emulator.clock import SECOND, Clock
from host_sim.emulator.registers import BoardError, Peripheral, Register, plain

_ADON, _CONT, _CALIBRATE, _FORGET, _DMA, _SCAN = 1, 1 << 1, 1 << 2, 1 << 3, 1 << 8, 1 << 8
_CALIBRATIONS, _LOOKS = _CALIBRATE | _FORGET, 2
_BEGIN, _SOFTWARE = 1 << 22, 7 << 17 | 1 << 20
_SAMPLE_MAX, _PLACES_MAX = 4095, 6
_G4_ON, _G4_START, _G4_REGULATOR, _G4_ASLEEP, _G4_CALIBRATE = 1, 1 << 2, 1 << 28, 1 << 29, 1 << 31
_G4_REGULATED = 20 * SECOND // 10**6
_G4_CFGR, _G4_NO_QUEUE, _G4_DIVISORS = 1 << 13 | 3, 1 << 31, (0, 1, 2, 4)
_G4_ISR, _G4_SQR1, _G4_CCR, _ADC1_REQUEST = 0x00, 0x30, 0x308, 5
_CHANNEL_ON, _CIRCULAR, _MINC, _HALVES = 1, 1 << 5, 1 << 7, 1 << 8 | 1 << 10
_CCR, _CNDTR, _CPAR, _CMAR, _STRIDE = 0x08, 0x0C, 0x10, 0x14, 20


class Multiplexer(Peripheral):
    """DMAMUX (RM0440 13): selects the request that each DMA channel serves."""

    def __init__(self) -> None:
        """No request is selected."""
        super().__init__("DMAMUX", {4 * channel: Register(f"C{channel}CR") for channel in range(12)})

    def serves_converter(self) -> bool:
        """Whether channel 1 of DMA1 serves ADC1."""
        return self.registers[0].value == _ADC1_REQUEST


class Dma(Peripheral):
    """DMA1."""

    def __init__(self, multiplexer: Multiplexer | None = None) -> None:
        """At rest.

        Args:
            multiplexer: Selects its requests; None if channel 1 always serves ADC1.
        """
        self._multiplexer = multiplexer
        names = {0x00: "ISR", 0x04: "IFCR"}
        for channel in range(7):
            names |= {at + _STRIDE * channel: f"C{n}{channel + 1}" for at, n in ((_CCR, "CR"), (_CNDTR, "NDTR"))}
            names |= {at + _STRIDE * channel: f"C{n}{channel + 1}" for at, n in ((_CPAR, "PAR"), (_CMAR, "MAR"))}
        super().__init__("DMA1", plain(names))

    def target(self, source: int) -> tuple[int, int] | None:
        """Target of channel 1 in circular mode, address and half-word count; None if it does not copy `source`."""
        if self._multiplexer is not None and not self._multiplexer.serves_converter():
            return None
        control, count, peripheral, memory = (self.registers[at].value for at in (_CCR, _CNDTR, _CPAR, _CMAR))
        wanted = _CHANNEL_ON | _CIRCULAR | _MINC | _HALVES
        return (memory, count) if control & wanted == wanted and peripheral == source else None


class Converter(Peripheral):
    """ADC1 in continuous scan mode."""

    data: int
    """Offset of the data register DR."""
    hz_max: int

    def __init__(
        self, base: int, hz: Callable[[], int], dma: Dma, clock: Clock, registers: Mapping[int, Register]
    ) -> None:
        """At rest.

        Args:
            base: Base address.
            hz: Returns its clock frequency, Hz.
            dma: Stores its samples.
            clock: The board's clock.
            registers: Registers by offset.
        """
        self._base, self._hz, self._dma, self._clock = base, hz, dma, clock
        self._begun = False
        super().__init__("ADC1", registers)

    @abstractmethod
    def order(self) -> Sequence[int]:
        """The channels of a scan, in order."""

    def switch_on(self) -> None:
        """Switches it on.

        Raises:
            BoardError: The clock is too fast.
        """
        if not 0 < self._hz() <= self.hz_max:
            raise BoardError(f"ADC1 was switched on at {self._hz()} Hz, where {self.hz_max} is allowed")

    def reset(self) -> None:
        """As in `Peripheral`."""
        super().reset()
        self._begun = False

    def convert(self, volts: Mapping[int, int]) -> tuple[int, bytes] | None:
        """The result of a scan in memory: address and bytes; None if it is not running.

        Args:
            volts: Sample of each channel, 0..4095; channels not listed read 0.
        """
        target = self._dma.target(self._base + self.data) if self._begun else None
        if target is None:
            return None
        order = self.order()
        if len(order) != target[1] or len(order) > _PLACES_MAX:
            raise BoardError(f"ADC1 converts {len(order)} channels in a scan, but DMA1 transfers {target[1]}")
        samples = (min(volts.get(channel, 0), _SAMPLE_MAX) for channel in order)
        return target[0], b"".join(sample.to_bytes(2, "little") for sample in samples)


class ConverterF1(Converter):
    """ADC1 of an STM32F1. Calibration takes a few reads of its flag."""

    data, hz_max = 0x4C, 14_000_000

    def __init__(self, base: int, hz: Callable[[], int], dma: Dma, clock: Clock) -> None:
        """As in `Converter`."""
        self._calibrated = self._looks = 0
        self._cr2 = Register("CR2", on_read=self._read_cr2, on_write=self._write_cr2)
        names = {0x00: "SR", 0x04: "CR1", 0x0C: "SMPR1", 0x10: "SMPR2", 0x2C: "SQR1", 0x30: "SQR2", 0x34: "SQR3"}
        registers = plain({**names, self.data: "DR"})
        super().__init__(base, hz, dma, clock, {**registers, 0x08: self._cr2})

    def reset(self) -> None:
        """As in `Peripheral`."""
        super().reset()
        self._calibrated = self._looks = 0

    def order(self) -> Sequence[int]:
        """As in `Converter`."""
        places = (self.registers[0x2C].value >> 20 & 15) + 1
        return [self.registers[0x34].value >> 5 * place & 31 for place in range(places)]

    def _read_cr2(self) -> int:
        self._looks -= 1
        if self._looks <= 0:
            self._cr2.value &= ~_CALIBRATIONS
        return self._cr2.value

    def _write_cr2(self, value: int) -> None:
        before = self._cr2.value
        if value & _ADON:
            self.switch_on()
        if value & _CALIBRATIONS and not before & _ADON:
            raise BoardError("ADC1 was calibrated before it was switched on")
        if before & _CALIBRATIONS:
            raise BoardError("ADC1 was told to continue while it was still calibrating")
        if value & _CALIBRATIONS:
            self._calibrated = value & _CALIBRATIONS | (self._calibrated if value & _CALIBRATE else 0)
            self._looks = _LOOKS
        if value & _BEGIN and self._calibrated != _CALIBRATIONS:
            raise BoardError("ADC1 was started before it was calibrated")
        set_up = _ADON | _CONT | _DMA | _SOFTWARE
        begins = value & before & set_up == set_up and value & _BEGIN
        self._begun = bool(begins and self.registers[0x04].value & _SCAN)
        self._cr2.value = value


class ConverterG4(Converter):
    """ADC1 of an STM32G4. All operations complete at once, but for the start of its regulator."""

    data, hz_max = 0x40, 60_000_000

    def __init__(self, base: int, hz: Callable[[], int], dma: Dma, clock: Clock) -> None:
        """As in `Converter`, with the frequency of its bus."""
        self._regulated_at = 0
        self._cr = Register("CR", _G4_ASLEEP, on_write=self._write_cr)
        names = {0x10: "CFGR2", 0x14: "SMPR1", 0x18: "SMPR2", 0x30: "SQR1", 0x34: "SQR2"}
        registers = plain({**names, _G4_CCR: "CCR", self.data: "DR"})
        registers[0x0C] = Register("CFGR", _G4_NO_QUEUE)
        isr = Register("ISR", on_read=lambda: self._cr.value & _G4_ON)
        super().__init__(base, lambda: self._divided(hz()), dma, clock, {**registers, _G4_ISR: isr, 0x08: self._cr})

    def order(self) -> Sequence[int]:
        """As in `Converter`: six bits per entry, the first entry for the number of entries."""
        fields = self.registers[_G4_SQR1].value | self.registers[_G4_SQR1 + 4].value << 30
        return [fields >> 6 * place & 31 for place in range(1, (fields & 15) + 2)]

    def _divided(self, bus_hz: int) -> int:
        divisor = _G4_DIVISORS[self.registers[_G4_CCR].value >> 16 & 3]
        return bus_hz // divisor if divisor else 0

    def _write_cr(self, value: int) -> None:
        before = self._cr.value
        on = (value | before) & _G4_ON
        if value & ~before & _G4_REGULATOR:
            self._regulated_at = self._clock.now + _G4_REGULATED
        regulated = before & _G4_REGULATOR and self._clock.now >= self._regulated_at
        if (on or value & _G4_CALIBRATE) and not regulated:
            raise BoardError("ADC1 was switched on or calibrated before its regulator had been on for 20 us")
        if value & _G4_CALIBRATE and before & _G4_ON:
            raise BoardError("ADC1 was calibrated while it was on")
        if value & _G4_ON:
            self.switch_on()
        self._begun = bool(value & before & _G4_ON and value & _G4_START) and (
            self.registers[0x0C].value & _G4_CFGR == _G4_CFGR
        )
        self._cr.value = value & ~_G4_CALIBRATE | on
