"""The processor core: Unicorn, connected to the clock and the registers. No other file uses Unicorn."""

import struct
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any, cast

from host_sim.base.c_interface import c_interface
from host_sim.base.errors import OctetError
from host_sim.base.extra_library import missing
from host_sim.emulator.c_models import c_models
from host_sim.emulator.clock import Clock
from host_sim.emulator.registers import BoardError, Window

try:
    import unicorn as uc
    from unicorn import arm_const as arm
    from unicorn.unicorn import Uc, UcError
    from unicorn.unicorn_py3.unicorn import uclib
except ImportError as error:
    raise OctetError(missing("unicorn", "emulator")) from error

PAGE = 0x1000
_THUMB = 1
_TRANSLATED_MAX = 16 << 20
"""Size of the buffer for translated code, bytes. Unicorn's default is 1 GB, which not every machine has."""

_STACKED = tuple(getattr(arm, f"UC_ARM_REG_{name}") for name in ("R0", "R1", "R2", "R3", "R12", "LR", "PC", "XPSR"))
"""Registers that the hardware stacks on exception entry, from the lowest address."""

REGISTERS = (*(f"r{number}" for number in range(13)), "sp", "lr", "pc", "xpsr")
"""The core's registers as a debugger numbers them."""

_NUMBERED = [getattr(arm, f"UC_ARM_REG_{name.upper()}") for name in REGISTERS]
_PC = REGISTERS.index("pc")
_RETURN_TO_THREAD = 0xFFFFFFF9
_NMI, _HARD_FAULT, _FIRST_INTERRUPT = 2, 3, 16
_IBUSERR, _PRECISERR, _STKERR, _UNDEFINSTR, _INVSTATE = 1 << 8, 1 << 9, 1 << 12, 1 << 16, 1 << 17
_WFI = b"\x30\xbf"


@dataclass(frozen=True)
class Fault:
    """A fault exception of the core.

    Attributes:
        cause: Bits of CFSR.
        address: The address that could not be accessed; None if the instruction itself is invalid.
        pc: Address of the instruction.
    """

    cause: int
    address: int | None
    pc: int


@cache
def unicorn_calls() -> Any:
    """Unicorn's functions that take C callbacks, and the one called most, as declared in its header."""
    return c_interface(
        "int uc_emu_start(void *uc, uint64_t begin, uint64_t until, uint64_t timeout, size_t count);"
        "int uc_emu_stop(void *uc);"
        "int uc_mem_read(void *uc, uint64_t address, void *bytes, uint64_t size);"
        "int uc_hook_add("
        "    void *uc, size_t *hook, int type, void *callback, void *data, uint64_t first, uint64_t last, ...);"
        "int uc_mmio_map("
        "    void *uc, uint64_t address, uint64_t size, void *read, void *read_data, void *write, void *write_data);"
    )


def _check(status: int) -> None:
    if status != uc.UC_ERR_OK:
        raise cast("Any", UcError)(status)  # UcError lacks types


