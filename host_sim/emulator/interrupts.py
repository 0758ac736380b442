"""The core's interrupt controller (PM0056 4.3), with one priority for all interrupts."""

from collections.abc import Callable

from host_sim.emulator.registers import Peripheral, Register

_WORDS = 2
"""Number of registers, each for 32 interrupts."""


class Interrupts(Peripheral):
    """Tracks which interrupts are enabled and which are pending.

    Attributes:
        on_pending: Called when an enabled interrupt is pending.
    """

    def __init__(self) -> None:
        """Starts with none enabled or pending."""
        self.on_pending: Callable[[], None] = lambda: None
        self._enabled = self._pending = 0
        registers = {}
        for word in range(_WORDS):
            registers[0x000 + 4 * word] = self._register(f"ISER{word}", 32 * word, 1, 0)
            registers[0x080 + 4 * word] = self._register(f"ICER{word}", 32 * word, -1, 0)
            registers[0x100 + 4 * word] = self._register(f"ISPR{word}", 32 * word, 0, 1)
            registers[0x180 + 4 * word] = self._register(f"ICPR{word}", 32 * word, 0, -1)
        super().__init__("NVIC", registers, clocked=True)

    def reset(self) -> None:
        """As in `Peripheral`."""
        super().reset()
        self._enabled = self._pending = 0

    def pend(self, number: int) -> None:
        """Makes an interrupt pending."""
        self._pending |= 1 << number
        self._tell()

    def acknowledge(self) -> int | None:
        """Returns the lowest number of an enabled pending interrupt, which then is pending no longer."""
        due = self._enabled & self._pending
        lowest = due & -due
        self._pending &= ~lowest
        return lowest.bit_length() - 1 if due else None

    @property
    def wakes(self) -> bool:
        """Whether an enabled interrupt is pending."""
        return bool(self._enabled & self._pending)

    def _tell(self) -> None:
        if self.wakes:
            self.on_pending()

    def _register(self, name: str, shift: int, enabled: int, pending: int) -> Register:
        """A register in which ones set (1) or clear (-1) enable or pending bits."""

        def on_write(value: int) -> None:
            bits = value << shift
            if enabled:
                self._enabled = self._enabled | bits if enabled > 0 else self._enabled & ~bits
            if pending:
                self._pending = self._pending | bits if pending > 0 else self._pending & ~bits
            self._tell()

        def on_read() -> int:
            return (self._enabled if enabled else self._pending) >> shift & 0xFFFFFFFF

        return Register(name, on_read=on_read, on_write=on_write)
