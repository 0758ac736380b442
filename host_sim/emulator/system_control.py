"""The core's system control block (PM0214 4.4): reset, and what a fault handler asks."""

from collections.abc import Callable

from host_sim.emulator.errors import BoardError
from host_sim.emulator.registers import Peripheral, Register

_KEY, _KEY_MASK, _SYSRESETREQ = 0x05FA0000, 0xFFFF0000, 1 << 2
_AIRCR_READ = 0xFA050000
_FORCED, _BFARVALID = 1 << 30, 1 << 15


class SystemControl(Peripheral):
    """Holds what the hardware notes of a fault, and takes the request to reset."""

    def __init__(self, cpuid: int, restart: Callable[[], None]) -> None:
        """No fault.

        Args:
            cpuid: What the core calls itself.
            restart: Resets the board.
        """
        self._restart = restart
        self._icsr, self._bfar = Register("ICSR"), Register("BFAR")
        self._cfsr, self._hfsr = (self._clearing(name) for name in ("CFSR", "HFSR"))
        plain = {0x08: "VTOR", 0x10: "SCR", 0x14: "CCR", 0x18: "SHPR1", 0x1C: "SHPR2", 0x20: "SHPR3", 0x24: "SHCSR"}
        plain |= {0x30: "DFSR", 0x34: "MMFAR", 0x88: "CPACR"}
        super().__init__(
            "SCB",
            {offset: Register(name) for offset, name in plain.items()}
            | {
                0x00: Register("CPUID", cpuid),
                0x04: self._icsr,
                0x0C: Register("AIRCR", on_read=lambda: _AIRCR_READ, on_write=self._write_aircr),
                0x28: self._cfsr,
                0x2C: self._hfsr,
                0x38: self._bfar,
            },
            clocked=True,
        )

    def note_fault(self, cause: int, address: int | None) -> None:
        """A fault became a hard fault.

        Args:
            cause: Bits of CFSR.
            address: That could not be reached, if it was that.
        """
        self._icsr.value = 3
        self._cfsr.value |= cause | (0 if address is None else _BFARVALID)
        self._hfsr.value |= _FORCED
        self._bfar.value = address or 0

    @staticmethod
    def _clearing(name: str) -> Register:
        """A register in which ones clear bits."""
        register = Register(name)

        def write(value: int) -> None:
            register.value &= ~value

        register.on_write = write
        return register

    def _write_aircr(self, value: int) -> None:
        if value & _KEY_MASK != _KEY:
            raise BoardError(f"SCB AIRCR was written without its key: 0x{value:08X}")
        if value & _SYSRESETREQ:
            self._restart()
