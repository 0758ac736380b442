"""From addresses to registers."""

from host_sim.emulator.clock import SECOND, Clock
from host_sim.emulator.errors import BoardError
from host_sim.emulator.registers import Peripheral, Register

WAITING_READS = 8
"""Reads in a row that bring nothing new, after which the image counts as waiting."""

_WORD = 4
_SKIP_MAX = SECOND // 1000
"""What is skipped at most before the image looks again, since it may be the time itself that it waits for."""


class AddressSpace:
    """The registers of all peripherals by address.

    Sees when the image only waits, and skips that time. It waits when it reads the same again and again and looks at
    the time in between; one that counts its looks instead is left to do so.
    """

    def __init__(self, clock: Clock) -> None:
        """Begins empty.

        Args:
            clock: Whose time is skipped.
        """
        self._clock = clock
        self._at: dict[int, tuple[Peripheral, Register]] = {}
        self._seen: dict[int, int] = {}
        self._old_news = 0
        self._looks_at_time = False

    def attach(self, base: int, peripheral: Peripheral) -> None:
        """Puts a peripheral there."""
        for offset, register in peripheral.registers.items():
            self._at[base + offset] = peripheral, register

    def read(self, address: int, width: int) -> int:
        """Reads a register.

        Args:
            address: Where it is.
            width: Bytes read at once.

        Raises:
            BoardError: None is modelled there, its peripheral has no clock, or it is not read as a whole.
        """
        register = self._find(address, width, "read")
        value = register.read()
        if register.steady:
            self._note(address, value)
        else:
            self._looks_at_time = True
        return value

    def write(self, address: int, width: int, value: int) -> None:
        """Writes a register; as `read`."""
        register = self._find(address, width, "written")
        if not register.idle:
            self._begin_anew()
        register.write(value)

    def _find(self, address: int, width: int, how: str) -> Register:
        found = self._at.get(address)
        if found is None:
            raise BoardError(f"0x{address:08X} was {how}, where no register is modelled{self._neighbour(address)}")
        peripheral, register = found
        if not peripheral.clocked:
            raise BoardError(f"{peripheral.name} {register.name} was {how}, but {peripheral.name} has no clock")
        if width != _WORD:
            raise BoardError(f"{peripheral.name} {register.name} was {how} by {width} bytes, where it has {_WORD}")
        return register

    def _note(self, address: int, value: int) -> None:
        if self._seen.get(address) != value:
            self._seen[address] = value
            self._begin_anew()
            return
        self._old_news += 1
        if self._old_news > WAITING_READS and self._looks_at_time:
            self._begin_anew()
            self._clock.skip_to(min(self._clock.horizon, self._clock.now + _SKIP_MAX))

    def _begin_anew(self) -> None:
        self._old_news, self._looks_at_time = 0, False

    def _neighbour(self, address: int) -> str:
        before = max((known for known in self._at if known <= address), default=None)
        if before is None:
            return ""
        peripheral, register = self._at[before]
        return f" (0x{before:08X} is {peripheral.name} {register.name})"
