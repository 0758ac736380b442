"""What every chip has: SysTick, the system control block, the watchdog, and pins."""

from collections.abc import Callable
from typing import Any

from host_sim.emulator.c_models import c_models
from host_sim.emulator.clock import NEVER, SECOND, Clock
from host_sim.emulator.registers import BoardError, Peripheral, Register

_TICKINT, _COUNTFLAG, _COUNT_MAX = 1 << 1, 1 << 16, 0xFFFFFF
_START, _FEED, _UNLOCK, _RELOAD_MAX = 0xCCCC, 0xAAAA, 0x5555, 0xFFF
_KEY, _KEY_MASK, _SYSRESETREQ, _AIRCR_READ = 0x05FA0000, 0xFFFF0000, 1 << 2, 0xFA050000
_FORCED, _BFARVALID = 1 << 30, 1 << 15
_PINS = 0xFFFF
_PVD_ON, _PVD_LEVEL_SHIFT, _PVD_LOW, _SUPPLY_MV = 1 << 4, 5, 1 << 2, 3300


class SysTick(Peripheral):
    """The core's own timer (PM0214 4.5), polled: counts down from LOAD to 0, over and over.

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
        """Has a `struct register_space` read VAL without Python."""
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
            slow_hz: Speed of its own oscillator.
            bite: Resets the board.
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
        self._alarm = clock.add(self._due)

    def reset(self) -> None:
        """As in `Peripheral`."""
        super().reset()
        self._started = self._unlocked = False
        self._expires = NEVER
        self._alarm.set(NEVER)

    def period_s(self) -> float:
        """Seconds from one feeding to the bite; 0 where it is not started."""
        return (
            (self._reload.value + 1) * (4 << min(self._prescaler.value, 6)) / self._slow_hz if self._started else 0.0
        )

    def _write_key(self, value: int) -> None:
        self._unlocked = value == _UNLOCK
        self._started = self._started or value == _START
        if self._started and value in (_START, _FEED):
            period = SECOND // self._slow_hz * (4 << min(self._prescaler.value, 6))
            self._expires = self._clock.now + (self._reload.value + 1) * period
            self._alarm.set(self._expires)

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
    """Compares the supply with a voltage (RM0090 5, RM0008 5).

    Attributes:
        supply_mv: The supply, mV.
    """

    def __init__(self) -> None:
        """A good supply."""
        self.supply_mv = _SUPPLY_MV
        self._cr = Register("CR")
        super().__init__("PWR", {0x0: self._cr, 0x4: Register("CSR", on_read=self._read_csr)})

    def _read_csr(self) -> int:
        """The highest level is 2.9 V in both families; the others are as in an F1."""
        level_mv = 2200 + 100 * (self._cr.value >> _PVD_LEVEL_SHIFT & 7)
        return _PVD_LOW if self._cr.value & _PVD_ON and self.supply_mv < level_mv else 0


class SystemControl(Peripheral):
    """The core's system control block (PM0214 4.4): notes faults, and takes the request to reset."""

    def __init__(self, cpuid: int, restart: Callable[[], None], move: Callable[[int], None]) -> None:
        """No fault.

        Args:
            cpuid: What the core calls itself.
            restart: Resets the board.
            move: Takes the address of a new vector table.
        """
        self._restart, self._move = restart, move
        self._icsr, self._bfar = Register("ICSR"), Register("BFAR")
        self._vtor = Register("VTOR", on_write=self._write_vtor)
        self._cfsr, self._hfsr = (self._clearing(name) for name in ("CFSR", "HFSR"))
        plain = {0x10: "SCR", 0x14: "CCR", 0x18: "SHPR1", 0x1C: "SHPR2", 0x20: "SHPR3", 0x24: "SHCSR"}
        plain |= {0x30: "DFSR", 0x34: "MMFAR", 0x88: "CPACR"}
        super().__init__(
            "SCB",
            {offset: Register(name) for offset, name in plain.items()}
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
        """A fault became a hard fault.

        Args:
            cause: Bits of CFSR.
            address: The address that could not be reached; None where it was the instruction itself.
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

    def _write_vtor(self, value: int) -> None:
        self._vtor.value = value
        self._move(value)

    def _write_aircr(self, value: int) -> None:
        if value & _KEY_MASK != _KEY:
            raise BoardError(f"SCB AIRCR was written without its key: 0x{value:08X}")
        if value & _SYSRESETREQ:
            self._restart()


class Gpio(Peripheral):
    """One port of pins: what is written shows, nothing is joined to them.

    Attributes:
        output: ODR: the levels that it drives.
    """

    def __init__(self, name: str, setup: dict[int, Register], *, data: int, lock: int) -> None:
        """All pins are inputs.

        Args:
            name: The port's, such as GPIOA.
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


def gpio_f4(name: str) -> Gpio:
    """A port of the STM32F4 (RM0090 8.4)."""
    names = {0x00: "MODER", 0x04: "OTYPER", 0x08: "OSPEEDR", 0x0C: "PUPDR", 0x20: "AFRL", 0x24: "AFRH"}
    return Gpio(name, {offset: Register(name) for offset, name in names.items()}, data=0x10, lock=0x1C)
