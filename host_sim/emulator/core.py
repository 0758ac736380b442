"""The processor core: Unicorn's, joined to the clock and the registers. The only file that knows Unicorn."""

import struct
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, cast

from host_sim.emulator.clock import Clock
from host_sim.emulator.registers import BoardError
from host_sim.errors import OctetError

try:
    from unicorn import (
        UC_ARCH_ARM,
        UC_ERR_INSN_INVALID,
        UC_HOOK_BLOCK,
        UC_HOOK_MEM_INVALID,
        UC_MODE_MCLASS,
        UC_MODE_THUMB,
        UC_PROT_EXEC,
        UC_PROT_READ,
    )
    from unicorn.arm_const import (
        UC_ARM_REG_LR,
        UC_ARM_REG_PC,
        UC_ARM_REG_R0,
        UC_ARM_REG_R1,
        UC_ARM_REG_R2,
        UC_ARM_REG_R3,
        UC_ARM_REG_R12,
        UC_ARM_REG_SP,
        UC_ARM_REG_XPSR,
    )
    from unicorn.unicorn import Uc, UcError
except ImportError as error:
    raise OctetError("unicorn is not installed: run tools/setup emulator") from error

PAGE = 0x1000
_THUMB = 1
_TRANSLATED_MAX = 16 << 20
"""Room for translated code, in bytes: plenty for an image. Unicorn would take 1 GB, which not every machine gives."""

_STACKED = (
    UC_ARM_REG_R0,
    UC_ARM_REG_R1,
    UC_ARM_REG_R2,
    UC_ARM_REG_R3,
    UC_ARM_REG_R12,
    UC_ARM_REG_LR,
    UC_ARM_REG_PC,
    UC_ARM_REG_XPSR,
)
"""What the hardware saves when it enters an exception, from the lowest address."""

_RETURN_TO_THREAD = 0xFFFFFFF9
_HARD_FAULT = 3
_IBUSERR, _PRECISERR, _STKERR, _UNDEFINSTR = 1 << 8, 1 << 9, 1 << 12, 1 << 16
_WIDE_PREFIXES = (0b11101, 0b11110, 0b11111)

_ELF_HEADER, _PROGRAM_HEADER = struct.Struct("<4s5B7x2H5I3H"), struct.Struct("<8I")
_ELF_32_BITS, _ELF_ARM, _ELF_LOADED = 1, 40, 1


@dataclass(frozen=True)
class Fault:
    """What the image did that a core cannot do.

    Attributes:
        cause: Bits of the register CFSR.
        address: That could not be reached; None where it was the instruction itself.
        pc: Where.
    """

    cause: int
    address: int | None
    pc: int


def _disregard(_fault: Fault) -> None:
    """Does nothing with it."""


