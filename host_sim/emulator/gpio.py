"""General purpose pins: what is written shows, nothing is joined to them."""

from host_sim.emulator.registers import Peripheral, Register

_PINS = 0xFFFF


class Gpio(Peripheral):
    """One port.

    Attributes:
        output: ODR: the levels that it drives.
    """

    def __init__(self, name: str, setup: dict[int, Register], *, data: int, lock: int) -> None:
        """All pins are inputs.

        Args:
            name: Of the port.
            setup: The family's registers for modes and functions, by offset.
            data: Offset of IDR; ODR and BSRR follow.
            lock: Offset of LCKR.
        """
        self.output = Register("ODR")
        super().__init__(
            name,
            setup
            | {
                data: Register("IDR", on_read=lambda: self.output.value),
                data + 4: self.output,
                data + 8: Register("BSRR", on_write=self._write_bsrr),
                lock: Register("LCKR"),
            },
        )

    def level(self, pin: int) -> bool:
        """Whether a pin is driven high."""
        return bool(self.output.value >> pin & 1)

    def clear(self, pins: int) -> None:
        """Drives pins low."""
        self.output.value &= ~pins

    def _write_bsrr(self, value: int) -> None:
        self.clear(value >> 16)
        self.output.value |= value & _PINS


def gpio_f1(name: str) -> Gpio:
    """A port of the STM32F1 (RM0008 9.2)."""
    setup = {
        0x00: Register("CRL", 0x44444444),
        0x04: Register("CRH", 0x44444444),
    }
    port = Gpio(name, setup, data=0x08, lock=0x18)
    port.registers[0x14] = Register("BRR", on_write=port.clear)
    return port


def gpio_f4(name: str) -> Gpio:
    """A port of the STM32F4 (RM0090 8.4)."""
    names = {0x00: "MODER", 0x04: "OTYPER", 0x08: "OSPEEDR", 0x0C: "PUPDR", 0x20: "AFRL", 0x24: "AFRH"}
    return Gpio(name, {offset: Register(name) for offset, name in names.items()}, data=0x10, lock=0x1C)
