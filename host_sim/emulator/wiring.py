"""Checks that a board's signals are wired to the pins that the image uses for them."""

from collections.abc import Sequence

from host_sim.emulator.board_pins import ADC, Pins, place_of
from host_sim.emulator.ports import Port
from host_sim.emulator.registers import Register

_JTAG, _SWJ_SHIFT, _NO_JTAG = ("PA15", "PB3", "PB4"), 24, (2, 4)


class Wiring:
    """The wiring of a board."""

    def __init__(self, pins: Pins, ports: Sequence[Port], mapr: Register | None) -> None:
        """Takes the wiring, and tracks the ports' modes and AFIO_MAPR.

        Args:
            pins: The board's pins.
            ports: The GPIO ports, from A.
            mapr: AFIO_MAPR; None for chips whose pins select their functions.
        """
        self.pins, self._mapr, self._pins = pins, mapr, dict(pins.signals)
        self._known: dict[str, bool] = {}
        self._ports = ports
        for port in ports:
            port.changed = self._known.clear
        if mapr is not None:
            mapr.on_write = self._write_mapr

    def port(self, signal: str) -> tuple[Port, int]:
        """The port and pin number of a signal."""
        port, number = place_of(self.pins.signals[signal])
        return self._ports[port], number

    def rewire(self, signal: str, pin: str = "") -> None:
        """Moves a wire to another pin, such as PB4, or removes it."""
        self._pins[signal] = pin
        self._known.clear()

    def meets(self, *signals: str) -> bool:
        """Whether signals are wired to the pins that the drivers use for them."""
        for signal in signals:
            if signal not in self._known:
                self._known[signal] = self._meets(signal)
        return all(self._known[signal] for signal in signals)

    def _meets(self, signal: str) -> bool:
        pin, use, chip = self._pins[signal], self.pins.chip.signals[signal], self.pins.chip
        if not pin:
            return False
        at, number = place_of(pin)
        port = self._ports[at]
        if use == ADC:
            return port.measures(number) and pin == self.pins.signals[signal]
        if self._mapr is None:
            function = chip.function_of(use, pin)
            return function is not None and port.serves(number, function, out=False)
        if pin in _JTAG and self._mapr.value >> _SWJ_SHIFT & 7 not in _NO_JTAG:
            return False
        peripheral, role = use.split()
        out = role == "tx" or (peripheral == "TIM1" and role != "bkin")
        return port.serves(number, 0, out=out) and chip.pin_of(use, self._mapr.value) == pin

    def _write_mapr(self, value: int) -> None:
        assert self._mapr is not None  # without AFIO it is never written
        self._mapr.value = value
        self._known.clear()
