"""The analogue to digital converter of an STM32F1 and the DMA that carries its samples off (RM0008 11, 13)."""

from collections.abc import Callable, Mapping

from host_sim.emulator.registers import BoardError, Peripheral, Register

_ADON, _CONT, _CALIBRATIONS, _DMA, _SCAN = 1, 1 << 1, 1 << 2 | 1 << 3, 1 << 8, 1 << 8
_BEGIN, _SOFTWARE = 1 << 22, 7 << 17 | 1 << 20
_HZ_MAX, _SAMPLE_MAX, _PLACES_MAX = 14_000_000, 4095, 6
_CHANNEL_ON, _CIRCULAR, _MINC, _HALVES = 1, 1 << 5, 1 << 7, 1 << 8 | 1 << 10
_CCR, _CNDTR, _CPAR, _CMAR, _STRIDE = 0x08, 0x0C, 0x10, 0x14, 20


class Dma(Peripheral):
    """DMA1."""

    def __init__(self) -> None:
        """At rest."""
        names = {0x00: "ISR", 0x04: "IFCR"}
        for channel in range(7):
            names |= {at + _STRIDE * channel: f"C{n}{channel + 1}" for at, n in ((_CCR, "CR"), (_CNDTR, "NDTR"))}
            names |= {at + _STRIDE * channel: f"C{n}{channel + 1}" for at, n in ((_CPAR, "PAR"), (_CMAR, "MAR"))}
        super().__init__("DMA1", {offset: Register(name) for offset, name in names.items()})

    def target(self, source: int) -> tuple[int, int] | None:
        """Where channel 1 puts half-words from a register, and how many, round and round; None if it does not."""
        control, count, peripheral, memory = (self.registers[at].value for at in (_CCR, _CNDTR, _CPAR, _CMAR))
        wanted = _CHANNEL_ON | _CIRCULAR | _MINC | _HALVES
        return (memory, count) if control & wanted == wanted and peripheral == source else None


class Converter(Peripheral):
    """ADC1, converting one channel after the other, over and over."""

    def __init__(self, base: int, bus_hz: Callable[[], int], divisor: Callable[[], int], dma: Dma) -> None:
        """At rest.

        Args:
            base: Its address.
            bus_hz: Gives the speed of its bus.
            divisor: Gives what its own clock is divided by.
            dma: Carries its samples off.
        """
        self._base, self._bus_hz, self._divisor, self._dma = base, bus_hz, divisor, dma
        names = {
            0x00: "SR",
            0x04: "CR1",
            0x0C: "SMPR1",
            0x10: "SMPR2",
            0x2C: "SQR1",
            0x30: "SQR2",
            0x34: "SQR3",
            0x4C: "DR",
        }
        self._cr2 = Register("CR2", on_write=self._write_cr2)
        super().__init__("ADC1", {offset: Register(name) for offset, name in names.items()} | {0x08: self._cr2})
        self._calibrated = self._begun = False

    def reset(self) -> None:
        """As in `Peripheral`."""
        super().reset()
        self._calibrated = self._begun = False

    def convert(self, volts: Mapping[int, int]) -> tuple[int, bytes] | None:
        """What a round of it leaves in memory: where, and what; None if it does not run.

        Args:
            volts: What each channel measures, 0..4095; another one measures nothing.
        """
        if not self._begun:
            return None
        target = self._dma.target(self._base + 0x4C)
        if target is None:
            return None
        places = (self.registers[0x2C].value >> 20 & 15) + 1
        if places != target[1] or places > _PLACES_MAX:
            raise BoardError(f"ADC1 converts {places} channels in a round, and DMA1 carries {target[1]} off")
        order = self.registers[0x34].value
        samples = (min(volts.get(order >> 5 * place & 31, 0), _SAMPLE_MAX) for place in range(places))
        return target[0], b"".join(sample.to_bytes(2, "little") for sample in samples)

    def _write_cr2(self, value: int) -> None:
        hz = self._bus_hz() // self._divisor()
        if value & _ADON and hz > _HZ_MAX:
            raise BoardError(f"ADC1 was switched on at {hz} Hz, where {_HZ_MAX} is allowed")
        if value & _CALIBRATIONS and not self._cr2.value & _ADON:
            raise BoardError("ADC1 was calibrated before it was switched on")
        self._calibrated = self._calibrated or bool(value & 1 << 2)
        whole = _ADON | _CONT | _DMA | _SOFTWARE | _BEGIN
        self._begun = value & whole == whole and bool(self.registers[0x04].value & _SCAN)
        self._cr2.value = value & ~_CALIBRATIONS
