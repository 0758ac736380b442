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
    """The image did something that the hardware does not allow or that is not modelled; the message says where."""


class PowerCut(Exception):  # noqa: N818 - nothing is wrong with the board
    """The power was cut, as requested."""


@dataclass
class Register:
    """A register: plain storage, unless reads or writes have side effects.

    Attributes:
        name: As in the reference manual.
        reset_value: Value after a reset.
        on_read: Returns the value to read; None to read the last value written.
        on_write: Handles a write; None to store the value.
        steady: Whether its value changes only with events, unlike a running counter's.
        idle: Whether a write does not count as work, since it only feeds a watchdog.
        value: Current value.
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
        """Restores the reset value."""
        self.value = self.reset_value

    def read(self) -> int:
        """Returns the value that the core reads."""
        return self.value if self.on_read is None else self.on_read()

    def write(self, value: int) -> None:
        """Handles a write by the core."""
        if self.on_write is None:
            self.value = value
        else:
            self.on_write(value)


def plain(names: Mapping[int, str]) -> dict[int, Register]:
    """Registers without side effects, by their offsets."""
    return {offset: Register(name) for offset, name in names.items()}


def ignore(_value: int) -> None:
    """An `on_write` for registers whose writes have no effect."""


class Peripheral:
    """A block of registers.

    Attributes:
        name: As in the reference manual.
        registers: Registers by offset.
        clocked: Whether it has a clock; without one its registers are inaccessible.
    """

    def __init__(self, name: str, registers: Mapping[int, Register], *, clocked: bool = False) -> None:
        """Takes the registers; `clocked` is true if the peripheral has no clock gate."""
        self.name = name
        self.registers = dict(registers)
        self.clocked = clocked
        self._always_clocked = clocked

    def set_clocked(self, clocked: bool) -> None:
        """Called when its clock gate was opened or closed."""
        self.clocked = clocked

    def reset(self) -> None:
        """Restores the state after a reset of the chip."""
        self.set_clocked(self._always_clocked)
        for register in self.registers.values():
            register.reset()


class KeptRegister(Register):
    """A register stored by C in a `struct plain_block`, without side effects."""

    def __init__(self, block: Any, offset: int, name: str, reset_value: int = 0) -> None:
        """Creates a register of a block.

        Args:
            block: The `struct plain_block`.
            offset: Its offset in the block.
            name: As in the reference manual.
            reset_value: Value after a reset.
        """
        self._values, self._word = block.value, offset // _WORD
        super().__init__(name, reset_value)

    @property
    def value(self) -> int:
        """Current value."""
        return int(self._values[self._word])

    @value.setter
    def value(self, value: int) -> None:
        self._values[self._word] = value

    def clear_by_zeros(self, value: int) -> None:
        """Handles a write in which zeros clear bits."""
        self.value &= value


class KeptPeripheral(Peripheral):
    """A peripheral most of whose registers are stored by C (`register_space.h`).

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
        """Creates the peripheral in its reset state.

        Args:
            name: As in the reference manual.
            kept: Names of the registers stored by C, by offset.
            others: Registers with side effects.
            resets: Reset values of stored registers; 0 for all others.
            read_only: Offsets of stored registers whose writes are left to Python.
            zeros_clear: Offsets of stored registers in which a write only clears bits, by zeros.
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

    def get(self, offset: int) -> int:
        """The value of a register."""
        return self.registers[offset].value

    def keep_in(self, space: Any, base: int) -> None:
        """Lets a `struct register_space` access the registers without calling Python."""
        self.block.base = base
        space.blocks[space.block_count] = self.block
        space.block_count += 1


@dataclass(frozen=True)
class Window:
    """An address range of registers.

    Attributes:
        base: The first address.
        size: Number of addresses, bytes.
        read: Returns the value at (address, number of bytes).
        write: Takes (address, number of bytes, value).
        model: The `struct register_space` that is tried first; None if there is none.
    """

    base: int
    size: int
    read: Callable[[int, int], int]
    write: Callable[[int, int, int], None]
    model: Any = None


class AddressSpace:
    """The registers of all peripherals by address, for the accesses that C leaves to Python (`register_space.h`).

    Attributes:
        model: The C model, `struct register_space`, which skips time spent polling.
    """

    def __init__(self, clock: Clock) -> None:
        """Starts empty.

        Args:
            clock: The clock whose time is skipped.
        """
        ffi, self._library = c_models()
        self._clock = clock
        self._at: dict[int, tuple[Peripheral, Register]] = {}
        self._seen: dict[int, int] = {}
        self.model: Any = ffi.new("struct register_space *")
        self.model.clock = clock.model

    def attach(self, base: int, peripheral: Peripheral) -> None:
        """Maps a peripheral at a base address."""
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
            address: Address of the register.
            width: Number of bytes read at once.

        Raises:
            BoardError: No register is modelled there, its peripheral has no clock, or the read is partial.
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
        """Writes a register; arguments and errors as for `read`."""
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
