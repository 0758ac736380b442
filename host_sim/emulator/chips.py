"""The supported chips and their memory maps."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

from host_sim.emulator.can import BxCan, CanController, CanFaults, CanFrame, FdCan
from host_sim.emulator.clock import Clock
from host_sim.emulator.converter import Converter, ConverterF1, ConverterG4, Dma
from host_sim.emulator.flash import Flash, FlashF1, FlashF4, FlashG4
from host_sim.emulator.ports import GpioF1, GpioF4, GpioG4, Port
from host_sim.emulator.rcc import Oscillators, Rcc, RccFaults
from host_sim.emulator.rcc_kinds import RccF1, RccF4, RccG4
from host_sim.emulator.serial import Usart, UsartG4
from host_sim.emulator.system import PowerControl, PowerControlG4


@dataclass(frozen=True)
class Chip:
    """One chip on one board.

    Attributes:
        name: Name of the board on the command line.
        cpuid: CPUID of its core.
        slow_hz: Frequency of the watchdog's oscillator.
        oscillators: Frequencies of the other oscillators; the crystal is the board's.
        ram: (base, bytes) of each RAM.
        link: Link name of the image that uses its CAN controller.
        rcc: Creates the reset and clock control.
        flash: Creates the flash.
        gpio: Creates a port from its name.
        can: Creates the CAN controller.
        power: Creates the supply monitor.
        usart: Creates the serial port.
        places: For each peripheral, by its name, the base address; then, if it has a clock gate, the offset of a
            register of RCC, and the number of the enable bit in it.
        converter: Creates ADC1, for a robot with a body on pins; None if the board has no pins for one.
        wide: Names of the timers with 32 bits.
    """

    name: str
    cpuid: int
    slow_hz: int
    oscillators: Oscillators
    ram: Sequence[tuple[int, int]]
    link: str
    rcc: Callable[[Clock, Oscillators, Callable[[], int], RccFaults], Rcc]
    flash: type[Flash]
    gpio: Callable[[str], Port]
    can: Callable[[Clock, Callable[[], int], CanFaults, Callable[[CanFrame], None]], CanController]
    power: Callable[[], PowerControl]
    usart: Callable[[Clock, Callable[[], int], Callable[[int], None]], Usart]
    places: Mapping[str, tuple[int, ...]]
    converter: Callable[[int, Callable[[], int], Dma, Clock], Converter] | None = None
    wide: Sequence[str] = ()


WATCHDOG_BASE, CAN_BASE, SYSTICK_BASE = 0x40003000, 0x40006400, 0xE000E010
_ALIKE = {"IWDG": (WATCHDOG_BASE,), "SysTick": (SYSTICK_BASE,), "SCB": (0xE000ED00,), "NVIC": (0xE000E100,)}
"""The places of what is the same in all chips."""


def _ports(base: int, count: int, register: int, first: int = 0) -> dict[str, tuple[int, ...]]:
    """The places of ports: each takes 1 kB."""
    return {f"GPIO{'ABCDEFGHI'[i]}": (base + 0x400 * i, register, first + i) for i in range(count)}


def _timers(advanced: int, general: int) -> dict[str, tuple[int, ...]]:
    """The places of TIM1 and of TIM2 to TIM4, with the registers of their gates."""
    own = {f"TIM{2 + i}": (0x40000000 + 0x400 * i, general, i) for i in range(3)}
    return {"TIM1": (0x40012C00, advanced, 11), **own}


_MHZ = 1_000_000

STM32F405 = Chip(
    name="feather_stm32f405",
    cpuid=0x410FC241,
    slow_hz=32_000,
    oscillators=Oscillators(
        internal=16 * _MHZ, crystal=12 * _MHZ, core_max=168 * _MHZ, apb1_max=42 * _MHZ, apb2_max=84 * _MHZ
    ),
    ram=((0x20000000, 128 << 10), (0x10000000, 64 << 10)),
    link="bxcan",
    rcc=RccF4,
    flash=FlashF4,
    gpio=GpioF4,
    can=partial(BxCan, banks=28),
    power=PowerControl,
    usart=Usart,
    places={
        **_ALIKE,
        **_ports(0x40020000, 9, 0x30),
        "RCC": (0x40023800,),
        "FLASH": (0x40023C00,),
        "CAN1": (CAN_BASE, 0x40, 25),
        "PWR": (0x40007000, 0x40, 28),
        "USART": (0x40011000, 0x44, 4),
    },
)
"""Adafruit Feather STM32F405."""

STM32F103 = Chip(
    name="blue_pill",
    cpuid=0x411FC231,
    slow_hz=40_000,
    oscillators=Oscillators(
        internal=8 * _MHZ, crystal=8 * _MHZ, core_max=72 * _MHZ, apb1_max=36 * _MHZ, apb2_max=72 * _MHZ
    ),
    ram=((0x20000000, 20 << 10),),
    link="bxcan",
    rcc=RccF1,
    flash=FlashF1,
    gpio=GpioF1,
    can=BxCan,
    power=PowerControl,
    usart=Usart,
    places={
        **_ALIKE,
        **_ports(0x40010800, 5, 0x18, 2),
        **_timers(0x18, 0x1C),
        "RCC": (0x40021000,),
        "FLASH": (0x40022000,),
        "CAN1": (CAN_BASE, 0x1C, 25),
        "PWR": (0x40007000, 0x1C, 28),
        "USART": (0x40013800, 0x18, 14),
        "AFIO": (0x40010000, 0x18, 0),
        "DMA1": (0x40020000, 0x14, 0),
        "ADC1": (0x40012400, 0x18, 9),
    },
    converter=ConverterF1,
)
"""Blue Pill."""

STM32G431 = Chip(
    name="nucleo_g431rb",
    cpuid=0x410FC241,
    slow_hz=32_000,
    oscillators=Oscillators(
        internal=16 * _MHZ, crystal=24 * _MHZ, core_max=80 * _MHZ, apb1_max=80 * _MHZ, apb2_max=80 * _MHZ
    ),
    ram=((0x20000000, 32 << 10),),
    link="fdcan",
    rcc=RccG4,
    flash=FlashG4,
    gpio=GpioG4,
    can=FdCan,
    power=PowerControlG4,
    usart=UsartG4,
    places={
        **_ALIKE,
        **_ports(0x48000000, 7, 0x4C),
        **_timers(0x60, 0x58),
        "RCC": (0x40021000,),
        "FLASH": (0x40022000,),
        "FDCAN1": (CAN_BASE, 0x58, 25),
        "PWR": (0x40007000, 0x58, 28),
        "USART": (0x40004400, 0x58, 17),
        "DMA1": (0x40020000, 0x48, 0),
        "DMAMUX": (0x40020800, 0x48, 2),
        "ADC1": (0x50000000, 0x4C, 13),
    },
    converter=ConverterG4,
    wide=("TIM2",),
)
"""ST NUCLEO-G431RB. Faster clocks need a higher core voltage and a pause at half speed: not modelled."""

CHIPS = {chip.name: chip for chip in (STM32F405, STM32F103, STM32G431)}
