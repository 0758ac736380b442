"""The ports of an STM32F1 (RM0008 9): each pin with a mode of its own, and what drives it from outside."""

from collections.abc import Callable

from host_sim.emulator.board_pins import ADC, Pins, place_of
from host_sim.emulator.c_models import c_models
from host_sim.emulator.registers import KeptPeripheral, Register

_CRL, _CRH, _IDR, _ODR, _BSRR = 0x00, 0x04, 0x08, 0x0C, 0x10
_FLOATING, _PULLED, _PINS = 0x44444444, 2, 0xFFFF
_ALTERNATE = 2
_JTAG, _SWJ_SHIFT, _NO_JTAG = ("PA15", "PB3", "PB4"), 24, (2, 4)
_ROLES_OUT = ("tx", "ch1n", "ch2n", "ch3n")


class GpioF1(KeptPeripheral):
    """One port.

    Attributes:
        output: ODR: the levels that it drives.
        changed: Called when the mode of a pin may have changed.
    """

    def __init__(self, name: str) -> None:
        """All pins float.

        Args:
            name: The port's, such as GPIOA.
        """
        self.changed: Callable[[], object] = lambda: None
        self._driven = self._levels = self._plain = 0
        self._modes = [Register(it, _FLOATING, on_write=self._mode_writer(n)) for n, it in enumerate(("CRL", "CRH"))]
        others = {
            _CRL: self._modes[0],
            _CRH: self._modes[1],
            0x14: Register("BRR", on_write=self.clear),
            0x18: Register("LCKR"),
        }
        kept = {_IDR: "IDR", _ODR: "ODR", _BSRR: "BSRR"}
        super().__init__(name, kept, others, read_only=[_IDR, _ODR])
        _, library = c_models()
        self.block.readable &= ~(1 << _BSRR // 4)
        self.block.write[_BSRR // 4] = library.SPACE_SETS_PINS
        self.output, self._input = self.registers[_ODR], self.registers[_IDR]
        self.registers[_BSRR].on_write = self._write_bsrr
        self.registers[_IDR].on_write = lambda _value: None
        self.registers[_ODR].on_write = self._write_odr

    def reset(self) -> None:
        """As in `Peripheral`."""
        super().reset()
        self._settle()

    def mode(self, pin: int) -> int:
        """The four bits of a pin's mode."""
        return self._modes[pin // 8].value >> 4 * (pin % 8) & 15

    def level(self, pin: int) -> bool:
        """Whether a pin is driven high."""
        return bool(self.output.value >> pin & 1)

    def drives(self, pin: int) -> bool:
        """Whether a pin is a plain output, and high."""
        return bool(self._plain & self.output.value & 1 << pin)

    def drive(self, pin: int, *, high: bool) -> None:
        """Something outside drives a pin."""
        levels = self._levels & ~(1 << pin) | high << pin
        if levels != self._levels or not self._driven >> pin & 1:
            self._driven |= 1 << pin
            self._levels = levels
            self._settle()

    def clear(self, pins: int) -> None:
        """Drives pins low."""
        self._write_odr(self.output.value & ~pins)

    def _write_bsrr(self, value: int) -> None:
        self._write_odr(self.output.value & ~(value >> 16) | value & _PINS)

    def _write_odr(self, value: int) -> None:
        self.output.value = value & _PINS
        self._settle()

    def _mode_writer(self, number: int) -> Callable[[int], None]:
        def write(value: int) -> None:
            self._modes[number].value = value
            self._settle()
            self.changed()

        return write

    def _settle(self) -> None:
        """An open input reads its pull, or low."""
        modes = [self.mode(pin) for pin in range(16)]
        outputs = sum(bool(mode & 3) << pin for pin, mode in enumerate(modes))
        pulled = sum((mode >> 2 == _PULLED) << pin for pin, mode in enumerate(modes))
        self._plain = sum((bool(mode & 3) and mode >> 2 < _ALTERNATE) << pin for pin, mode in enumerate(modes))
        outside = self._levels & self._driven | self.output.value & pulled & ~self._driven
        self.block.outputs = outputs
        self._input.value = outside & ~outputs | self.output.value & outputs


class Wiring:
    """Whether the signals of a board meet, at the pins that they are wired to, what the image uses there."""

    def __init__(self, pins: Pins, ports: list[GpioF1], mapr: Register) -> None:
        """Follows the ports' modes and AFIO_MAPR.

        Args:
            pins: The board's.
            ports: From A.
            mapr: AFIO_MAPR.
        """
        self.pins, self._mapr, self._pins = pins, mapr, dict(pins.signals)
        self._known: dict[str, bool] = {}
        places = {signal: place_of(pin) for signal, pin in pins.signals.items()}
        self._ports = ports
        self._places = {signal: (ports[port], number) for signal, (port, number) in places.items()}
        for port in ports:
            port.changed = self._known.clear
        mapr.on_write = self._write_mapr

    def port(self, signal: str) -> tuple[GpioF1, int]:
        """The port of a signal, and the number of its pin there."""
        return self._places[signal]

    def rewire(self, signal: str, pin: str = "") -> None:
        """Takes a wire to another pin, such as PB4, or pulls it off."""
        self._pins[signal] = pin
        self._known.clear()

    def meets(self, signal: str) -> bool:
        """Whether the pin of a signal is what the drivers use for it."""
        if signal not in self._known:
            self._known[signal] = self._meets(signal)
        return self._known[signal]

    def _meets(self, signal: str) -> bool:
        pin, use = self._pins[signal], self.pins.chip.signals[signal]
        if not pin:
            return False
        port, number = place_of(pin)
        mode = self._ports[port].mode(number)
        if use == ADC:
            return mode == 0 and pin == self.pins.signals[signal]
        if pin in _JTAG and self._mapr.value >> _SWJ_SHIFT & 7 not in _NO_JTAG:
            return False
        out = use.split()[1] in _ROLES_OUT
        fits = mode & 3 and mode >> 2 >= _ALTERNATE if out else mode & 3 == 0 and mode >> 2 in {1, _PULLED}
        return bool(fits) and self.pins.chip.pin_of(use, self._mapr.value) == pin

    def _write_mapr(self, value: int) -> None:
        self._mapr.value = value
        self._known.clear()
