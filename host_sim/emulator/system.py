"""Parts of every chip: SysTick, system control block, watchdog, and supply monitor."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, ClassVar

from host_sim.emulator.c_models import c_models
from host_sim.emulator.clock import NEVER, SECOND, Clock
from host_sim.emulator.registers import BoardError, Peripheral, Register, plain

_TICKINT, _COUNTFLAG, _COUNT_MAX = 1 << 1, 1 << 16, 0xFFFFFF
_START, _FEED, _UNLOCK, _RELOAD_MAX = 0xCCCC, 0xAAAA, 0x5555, 0xFFF
_KEY, _KEY_MASK, _SYSRESETREQ, _AIRCR_READ = 0x05FA0000, 0xFFFF0000, 1 << 2, 0xFA050000
_FORCED, _BFARVALID = 1 << 30, 1 << 15
_SUPPLY_MV = 3300


class SysTick(Peripheral):
    """The core's timer (PM0214 4.5), polled: counts down from LOAD to 0 repeatedly.

    Attributes:
        model: The C model, `struct systick`.
    """

    def __init__(self, clock: Clock) -> None:
        """At rest.

        Args:
            clock: The board's.
        """
        ffi, self._library = c_models()
        self._clock = clock
        self._wraps = 0
        self.model: Any = ffi.new("struct systick *")
        self.model.clock = clock.model
        super().__init__(
            "SysTick",
            {
                0x0: Register("CTRL", on_read=self._read_ctrl, on_write=self._write_ctrl),
                0x4: Register("LOAD", on_read=lambda: int(self.model.load), on_write=self._write_load),
                0x8: Register("VAL", on_read=self._read_val, on_write=self._restart, steady=False),
                0xC: Register("CALIB"),
            },
            clocked=True,
        )

    def reset(self) -> None:
        """As in `Peripheral`."""
        super().reset()
        self.model.ctrl = self.model.load = 0

    def access_directly(self, space: Any, base: int) -> None:
        """Lets a `struct register_space` read VAL without calling Python."""
        space.systick, space.systick_val = self.model, base + 0x8

    def _restart(self, value: int) -> None:  # noqa: ARG002 - whatever is written, the count is 0
        self.model.since_cycles, self._wraps = self._clock.cycles, 0

    def _read_val(self) -> int:
        value: int = self._library.systick_value(self.model)
        return value

    def _read_ctrl(self) -> int:
        wraps = self._library.systick_counted(self.model) // (self.model.load + 1)
        flag = _COUNTFLAG if wraps > self._wraps else 0
        self._wraps = wraps
        ctrl: int = self.model.ctrl
        return ctrl | flag

    def _write_ctrl(self, value: int) -> None:
        if value & _TICKINT:
            raise BoardError("SysTick's interrupt was enabled, which is not modelled")
        self.model.ctrl = value
        self._restart(0)

    def _write_load(self, value: int) -> None:
        self.model.load = value & _COUNT_MAX


class Watchdog(Peripheral):
    """The independent watchdog (RM0090 21, RM0008 19): resets the board when it is not fed, and cannot be stopped."""

    def __init__(self, clock: Clock, slow_hz: int, bite: Callable[[], None]) -> None:
        """At rest.

        Args:
            clock: The board's.
            slow_hz: Frequency of its own oscillator, Hz.
            bite: Resets the board; called when the watchdog expires.
        """
        self._clock, self._slow_hz, self._bite = clock, slow_hz, bite
        self._expires = NEVER
        self._started = self._unlocked = False
        self._prescaler = Register("PR", on_write=self._write_prescaler)
        self._reload = Register("RLR", _RELOAD_MAX, on_write=self._write_reload)
        key = Register("KR", on_write=self._write_key, idle=True)
        super().__init__(
            "IWDG", {0x0: key, 0x4: self._prescaler, 0x8: self._reload, 0xC: Register("SR")}, clocked=True
        )
        self._set_alarm = clock.add(self._due)

    def reset(self) -> None:
        """As in `Peripheral`."""
        super().reset()
        self._started = self._unlocked = False
        self._expires = NEVER
        self._set_alarm(NEVER)

    def period_s(self) -> float:
        """Timeout after a feed, s; 0 if it is not started."""
        return (
            (self._reload.value + 1) * (4 << min(self._prescaler.value, 6)) / self._slow_hz if self._started else 0.0
        )

    def _write_key(self, value: int) -> None:
        self._unlocked = value == _UNLOCK
        self._started = self._started or value == _START
        if self._started and value in (_START, _FEED):
            period = SECOND // self._slow_hz * (4 << min(self._prescaler.value, 6))
            self._expires = self._clock.now + (self._reload.value + 1) * period
            self._set_alarm(self._expires)

    def _write_prescaler(self, value: int) -> None:
        self._assert_unlocked("PR")
        self._prescaler.value = value & 7

    def _write_reload(self, value: int) -> None:
        self._assert_unlocked("RLR")
        self._reload.value = value & _RELOAD_MAX

    def _assert_unlocked(self, name: str) -> None:
        if not self._unlocked:
            raise BoardError(f"IWDG {name} was written while it is locked, which has no effect")

    def _due(self) -> int:
        if self._expires <= self._clock.now:
            self._expires = NEVER
            self._bite()
        return self._expires


class PowerControl(Peripheral):
    """The supply monitor of the F1, which compares the supply with a threshold (RM0008 5).

    The highest level is the same in an F4 (RM0090 5).

    Attributes:
        supply_mv: Supply voltage, mV.
    """

    names: ClassVar[Mapping[int, str]] = {0x0: "CR", 0x4: "CSR"}
    resets: ClassVar[Mapping[int, int]] = {}
    """Reset values other than 0, by offset."""
    control, status = 0x0, 0x4
    """Offsets of the control register and of the status register."""
    on, level, low = 4, 5, 2
    """Bits of the control register: enable, and the lowest of the level; of the status register: supply low."""
    levels_mv: ClassVar[Sequence[int]] = range(2200, 3000, 100)
    """Threshold voltages by level, mV."""

    def __init__(self) -> None:
        """Starts with a sufficient supply."""
        self.supply_mv = _SUPPLY_MV
        names = self.names.items()
        super().__init__("PWR", {at: Register(name, self.resets.get(at, 0)) for at, name in names})
        self.registers[self.status].on_read = self._read_status

    def _read_status(self) -> int:
        control = self.registers[self.control].value
        level_mv = self.levels_mv[control >> self.level & 7]
        return 1 << self.low if control >> self.on & 1 and self.supply_mv < level_mv else 0


class PowerControlG4(PowerControl):
    """The supply monitor of the G4 (RM0440 6.4); the last level is a pin's."""

    names: ClassVar[Mapping[int, str]] = {
        0x00: "CR1", 0x04: "CR2", 0x08: "CR3", 0x0C: "CR4", 0x10: "SR1", 0x14: "SR2",
    }  # fmt: skip
    resets: ClassVar[Mapping[int, int]] = {0x00: 0x200, 0x08: 0x8000}
    control, status = 0x04, 0x14
    on, level, low = 0, 1, 11
    levels_mv: ClassVar[Sequence[int]] = (2000, 2200, 2400, 2500, 2600, 2800, 2900, 0)


