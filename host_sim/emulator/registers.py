"""What all models have in common: registers at offsets."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

Reader = Callable[[], int]
Writer = Callable[[int], None]


@dataclass
class Register:
    """One register: plain storage, unless reading or writing it does more.

    Attributes:
        name: As in the reference manual.
        reset_value: What it holds after a reset.
        on_read: Gives what is read; None: what was written.
        on_write: Takes what is written; None: it is kept.
        steady: Its value tells what has happened; a running counter's tells only the time.
        idle: Writing it is no sign of work: a watchdog's food.
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

    def reset(self) -> None:
        """As after a reset of the chip."""
        self.clocked = self._always_clocked
        for register in self.registers.values():
            register.reset()
