"""Registers at addresses: the base of all peripheral models."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from host_sim.base.errors import RobotError
from host_sim.emulator.c_models import c_models
from host_sim.emulator.clock import Clock

Reader = Callable[[], int]
Writer = Callable[[int], None]

_WORD = 4


class BoardError(RobotError):
    """The image did what the hardware does not allow or what is not modelled; the message says where."""


class PowerCut(Exception):  # noqa: N818 - nothing is wrong with the board
    """The power was cut, as requested."""


@dataclass
class Register:
    """One register: plain storage, unless reading or writing it does more.

    Attributes:
        name: As in the reference manual.
        reset_value: What it holds after a reset.
        on_read: Gives what is read; None for what was written.
        on_write: Takes what is written; None to keep it.
        steady: Its value tells what has happened; a running counter's tells only the time.
        idle: Writing it does not count as work: feeding a watchdog.
        value: What it holds.
    """

    name: str
    reset_value: int = 0
    on_read: Reader | None = None
    on_write: Writer | None = None
    steady: bool = True
    idle: bool = False
    value: int = field(init=False)

    def __post_init__(self) -> None:
        self.reset()

    def reset(self) -> None:
        """Takes its value after a reset."""
        self.value = self.reset_value

    def read(self) -> int:
        """What the core reads."""
        return self.value if self.on_read is None else self.on_read()

    def write(self, value: int) -> None:
        """What the core writes."""
        if self.on_write is None:
            self.value = value
        else:
            self.on_write(value)


def ignore(_value: int) -> None:
    """A writer for what can be written without effect."""


class Peripheral:
    """A block of registers.

    Attributes:
        name: As in the reference manual.
        registers: By their offset.
        clocked: Whether it has a clock; without one no register can be reached.
    """

    def __init__(self, name: str, registers: Mapping[int, Register], *, clocked: bool = False) -> None:
        """Collects the registers; `clocked` where no gate is before it."""
        self.name = name
        self.registers = dict(registers)
        self.clocked = clocked
        self._always_clocked = clocked

    def set_clocked(self, clocked: bool) -> None:
        """Its gate was opened or closed."""
        self.clocked = clocked

    def reset(self) -> None:
        """As after a reset of the chip."""
        self.set_clocked(self._always_clocked)
        for register in self.registers.values():
            register.reset()


class KeptRegister(Register):
    """A register that C keeps, in a `struct plain_block`: it only holds what is put there."""

    def __init__(self, block: Any, offset: int, name: str, reset_value: int = 0) -> None:
        """One of a block.

        Args:
            block: The `struct plain_block`.
            offset: Its offset there.
            name: As in the reference manual.
            reset_value: What it holds after a reset.
        """
        self._values, self._word = block.value, offset // _WORD
        super().__init__(name, reset_value)

    @property
    def value(self) -> int:
        """What it holds."""
        return int(self._values[self._word])

    @value.setter
    def value(self, value: int) -> None:
        self._values[self._word] = value

    def clear_by_zeros(self, value: int) -> None:
        """Keeps the bits that are set in both."""
        self.value &= value


class KeptPeripheral(Peripheral):
    """A peripheral most of whose registers C keeps (`register_space.h`).

    Attributes:
        block: The `struct plain_block`.
    """

    def __init__(  # noqa: PLR0913 - each by its name
        self,
        name: str,
        kept: Mapping[int, str],
        others: Mapping[int, Register] = {},
        *,
        resets: Mapping[int, int] = {},
        read_only: Sequence[int] = (),
        zeros_clear: Sequence[int] = (),
    ) -> None:
        """After a reset.

        Args:
            name: As in the reference manual.
            kept: The registers that C keeps, by offset.
            others: Those that do more.
            resets: What kept ones hold after a reset; 0 for all others.
            read_only: Offsets of those whose writes are left to Python.
            zeros_clear: Offsets of those in which a write clears bits, and sets none.
        """
        ffi, library = c_models()
        self.block: Any = ffi.new("struct plain_block *")
        registers = {
            offset: KeptRegister(self.block, offset, it, resets.get(offset, 0)) for offset, it in kept.items()
        }
        for offset in kept:
            self.block.readable |= 1 << offset // _WORD
            self.block.writable |= (offset not in read_only) << offset // _WORD
        for offset in zeros_clear:
            self.block.write[offset // _WORD] = library.SPACE_ZEROS_CLEAR
            registers[offset].on_write = registers[offset].clear_by_zeros
        super().__init__(name, {**registers, **others})

    def set_clocked(self, clocked: bool) -> None:
        """As in `Peripheral`."""
        super().set_clocked(clocked)
        self.block.clocked = clocked

    def keep_in(self, space: Any, base: int) -> None:
        """Has a `struct register_space` access the registers without Python."""
        self.block.base = base
        space.blocks[space.block_count] = self.block
        space.block_count += 1


@dataclass(frozen=True)
class Window:
    """A range of addresses at which there are registers.

    Attributes:
        base: The first address.
        size: Number of addresses, bytes.
        read: Gives the value at (address, number of bytes).
        write: Takes (address, number of bytes, value).
        model: The `struct register_space` that is asked first; None if there is none.
    """

    base: int
    size: int
    read: Callable[[int, int], int]
    write: Callable[[int, int, int], None]
    model: Any = None


class AddressSpace:
    """The registers of all peripherals by address, for all accesses that C leaves to Python (`register_space.h`).

    Attributes:
        model: The C model, `struct register_space`, which skips the time in which the image only waits.
    """

    def __init__(self, clock: Clock) -> None:
        """Begins empty.

        Args:
            clock: Whose time is skipped.
        """
        ffi, self._library = c_models()
        self._clock = clock
        self._at: dict[int, tuple[Peripheral, Register]] = {}
        self._seen: dict[int, int] = {}
        self.model: Any = ffi.new("struct register_space *")
        self.model.clock = clock.model

    def attach(self, base: int, peripheral: Peripheral) -> None:
        """Puts a peripheral there."""
        for offset, register in peripheral.registers.items():
            self._at[base + offset] = peripheral, register

    def watch(self) -> None:
        """Leaves every access to Python from now on, so that `Register.on_read` and `on_write` may be replaced."""
        self.model.direct = False
        for address in self._at:
            word = self._library.space_can_word((address - self.model.can_base) % 2**32)
            if word < len(self.model.seen) and self.model.seen[word].known:
                self._seen[address] = self.model.seen[word].value

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
            self._library.space_note(self.model, self._seen.get(address) != value)
            self._seen[address] = value
            self._clock.raise_failure()
        else:
            self._library.space_note_time(self.model)
        return value

    def write(self, address: int, width: int, value: int) -> None:
        """Writes a register; as `read`."""
        register = self._find(address, width, "written")
        if not register.idle:
            self._library.space_begin_anew(self.model)
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

    def _neighbour(self, address: int) -> str:
        before = max((known for known in self._at if known <= address), default=None)
        if before is None:
            return ""
        peripheral, register = self._at[before]
        return f" (0x{before:08X} is {peripheral.name} {register.name})"