class Core:
    """Executes the image. One instruction takes one cycle.

    Attributes:
        on_fault: Called when the image faults; then its hard fault handler runs.
        vectors: Address of the current vector table.
        wakes: Returns whether an event ends its sleep after WFI.
        acknowledge: Returns the number of the pending interrupt that is taken next, which then is pending no longer;
            None if there is none.
        on_exception: Called with the number of the active exception when it changes; 0 for none.
        halts: Whether it halts before the next instruction, for a debugger.
        on_halt: Called where it halts; returns whether to halt again after one instruction.
        is_halt_asked: Returns whether a debugger asks for a halt; called often.
        breakpoints: The addresses at which it halts, with Unicorn's hooks for them.
    """

    def __init__(self, clock: Clock, vectors: int) -> None:
        """Creates a core without memory.

        Args:
            clock: The board's clock, which instructions advance.
            vectors: Address of the vector table after a reset.
        """
        self.on_fault: Callable[[Fault], None] = lambda _fault: None
        self.wakes: Callable[[], bool] = lambda: True
        self.acknowledge: Callable[[], int | None] = lambda: None
        self.on_exception: Callable[[int], None] = lambda _number: None
        self.halts, self._is_at_breakpoint = False, False
        self.on_halt: Callable[[], bool] = lambda: False
        self.is_halt_asked: Callable[[], bool] = lambda: False
        self.breakpoints: dict[int, Any] = {}
        self._resumed_at: int | None = None
        self._nmi = False
        self._active: list[tuple[int, int]] = []  # exceptions, with the stack pointers of what they interrupted
        self._clock, self._begin = clock, vectors
        self.vectors = vectors
        self._in_fault = False
        self._unreachable: int | None = None
        self._pc = 0
        self._asleep = False
        unicorn = cast("Any", Uc)  # half of its methods lack types
        self._uc = unicorn(uc.UC_ARCH_ARM, uc.UC_MODE_THUMB | uc.UC_MODE_MCLASS)
        self._uc.ctl_set_tcg_buffer_size(_TRANSLATED_MAX)
        self._uc.hook_add(uc.UC_HOOK_MEM_INVALID, self._on_unreachable)
        self._ffi, self._models = c_models()
        self._library: Any = unicorn_calls().dlopen(uclib._name)
        self._engine: Any = self._ffi.cast("void *", self._uc._uch.value)
        self._kept: list[Any] = []
        self._blocks = self._hook_blocks()

    @property
    def instructions(self) -> int:
        """Number of instructions executed so far."""
        executed: int = self._blocks.instructions
        return executed

    def add_ram(self, base: int, size: int) -> None:
        """Adds memory that can be read, written and executed."""
        self._uc.mem_map(base, size)

    def add_rom(self, base: int, contents: bytes) -> None:
        """Adds memory that can be read and executed, in whole pages."""
        self._uc.mem_map(base, len(contents), uc.UC_PROT_READ | uc.UC_PROT_EXEC)
        self._uc.mem_write(base, contents)

    def add_registers(self, window: Window) -> None:
        """Adds registers, in whole pages."""
        ffi, models = self._ffi, self._models
        made: Any = ffi.new("struct register_window *")
        on_read = ffi.callback("uint64_t(uint32_t, uint32_t)", window.read, onerror=self._clock.fail)
        on_write = ffi.callback("void(uint32_t, uint32_t, uint32_t)", window.write, onerror=self._clock.fail)
        made.clock, made.space, made.base = self._clock.model, window.model or ffi.NULL, window.base
        made.read, made.write = on_read, on_write
        self._kept += [made, on_read, on_write]
        read, write = (ffi.addressof(models, name) for name in ("window_read", "window_write"))
        _check(self._library.uc_mmio_map(self._engine, window.base, window.size, read, made, write, made))

    def write(self, address: int, data: bytes) -> None:
        """Writes to memory from outside the core."""
        self._uc.mem_write(address, data)

    def reset(self) -> None:
        """Starts at the reset vector."""
        self._asleep = False
        self._in_fault = self._nmi = False
        self._blocks.counted_to = 0
        self._active.clear()
        self._uc.reg_write(arm.UC_ARM_REG_PRIMASK, 0)
        self.vectors = self._begin
        self._uc.reg_write(arm.UC_ARM_REG_SP, self._word(self.vectors))
        self._uc.reg_write(arm.UC_ARM_REG_LR, 0xFFFFFFFF)
        self._pc = self._word(self.vectors + 4)

    def derail(self, address: int, stack: int | None = None) -> None:
        """Makes the core continue at another address, optionally with another stack, as after a bit error."""
        self._pc = address
        if stack is not None:
            self._uc.reg_write(arm.UC_ARM_REG_SP, stack)

    def interrupt(self) -> None:
        """Requests the non-maskable interrupt, taken at the end of the current basic block."""
        self._nmi = True
        self.stop()

    def request(self) -> None:
        """Notes that an enabled interrupt is pending: taken at the end of the current basic block, unless masked."""
        if self._takes_interrupts():
            self.stop()

    def stop(self) -> None:
        """Ends `run` soon."""
        self._blocks.stopping = True

    def run(self) -> None:
        """Executes until `stop`.

        Raises:
            BoardError: The core locked up, or a model refused an access.
            PowerCut: The power was cut during a flash operation.
        """
        self._blocks.stopping = False
        self._take_exception()
        self.halts = self.halts or self.is_halt_asked()
        while not self._blocks.stopping or self._blocks.counted_to:
            if self._asleep:
                self._sleep()
                continue
            self._resumed_at = self._pc & ~_THUMB if self.halts else None
            self.halts = self.halts and self.on_halt()
            self._execute(1 if self.halts else 0)

    def _execute(self, count: int) -> None:
        """Executes a number of instructions; 0: until something ends that."""
        begin = self._pc & ~_THUMB
        try:
            _check(self._library.uc_emu_start(self._engine, self._pc | _THUMB, 0, 0, count))
        except UcError as error:
            self._pc = self._uc.reg_read(arm.UC_ARM_REG_PC)
            self._blocks.counted_to = 0
            self._end_block(error)
            return
        self._pc = self._uc.reg_read(arm.UC_ARM_REG_PC)
        self._clock.raise_failure()
        if self._is_at_breakpoint or (count and begin < self._pc < self._blocks.end):
            self._blocks.counted_to = self._blocks.end
        self._asleep = not self._is_at_breakpoint and self._uc.mem_read(self._pc - len(_WFI), len(_WFI)) == _WFI
        self._is_at_breakpoint = False

    def register(self, number: int) -> int:
        """The value of one of `REGISTERS` while it is halted; raises ValueError if there is no such register."""
        if number >= len(REGISTERS):
            raise ValueError(number)
        value: int = self._pc & ~_THUMB if number == _PC else self._uc.reg_read(_NUMBERED[number])
        return value

    def set_register(self, number: int, value: int) -> None:
        """Changes a register; otherwise as `register`."""
        if value == self.register(number):
            return
        self._uc.reg_write(_NUMBERED[number], value)
        if number == _PC:
            self._pc, self._asleep, self._blocks.counted_to = value, False, 0

    def read(self, address: int, size: int) -> bytes:
        """Reads memory; raises ValueError if not all of it is. Registers are not read: reading changes some."""
        self._check_memory(address, size, uc.UC_PROT_READ)
        return bytes(self._uc.mem_read(address, size))

    def write_ram(self, address: int, data: bytes) -> None:
        """Writes memory; raises ValueError if not all of it can be written by the image, too."""
        self._check_memory(address, len(data), uc.UC_PROT_WRITE)
        self._uc.mem_write(address, data)

    def _check_memory(self, address: int, size: int, access: int) -> None:
        access |= uc.UC_PROT_EXEC  # which registers lack
        regions = [(begin, end) for begin, end, allowed in self._uc.mem_regions() if allowed & access == access]
        if not any(begin <= address and address + size - 1 <= end for begin, end in regions):
            raise ValueError(address)

    def add_breakpoint(self, address: int) -> None:
        """Makes it halt before it executes the instruction there."""
        if address not in self.breakpoints:
            self.breakpoints[address] = self._uc.hook_add(
                uc.UC_HOOK_CODE, self._on_breakpoint, None, address, address
            )
            self._uc.ctl_flush_tb()

    def drop_breakpoint(self, address: int) -> None:
        """Takes a breakpoint away, if there is one."""
        if address in self.breakpoints:
            self._uc.hook_del(self.breakpoints.pop(address))
            self._uc.ctl_flush_tb()

    def clear_breakpoints(self) -> None:
        """Takes all breakpoints away."""
        for address in list(self.breakpoints):
            self.drop_breakpoint(address)

    def _on_breakpoint(self, _uc: object, address: int, _size: int, _data: object) -> None:
        if address == self._resumed_at:
            self._resumed_at = None
            return
        self.halts = self._is_at_breakpoint = True
        self._uc.emu_stop()

    def _sleep(self) -> None:
        """Skips from event to event until one wakes the core."""
        self._asleep = not self.wakes()
        if self._asleep:
            self._clock.skip_to_event()

    def _hook_blocks(self) -> Any:
        """Lets the C models count instructions: a Python call per basic block would take most of the time."""
        ffi, library = self._ffi, self._library
        blocks: Any = ffi.new("struct core_blocks *")
        blocks.clock = self._clock.model
        blocks.stop, blocks.read = ffi.addressof(library, "uc_emu_stop"), ffi.addressof(library, "uc_mem_read")
        hook, on_block = ffi.new("size_t *"), ffi.addressof(self._models, "core_on_block")
        first, last = 1, 0  # an empty range means every address
        _check(library.uc_hook_add(self._engine, hook, uc.UC_HOOK_BLOCK, on_block, blocks, first, last))
        return blocks

    def _on_unreachable(self, *access: object) -> bool:
        """Unicorn passes itself, the kind of access, address, size, value, and user data."""
        self._unreachable = cast("int", access[2])
        return False

    def _takes_interrupts(self) -> bool:
        """Whether neither PRIMASK nor an active exception holds interrupts back; all have the same priority."""
        return not (self._in_fault or self._active or self._uc.reg_read(arm.UC_ARM_REG_PRIMASK))

    def _take_exception(self) -> None:
        """Takes what is pending, with the registers on the stack (ARMv7-M B1.5.6)."""
        if self._nmi and _NMI not in dict(self._active):
            self._nmi = False
            self._enter(_NMI)
        elif self._takes_interrupts() and (number := self.acknowledge()) is not None:
            self._enter(_FIRST_INTERRUPT + number)

    def _enter(self, number: int) -> None:
        self._active.append((number, self._uc.reg_read(arm.UC_ARM_REG_SP)))
        self._uc.reg_write(arm.UC_ARM_REG_PC, self._pc)
        self._stack_registers()
        self.on_exception(number)
        self._uc.reg_write(arm.UC_ARM_REG_LR, _RETURN_TO_THREAD)
        self._pc = self._word(self.vectors + 4 * number)
        if not self._pc & _THUMB:
            self._enter_fault(_INVSTATE, None)

    def _return(self) -> None:
        """Goes back to what the latest exception interrupted."""
        _, stack = self._active.pop()
        saved = self._uc.mem_read(self._uc.reg_read(arm.UC_ARM_REG_SP), 4 * len(_STACKED))
        for register, value in zip(_STACKED, struct.unpack(f"<{len(_STACKED)}I", saved), strict=True):
            self._uc.reg_write(register, value)
            if register == arm.UC_ARM_REG_PC:
                self._pc = value
        self._uc.reg_write(arm.UC_ARM_REG_SP, stack)
        self.on_exception(self._active[-1][0] if self._active else 0)
        self._take_exception()

    def _end_block(self, error: UcError) -> None:
        """Handles what Unicorn cannot execute: the return from an exception, or a fault."""
        address, self._unreachable = self._unreachable, None
        if self._active and self._pc | _THUMB == _RETURN_TO_THREAD:
            self._return()
            return
        if self._in_fault:
            raise BoardError(f"the core locked up: a fault at 0x{self._pc:08X} within the fault handler ({error})")
        invalid = error.errno == uc.UC_ERR_INSN_INVALID
        self._enter_fault(_UNDEFINSTR if invalid else _IBUSERR if address == self._pc else _PRECISERR, address)

    def _enter_fault(self, cause: int, address: int | None) -> None:
        """Enters the fault handler as the hardware does, with the registers on the stack."""
        self._in_fault = True
        cause |= 0 if self._stack_registers() else _STKERR
        self.on_fault(Fault(cause, address, self._pc))
        self._uc.reg_write(arm.UC_ARM_REG_LR, _RETURN_TO_THREAD)
        self._pc = self._word(self.vectors + 4 * _HARD_FAULT)

    def _stack_registers(self) -> bool:
        """Returns False if the stack is not in memory; the handler runs anyway."""
        saved = b"".join(self._uc.reg_read(register).to_bytes(4, "little") for register in _STACKED)
        stack = (self._uc.reg_read(arm.UC_ARM_REG_SP) & ~7) - len(saved)
        self._uc.reg_write(arm.UC_ARM_REG_SP, stack)
        try:
            self._uc.mem_write(stack, saved)
        except UcError:
            return False
        return True

    def _word(self, address: int) -> int:
        return int.from_bytes(self._uc.mem_read(address, 4), "little")
