"""GPIO ports: the mode of each pin, and the level driven from outside."""

from abc import abstractmethod
from collections.abc import Callable, Mapping
from typing import ClassVar

from host_sim.emulator.c_models import c_models
from host_sim.emulator.registers import KeptPeripheral, Register

_PINS = range(16)
_ALL = 0xFFFF


class Port(KeptPeripheral):
    """A GPIO port.

    Attributes:
        output: ODR, the levels that the port drives.
        changed: Called when the mode of a pin may have changed.
    """

    def __init__(self, name: str, modes: Mapping[int, Register], data: int) -> None:
        """Creates a port in its reset state, with nothing connected.

        Args:
            name: Name of the port, such as GPIOA.
            modes: The family's registers for modes, pulls and alternate functions, by offset.
            data: Offset of IDR, followed by ODR, BSRR and one more register.
        """
        self.changed: Callable[[], object] = lambda: None
        self._driven = self._levels = self._plain = 0
        idr, odr, bsrr = data, data + 4, data + 8
        kept = {idr: "IDR", odr: "ODR", bsrr: "BSRR"}
        super().__init__(name, kept, modes, read_only=[idr, odr])
        _, library = c_models()
        self.block.readable &= ~(1 << bsrr // 4)
        self.block.write[bsrr // 4] = library.SPACE_SETS_PINS
        self.output, self._input = self.registers[odr], self.registers[idr]
        self.registers[bsrr].on_write = self._write_bsrr
        self.registers[idr].on_write = lambda _value: None
        self.registers[odr].on_write = self._write_odr
        for register in modes.values():
            register.on_write = register.on_write or self._mode_writer(register)

    @abstractmethod
    def outputs(self) -> tuple[int, int]:
        """Bit masks of the output pins, and of those that ODR alone drives, both high and low."""

    @abstractmethod
    def pulled_up(self) -> int:
        """Bit mask of the pins with a pull-up enabled."""

    @abstractmethod
    def serves(self, pin: int, function: int, *, out: bool) -> bool:
        """Whether a pin is connected to a peripheral, by alternate function number if the chip has those."""

    @abstractmethod
    def measures(self, pin: int) -> bool:
        """Whether a pin is connected to the ADC."""

    def reset(self) -> None:
        """As in `Peripheral`."""
        super().reset()
        self.settle()
        self.changed()

    def level(self, pin: int) -> bool:
        """Whether a pin is driven high."""
        return bool(self.output.value >> pin & 1)

    def drives(self, pin: int) -> bool:
        """Whether a pin is a general-purpose output, and high."""
        return bool(self._plain & self.output.value & 1 << pin)

    def drive(self, pin: int, *, high: bool) -> None:
        """Drives a pin from outside."""
        levels = self._levels & ~(1 << pin) | high << pin
        if levels != self._levels or not self._driven >> pin & 1:
            self._driven |= 1 << pin
            self._levels = levels
            self.settle()

    def clear(self, pins: int) -> None:
        """Drives pins low."""
        self._write_odr(self.output.value & ~pins)

    def settle(self) -> None:
        """Updates the inputs from modes and levels: a floating input reads its pull, or low."""
        outputs, self._plain = self.outputs()
        outside = self._levels & self._driven | self.pulled_up() & ~self._driven
        self.block.outputs = outputs
        self._input.value = outside & ~outputs | self.output.value & outputs

    def _write_bsrr(self, value: int) -> None:
        self._write_odr(self.output.value & ~(value >> 16) | value & _ALL)

    def _write_odr(self, value: int) -> None:
        self.output.value = value & _ALL
        self.settle()

    def _mode_writer(self, register: Register) -> Callable[[int], None]:
        def write(value: int) -> None:
            register.value = value
            self.settle()
            self.changed()

        return write


class GpioF1(Port):
    """A port of an STM32F1 (RM0008 9): four mode bits per pin; AFIO routes the alternate functions."""

    _FLOATING, _PUSH_PULL, _ALTERNATE, _PULLED = 0x44444444, 0, 2, 2

    def __init__(self, name: str) -> None:
        """Starts with all pins floating."""
        self._modes = [Register(it, self._FLOATING) for it in ("CRL", "CRH")]
        modes = dict(zip((0x00, 0x04), self._modes, strict=True))
        super().__init__(
            name, modes | {0x14: Register("BRR", on_write=self.clear), 0x18: Register("LCKR")}, data=0x08
        )

    def mode(self, pin: int) -> int:
        """The four bits of a pin's mode."""
        return self._modes[pin // 8].value >> 4 * (pin % 8) & 15

    def outputs(self) -> tuple[int, int]:
        """As in `Port`."""
        outputs = sum(bool(self.mode(pin) & 3) << pin for pin in _PINS)
        return outputs, sum((self.mode(pin) >> 2 == self._PUSH_PULL) << pin for pin in _PINS) & outputs

    def pulled_up(self) -> int:
        """As in `Port`; ODR selects the direction of a pull."""
        return self.output.value & sum((self.mode(pin) >> 2 == self._PULLED) << pin for pin in _PINS)

    def serves(self, pin: int, function: int, *, out: bool) -> bool:  # noqa: ARG002 - AFIO has them
        """As in `Port`; a peripheral's input needs a pin in input mode."""
        kind = self.mode(pin) >> 2
        if not out:
            return self.mode(pin) & 3 == 0 and kind in {1, self._PULLED}
        return self.mode(pin) & 3 != 0 and kind >= self._ALTERNATE

    def measures(self, pin: int) -> bool:
        """As in `Port`."""
        return self.mode(pin) == 0


class GpioF4(Port):
    """A port of an STM32F4 (RM0090 8.4): a mode, a pull and an alternate function number for each pin."""

    _OUTPUT, _ALTERNATE, _ANALOG, _UP = 1, 2, 3, 1
    resets: ClassVar[Mapping[str, int]] = {"GPIOA": 0xA8000000, "GPIOB": 0x00000280}
    """MODER after a reset: the debugger's pins are in use."""
    speeds: ClassVar[Mapping[str, int]] = {"GPIOB": 0xC0}
    pulls: ClassVar[Mapping[str, int]] = {"GPIOA": 0x64000000, "GPIOB": 0x100}
    other_resets = 0

    def __init__(self, name: str) -> None:
        """Creates the port in its reset state."""
        self._mode = Register("MODER", self.resets.get(name, self.other_resets))
        speed = Register("OSPEEDR", self.speeds.get(name, 0))
        self._pull = Register("PUPDR", self.pulls.get(name, 0))
        self._functions = [Register("AFRL"), Register("AFRH")]
        self._open_drain = Register("OTYPER")
        modes = {0x00: self._mode, 0x04: self._open_drain, 0x08: speed, 0x0C: self._pull}
        modes |= {0x1C: Register("LCKR"), 0x20: self._functions[0], 0x24: self._functions[1]}
        super().__init__(name, modes, data=0x10)

    def _with(self, register: Register, wanted: int) -> int:
        return sum((register.value >> 2 * pin & 3 == wanted) << pin for pin in _PINS)

    def outputs(self) -> tuple[int, int]:
        """As in `Port`."""
        plain = self._with(self._mode, self._OUTPUT)
        return plain | self._with(self._mode, self._ALTERNATE), plain & ~self._open_drain.value

    def pulled_up(self) -> int:
        """As in `Port`."""
        return self._with(self._pull, self._UP)

    def serves(self, pin: int, function: int, *, out: bool) -> bool:  # noqa: ARG002 - either way, the function says it
        """As in `Port`."""
        given = self._functions[pin // 8].value >> 4 * (pin % 8) & 15
        return self._mode.value >> 2 * pin & 3 == self._ALTERNATE and given == function

    def measures(self, pin: int) -> bool:
        """As in `Port`."""
        return self._mode.value >> 2 * pin & 3 == self._ANALOG


class GpioG4(GpioF4):
    """A port of an STM32G4 (RM0440 9.4): pins are analogue after a reset."""

    resets: ClassVar[Mapping[str, int]] = {"GPIOA": 0xABFFFFFF, "GPIOB": 0xFFFFFEBF}
    speeds: ClassVar[Mapping[str, int]] = {"GPIOA": 0x0C000000, "GPIOB": 0xC0}
    other_resets = 0xFFFFFFFF