class Core:
    """Executes the image. One instruction takes one cycle.

    Attributes:
        instructions: Executed so far.
        on_fault: Called when the image faults; then its hard fault handler runs.
    """

    def __init__(self, clock: Clock, vectors: int) -> None:
        """A core without any memory.

        Args:
            clock: That its instructions drive.
            vectors: Address of the vector table.
        """
        self.instructions = 0
        self.on_fault: Callable[[Fault], None] = _disregard
        self._clock, self._vectors = clock, vectors
        self._stopping = self._in_fault = False
        self._error: BaseException | None = None
        self._unreachable: int | None = None
        self._lengths: dict[tuple[int, int], int] = {}
        self._pc = 0
        unicorn = cast("Any", Uc)  # half of its methods lack types
        self._uc = unicorn(UC_ARCH_ARM, UC_MODE_THUMB | UC_MODE_MCLASS)
        self._uc.ctl_set_tcg_buffer_size(_TRANSLATED_MAX)
        self._uc.hook_add(UC_HOOK_BLOCK, self._on_block)
        self._uc.hook_add(UC_HOOK_MEM_INVALID, self._on_unreachable)

    def add_ram(self, base: int, size: int) -> None:
        """Memory to read, write and execute."""
        self._uc.mem_map(base, size)

    def add_rom(self, base: int, contents: bytes) -> None:
        """Memory to read and execute: whole pages."""
        self._uc.mem_map(base, len(contents), UC_PROT_READ | UC_PROT_EXEC)
        self._uc.mem_write(base, contents)

    def add_registers(
        self, base: int, size: int, read: Callable[[int, int], int], write: Callable[[int, int, int], None]
    ) -> None:
        """Addresses of registers rather than memory.

        Args:
            base: First of them, a multiple of `PAGE`.
            size: How many, a multiple of `PAGE`.
            read: From (address, number of bytes) to the value.
            write: Takes (address, number of bytes, value).
        """

        def on_read(_uc: Uc, offset: int, width: int, _data: object) -> int:
            return self._guarded(lambda: read(base + offset, width))

        def on_write(_uc: Uc, offset: int, width: int, value: int, _data: object) -> None:
            self._guarded(lambda: write(base + offset, width, value))

        self._uc.mmio_map(base, size, on_read, None, on_write, None)

    def clear_ram(self, base: int, size: int) -> None:
        """As after a loss of power."""
        self._uc.mem_write(base, bytes(size))

    def reset(self) -> None:
        """Begins where the vector table says."""
        self._in_fault = False
        self._uc.reg_write(UC_ARM_REG_SP, self._word(self._vectors))
        self._uc.reg_write(UC_ARM_REG_LR, 0xFFFFFFFF)
        self._pc = self._word(self._vectors + 4)

    def derail(self, address: int, stack: int | None = None) -> None:
        """Goes on somewhere else, and with another stack if one is given, as if they had been hit."""
        self._pc = address
        if stack is not None:
            self._uc.reg_write(UC_ARM_REG_SP, stack)

    def stop(self) -> None:
        """Ends `run` soon."""
        self._stopping = True

    def run(self) -> None:
        """Executes until `stop`.

        Raises:
            BoardError: The image is lost, or one of the models complains.
            PowerCut: As the flash's.
        """
        self._stopping = False
        while not self._stopping:
            try:
                self._uc.emu_start(self._pc | _THUMB, 0)
            except UcError as error:
                self._pc = self._uc.reg_read(UC_ARM_REG_PC)
                self._enter_fault(error)
                continue
            self._pc = self._uc.reg_read(UC_ARM_REG_PC)
            if self._error is not None:
                failure, self._error = self._error, None
                raise failure

    def _guarded(self, access: Callable[[], int | None]) -> int:
        """An access to registers; after one that failed, there are no more before the core has stopped."""
        if self._error is not None:
            return 0
        try:
            return access() or 0
        except BaseException as error:
            self._error = error  # nothing may pass through Unicorn; `run` raises it
            self._stopping = True
            return 0

    def _on_block(self, _uc: Uc, address: int, size: int, _data: object) -> None:
        if self._stopping:
            self._uc.emu_stop()
            return
        count = self._lengths.get((address, size))
        if count is None:
            count = self._lengths[address, size] = self._count(address, size)
        self.instructions += count
        self._clock.execute(count)

    def _count(self, address: int, size: int) -> int:
        """Instructions in a block: some are two half-words long."""
        code, at, count = self._uc.mem_read(address, size), 0, 0
        while at < size:
            at += 4 if code[at + 1] >> 3 in _WIDE_PREFIXES else 2
            count += 1
        return count

    def _on_unreachable(self, *access: object) -> bool:
        """Unicorn's arguments: itself, the kind of access, address, size, value, and nothing."""
        self._unreachable = cast("int", access[2])
        return False

    def _enter_fault(self, error: UcError) -> None:
        """As the hardware does: the registers on the stack, and on in the handler."""
        address, self._unreachable = self._unreachable, None
        if self._in_fault:
            raise BoardError(f"the core locked up: a fault at 0x{self._pc:08X} within the fault handler ({error})")
        self._in_fault = True
        cause = _UNDEFINSTR if error.errno == UC_ERR_INSN_INVALID else _IBUSERR if address == self._pc else _PRECISERR
        cause |= 0 if self._stack_registers() else _STKERR
        self.on_fault(Fault(cause, address, self._pc))
        self._uc.reg_write(UC_ARM_REG_LR, _RETURN_TO_THREAD)
        self._pc = self._word(self._vectors + 4 * _HARD_FAULT)

    def _stack_registers(self) -> bool:
        """False if the stack is not in memory; the handler begins all the same."""
        saved = b"".join(self._uc.reg_read(register).to_bytes(4, "little") for register in _STACKED)
        stack = (self._uc.reg_read(UC_ARM_REG_SP) & ~7) - len(saved)
        self._uc.reg_write(UC_ARM_REG_SP, stack)
        try:
            self._uc.mem_write(stack, saved)
        except UcError:
            return False
        return True

    def _word(self, address: int) -> int:
        return int.from_bytes(self._uc.mem_read(address, 4), "little")


def load_segments(path: Path) -> list[tuple[int, bytes]]:
    """What an image puts where: (address, bytes), as a probe writes it.

    Args:
        path: The `.elf`.

    Raises:
        OctetError: The file is not an image for an ARM core.
    """
    try:
        data = path.read_bytes()
        magic, bits, *_, machine, _, _, table, _, _, _, _, count = _ELF_HEADER.unpack_from(data)
        if magic != b"\x7fELF" or bits != _ELF_32_BITS or machine != _ELF_ARM:
            raise OctetError(f"cannot read the image {path}: not a 32-bit ELF file for ARM")
        headers = [_PROGRAM_HEADER.unpack_from(data, table + i * _PROGRAM_HEADER.size) for i in range(count)]
    except (OSError, struct.error) as error:
        raise OctetError(f"cannot read the image {path}: {error}") from error
    return [
        (at, data[offset : offset + size])
        for kind, offset, _, at, size, *_ in headers
        if kind == _ELF_LOADED and size
    ]
