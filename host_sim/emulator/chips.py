"""The supported chips and their memory maps."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

from host_sim.emulator.can import BxCan, CanController, CanFaults, CanFrame, FdCan
from host_sim.emulator.clock import Clock
from host_sim.emulator.converter import Converter, ConverterF1, ConverterG4
from host_sim.emulator.flash import Factory as FlashFactory
from host_sim.emulator.flash_kinds import FlashF1, FlashF4, FlashG4
from host_sim.emulator.ports import GpioF1, GpioF4, GpioG4, Port
from host_sim.emulator.rcc import Oscillators, Rcc, RccFaults
from host_sim.emulator.rcc_f1 import RccF1
from host_sim.emulator.rcc_f4 import RccF4, RccG4
from host_sim.emulator.serial import Usart, UsartG4
from host_sim.emulator.system import POWER_F1, POWER_G4, PowerKind

Gate = tuple[int, int]
"""Clock enable bit of a peripheral: the offset of an RCC register, and the bit number."""


@dataclass(frozen=True)
class Chip:
    """One chip on one board.

    Attributes:
        name: Name of the board on the command line.
        cpuid: CPUID of its core.
        slow_hz: Frequency of the watchdog's oscillator.
        oscillators: Frequencies of the other oscillators; the crystal is the board's.
        ram: (base, bytes) of each RAM.
        rcc: Creates the reset and clock control.
        rcc_base: Base address of RCC.
        flash: Creates the flash.
        flash_base: Base address of the flash registers.
        gpio: Creates a port from its name.
        gpio_base: Base address of port A; each port takes 1 kB.
        gpio_gates: Clock gate of each port, from port A.
        link: Link name of the image that uses its CAN controller.
        can: Creates that controller.
        can_gate: Clock gate of CAN.
        power_gate: Clock gate of the supply monitor.
        power: Registers of the supply monitor.
        usart: Creates the serial port.
        usart_base: Base address of the serial port.
        usart_gate: Clock gate of the serial port.
        afio_gate: Clock gate of AFIO, the alternate function registers; None if the chip has none.
        robot: Peripherals for a robot with a body on pins; None if the board has no pins for one.
    """

    name: str
    cpuid: int
    slow_hz: int
    oscillators: Oscillators
    ram: Sequence[tuple[int, int]]
    rcc: Callable[[Clock, Oscillators, Callable[[], int], RccFaults], Rcc]
    rcc_base: int
    flash: FlashFactory
    flash_base: int
    gpio: Callable[[str], Port]
    gpio_base: int
    gpio_gates: Sequence[Gate]
    link: str
    can: Callable[[Clock, Callable[[], int], CanFaults, Callable[[CanFrame], None]], CanController]
    can_gate: Gate
    power_gate: Gate
    power: PowerKind
    usart: Callable[[Clock, Callable[[], int], Callable[[int], None]], Usart]
    usart_base: int
    usart_gate: Gate
    afio_gate: Gate | None = None
    robot: "RobotParts | None" = None


@dataclass(frozen=True)
class RobotParts:
    """The peripherals that a robot with a body on pins uses.

    Attributes:
        motors: Clock gate of TIM1.
        counters: Clock gate of TIM2; those of TIM3 and TIM4 are the next bits.
        dma: Clock gate of DMA1.
        adc: Clock gate of ADC1.
        adc_base: Base address of ADC1.
        converter: Creates ADC1 from its base address, clock frequency and DMA, and the multiplexer if there is one.
        multiplexed: Clock gate and base address of the DMA multiplexer; None if the chip has none.
    """

    motors: Gate
    counters: Gate
    dma: Gate
    adc: Gate
    adc_base: int
    converter: Callable[..., Converter]
    multiplexed: tuple[Gate, int] | None = None


WATCHDOG_BASE, CAN_BASE, POWER_BASE, AFIO_BASE = 0x40003000, 0x40006400, 0x40007000, 0x40010000
SYSTICK_BASE, SCB_BASE, NVIC_BASE = 0xE000E010, 0xE000ED00, 0xE000E100
"""Base addresses common to all chips."""

GPIO_STRIDE = 0x400
"""Address distance from one port to the next."""

_MHZ = 1_000_000

STM32F405 = Chip(
    name="feather_stm32f405",
    cpuid=0x410FC241,
    slow_hz=32_000,
    oscillators=Oscillators(
        internal=16 * _MHZ, crystal=12 * _MHZ, core_max=168 * _MHZ, apb1_max=42 * _MHZ, apb2_max=84 * _MHZ
    ),
    ram=((0x20000000, 128 << 10), (0x10000000, 64 << 10)),
    rcc=RccF4,
    rcc_base=0x40023800,
    flash=FlashF4,
    flash_base=0x40023C00,
    gpio=GpioF4,
    gpio_base=0x40020000,
    gpio_gates=[(0x30, port) for port in range(9)],
    link="bxcan",
    can=partial(BxCan, banks=28),
    can_gate=(0x40, 25),
    power_gate=(0x40, 28),
    power=POWER_F1,
    usart=Usart,
    usart_base=0x40011000,
    usart_gate=(0x44, 4),
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
    rcc=RccF1,
    rcc_base=0x40021000,
    flash=FlashF1,
    flash_base=0x40022000,
    gpio=GpioF1,
    gpio_base=0x40010800,
    gpio_gates=[(0x18, 2 + port) for port in range(5)],
    link="bxcan",
    can=BxCan,
    can_gate=(0x1C, 25),
    power_gate=(0x1C, 28),
    power=POWER_F1,
    usart=Usart,
    usart_base=0x40013800,
    usart_gate=(0x18, 14),
    afio_gate=(0x18, 0),
    robot=RobotParts(
        motors=(0x18, 11),
        counters=(0x1C, 0),
        dma=(0x14, 0),
        adc=(0x18, 9),
        adc_base=0x40012400,
        converter=ConverterF1,
    ),
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
    rcc=RccG4,
    rcc_base=0x40021000,
    flash=FlashG4,
    flash_base=0x40022000,
    gpio=GpioG4,
    gpio_base=0x48000000,
    gpio_gates=[(0x4C, port) for port in range(7)],
    link="fdcan",
    can=FdCan,
    can_gate=(0x58, 25),
    power_gate=(0x58, 28),
    power=POWER_G4,
    usart=UsartG4,
    usart_base=0x40004400,
    usart_gate=(0x58, 17),
    robot=RobotParts(
        motors=(0x60, 11),
        counters=(0x58, 0),
        dma=(0x48, 0),
        adc=(0x4C, 13),
        adc_base=0x50000000,
        converter=ConverterG4,
        multiplexed=((0x48, 2), 0x40020800),
    ),
)
"""ST NUCLEO-G431RB. Faster clocks need a higher core voltage and a pause at half speed: not modelled."""

CHIPS = {chip.name: chip for chip in (STM32F405, STM32F103, STM32G431)}