class SystemControl(Peripheral):
    """The core's system control block (PM0214 4.4): notes faults, and accepts reset requests."""

    def __init__(self, cpuid: int, restart: Callable[[], None], move: Callable[[int], None]) -> None:
        """Starts without a fault.

        Args:
            cpuid: Value of CPUID.
            restart: Resets the board.
            move: Called with the address of a new vector table.
        """
        self._restart, self._move = restart, move
        self._icsr, self._bfar = Register("ICSR"), Register("BFAR")
        self._vtor = Register("VTOR", on_write=self._write_vtor)
        self._cfsr, self._hfsr = (self._clearing(name) for name in ("CFSR", "HFSR"))
        names = {0x10: "SCR", 0x14: "CCR", 0x18: "SHPR1", 0x1C: "SHPR2", 0x20: "SHPR3", 0x24: "SHCSR"}
        names |= {0x30: "DFSR", 0x34: "MMFAR", 0x88: "CPACR"}
        super().__init__(
            "SCB",
            plain(names)
            | {
                0x00: Register("CPUID", cpuid),
                0x04: self._icsr,
                0x08: self._vtor,
                0x0C: Register("AIRCR", on_read=lambda: _AIRCR_READ, on_write=self._write_aircr),
                0x28: self._cfsr,
                0x2C: self._hfsr,
                0x38: self._bfar,
            },
            clocked=True,
        )

    def note_fault(self, cause: int, address: int | None) -> None:
        """Notes a fault that became a hard fault.

        Args:
            cause: Bits of CFSR.
            address: The address that could not be accessed; None if the instruction itself is invalid.
        """
        self.enter(3)
        self._cfsr.value |= cause | (0 if address is None else _BFARVALID)
        self._hfsr.value |= _FORCED
        self._bfar.value = address or 0

    def enter(self, exception: int) -> None:
        """Sets the number of the active exception; 0 for none."""
        self._icsr.value = exception

    @staticmethod
    def _clearing(name: str) -> Register:
        """A register in which ones clear bits."""
        register = Register(name)

        def write(value: int) -> None:
            register.value &= ~value

        register.on_write = write
        return register

    def _write_vtor(self, value: int) -> None:
        self._vtor.value = value
        self._move(value)

    def _write_aircr(self, value: int) -> None:
        if value & _KEY_MASK != _KEY:
            raise BoardError(f"SCB AIRCR was written without its key: 0x{value:08X}")
        if value & _SYSRESETREQ:
            self._restart()
