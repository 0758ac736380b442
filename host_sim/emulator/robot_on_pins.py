"""The parts wired to a body's pins: motors, encoders, sensors, bumpers, a button and a battery."""

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from math import exp, inf, log1p
from typing import Any, NamedTuple

from host_sim.emulator.board_pins import ADC, Pins, place_of
from host_sim.emulator.converter import Converter
from host_sim.emulator.core import Core
from host_sim.emulator.ports import Port
from host_sim.emulator.registers import Register
from host_sim.emulator.timers import MotorTimer, Timer
from host_sim.protocol.generated import FEEL, Senses
from host_sim.world.body import Body
from host_sim.world.world_library import world_library

_JTAG, _SWJ_SHIFT, _NO_JTAG = ("PA15", "PB3", "PB4"), 24, (2, 4)


class Wiring:
    """The wiring of a board."""

    def __init__(self, pins: Pins, ports: Sequence[Port], mapr: Register | None) -> None:
        """Takes the wiring, and tracks the ports' modes and AFIO_MAPR.

        Args:
            pins: The board's pins.
            ports: The GPIO ports, from A.
            mapr: AFIO_MAPR; None for chips whose pins select their functions.
        """
        self.pins, self._mapr, self._pins = pins, mapr, dict(pins.signals)
        self._known: dict[str, bool] = {}
        self._ports = ports
        for port in ports:
            port.changed = self._known.clear
        if mapr is not None:
            mapr.on_write = self._write_mapr

    def port(self, signal: str) -> tuple[Port, int]:
        """The port and pin number of a signal."""
        port, number = place_of(self.pins.signals[signal])
        return self._ports[port], number

    def rewire(self, signal: str, pin: str = "") -> None:
        """Moves a wire to another pin, such as PB4, or removes it."""
        self._pins[signal] = pin
        self._known.clear()

    def meets(self, *signals: str) -> bool:
        """Whether signals are wired to the pins that the drivers use for them."""
        for signal in signals:
            if signal not in self._known:
                self._known[signal] = self._meets(signal)
        return all(self._known[signal] for signal in signals)

    def _meets(self, signal: str) -> bool:
        pin, use, chip = self._pins[signal], self.pins.chip.signals[signal], self.pins.chip
        if not pin:
            return False
        at, number = place_of(pin)
        port = self._ports[at]
        if use == ADC:
            return port.measures(number) and pin == self.pins.signals[signal]
        if self._mapr is None:
            function = chip.function_of(use, pin)
            return function is not None and port.serves(number, function, out=False)
        if pin in _JTAG and self._mapr.value >> _SWJ_SHIFT & 7 not in _NO_JTAG:
            return False
        peripheral, role = use.split()
        out = role == "tx" or (peripheral == "TIM1" and role != "bkin")
        return port.serves(number, 0, out=out) and chip.pin_of(use, self._mapr.value) == pin

    def _write_mapr(self, value: int) -> None:
        assert self._mapr is not None  # without AFIO it is never written
        self._mapr.value = value
        self._known.clear()


PWM_S = 1 / 20_000


class Winding(NamedTuple):
    """The winding of a motor.

    Attributes:
        ohm: Its resistance, with that of the switches.
        henry: Its inductance.
    """

    ohm: float = 9.0
    henry: float = 1e-3


def voltage(in_1: float, in_2: float, emf: float, winding: Winding) -> float:
    """Mean voltage at a motor in a period of the PWM, once the current repeats itself, as a fraction of the supply's.

    By the truth table of the DRV8833, inputs 1/0 drive forward, 0/1 backward, 1/1 shorts the motor, which brakes it
    (slow decay), and 0/0 opens all switches: then the current flows back into the supply through diodes until it ends
    (fast decay).

    Args:
        in_1: Fraction of the period, from its beginning, for which the first input is high.
        in_2: Likewise of the second one.
        emf: Voltage that the motor generates by its speed, as a fraction of the supply's, forward positive.
        winding: Its winding.
    """
    drives, coasts = abs(in_1 - in_2), 1.0 - max(in_1, in_2)
    if coasts <= 0:
        return in_1 - in_2  # driven or shorted, it is a linear circuit
    if drives == 0:
        return emf * coasts
    ahead = 1 if in_1 > in_2 else -1
    emf = min(max(ahead * emf, -0.99), 0.99)
    periods = PWM_S * winding.ohm / winding.henry
    most = (1 - emf) * (1 - exp(-drives * periods))
    falls = log1p(most / (1 + emf)) / periods
    if falls >= coasts:
        return ahead * (drives - coasts)  # the current never ends
    return ahead * (drives - falls + (coasts - falls) * emf)


SIDES = ("LEFT", "RIGHT")
SENSORS = [f"PROXIMITY_{name.upper().replace('-', '_')}" for name in FEEL]
_SAMPLE_PER_MV = 4096 / 3300
_ONE = 65536
_CNT = 0x24

_NEAR_MM, _STRONG, _WEAK = 150, 4, 4
"""Bursts of a beacon in a tick: strong ones reach as far as it is seen, weak ones `_NEAR_MM`."""


class PartsOnPins(ABC):
    """The parts of a body of the world, a `struct kit`, as a board's pins meet them.

    Attributes:
        ffi: The interface to the world's library.
        library: The world's library.
        kit: The body; None if there is none: then nothing turns.
        light: Light that each proximity sensor receives from its own LEDs while they are on, 0..4095.
        ambient: Light that it receives with the LEDs off.
        battery_v: Battery voltage while there is no body, V.
        counts_by: Sign of each encoder's counts: -1 if its wires are swapped.
        stalled: Whether each motor is blocked.
        swapped: Whether the connectors of the two motors are swapped.
        winding: The winding of both motors.
    """

    divisor = 3.0
    """Battery voltage as a multiple of that at its pin."""

    def __init__(self) -> None:
        """Starts with everything at rest."""
        self.ffi, self.library = world_library()
        self.kit: Any = None
        self.light, self.ambient, self.battery_v = [0] * len(SENSORS), 300, 7.4
        self._light: Any = self.ffi.new("uint16_t[]", len(SENSORS))
        self.counts_by, self.stalled, self.swapped = [1, 1], [False, False], False
        self._duty: Any = self.ffi.new("int32_t[2]")
        self._counts, self.winding = [0, 0], Winding()

    @abstractmethod
    def _set(self, signal: str, *, high: bool) -> None:
        """Drives an input of the board."""

    @abstractmethod
    def _high(self, signal: str) -> bool:
        """Whether the board drives an output high."""

    @abstractmethod
    def _input(self, signal: str) -> float:
        """Fraction of time for which an input of the bridge is high."""

    @abstractmethod
    def _turn(self, side: int, more: int) -> None:
        """Turns an encoder."""

    @abstractmethod
    def _measure(self, samples: Mapping[str, int]) -> None:
        """Sets what the ADC finds for each signal, 0..4095."""

    @abstractmethod
    def _counted(self) -> list[int]:
        """The counts of both encoders, as the board has them."""

    @abstractmethod
    def receive_bursts(self, count: int) -> None:
        """Receives bursts of a beacon's light."""

    def join(self, kit: Any) -> None:
        """Connects the board to a body."""
        if kit != self.kit:
            self.kit = kit
            self._counts = [self.library.kit_count(kit, side) for side in range(2)]

    def feel(self, body: Body, senses: Senses, tick: int) -> None:
        """Connects the board to a body and sets what its sensors receive.

        Args:
            body: The body, with its position.
            senses: Senses of an ideal body there.
            tick: Number of the tick in the run.
        """
        self.join(body.kit)
        body.measure_light(tick, self._light)
        self.light = list(self._light)
        self.set_bumped(senses.bump)
        if senses.look:
            self.receive_bursts(_STRONG + _WEAK * (senses.beacon_mm < _NEAR_MM))

    def set_bumped(self, bumped: bool) -> None:
        """Presses or releases the bumpers."""
        for side in SIDES:
            self._set(f"BUMPER_{side}", high=not bumped)

    def set_button(self, pressed: bool) -> None:
        """Presses or releases the button."""
        self._set("BUTTON", high=not pressed)

    def set_bridge_fault(self, failed: bool, lasts_s: float = inf) -> None:
        """Sets or clears the bridge's fault signal; one that lasts for a time is a spike."""
        self._set("BRIDGE_FAULT", high=not failed or lasts_s < inf)

    def _emf(self, side: int) -> float:
        """Voltage that a motor generates by its speed, as a fraction of the battery's."""
        if self.kit is None:
            return 0.0
        wheel = self.kit.wheels[side]
        return float(wheel.speed * (_ONE - self.kit.speed_kept) / max(wheel.strength, 1) / self.kit.supply)

    def _push(self, side: int) -> int:
        """Motor voltage from an output of the bridge, 1/65536 of the battery's."""
        if not self._high("BRIDGE_AWAKE"):
            return 0
        name, motor = SIDES[side], 1 - side if self.swapped else side
        inputs = self._input(f"{name}_PWM"), self._input(f"{name}_BACK")
        return round(voltage(*inputs, self._emf(motor), self.winding) * _ONE)

    def beat(self) -> None:
        """Lets the parts do what the board has told them for a beat of 5 ms."""
        if self.kit is not None:
            for side in range(2):
                self._duty[side] = 0 if self.stalled[side] else self._push(1 - side if self.swapped else side)
                if self.stalled[side]:
                    self.kit.wheels[side].speed = 0
            self.library.kit_push(self.kit, self._duty)
            for side in range(2):
                count = self.library.kit_count(self.kit, side)
                more, self._counts[side] = count - self._counts[side], count
                self._turn(side, self.counts_by[side] * ((more + 0x8000) % 0x10000 - 0x8000))
        lit = self._high("INFRARED")
        samples = {name: self.ambient + light * lit for light, name in zip(self.light, SENSORS, strict=True)}
        self._measure({**samples, "BATTERY": round(self.volts * 1000 / self.divisor * _SAMPLE_PER_MV)})

    @property
    def volts(self) -> float:
        """Voltage of the battery under the load of both motors, V."""
        return self.battery_v if self.kit is None else self.library.kit_supply_mv(self.kit) / 1000

    def figures(self) -> dict[str, Any]:
        """Values at the pins: battery `volts`; left and right encoder `counts` and `duty` in %."""
        return {
            "volts": round(self.volts, 2),
            "counts": self._counted(),
            "duty": [round(self._push(side) * 100 / _ONE) for side in range(2)],
        }


class RobotOnPins(PartsOnPins):
    """The parts at the pins of a board that is emulated here.

    Attributes:
        wiring: The board's wiring.
        motors: TIM1.
        timers: TIM2 to TIM4 by name.
        converts: Whether the ADC updates the samples.
    """

    def __init__(
        self, core: Core, wiring: Wiring, motors: MotorTimer, timers: dict[str, Timer], converter: Converter
    ) -> None:
        """Starts with everything at rest.

        Args:
            core: The core whose memory receives the samples.
            wiring: The board's wiring.
            motors: TIM1.
            timers: TIM2 to TIM4 by name.
            converter: Samples the sensors.
        """
        super().__init__()
        self._core, self.wiring, self.motors, self.timers, self._converter = core, wiring, motors, timers, converter
        self.converts = True
        self._channels = wiring.pins.channels
        motors.on_update = self.beat

    def set_bridge_fault(self, failed: bool, lasts_s: float = inf) -> None:
        """As in `PartsOnPins`."""
        super().set_bridge_fault(failed, lasts_s)
        if self.wiring.meets("BRIDGE_FAULT"):
            self.motors.break_at(low=failed, lasts_s=lasts_s)

    def receive_bursts(self, count: int) -> None:
        """As in `PartsOnPins`."""
        timer = self.timers["TIM2"]
        if timer.counts_input_1() and self.wiring.meets("BEACON"):
            timer.count(count)

    def _set(self, signal: str, *, high: bool) -> None:
        port, pin = self.wiring.port(signal)
        port.drive(pin, high=high)

    def _high(self, signal: str) -> bool:
        port, pin = self.wiring.port(signal)
        return port.drives(pin)

    def _input(self, signal: str) -> float:
        use = self.wiring.pins.chip.signals[signal]
        return self.motors.duty(use.split()[1]) if self.wiring.meets(signal) else 0.0

    def _turn(self, side: int, more: int) -> None:
        """With a wire missing, an encoder counts nothing."""
        timer, name = self.timers[f"TIM{3 + side}"], f"{SIDES[side]}_ENCODER_"
        if timer.follows_encoder() and self.wiring.meets(f"{name}A") and self.wiring.meets(f"{name}B"):
            timer.count(more)

    def _counted(self) -> list[int]:
        return [self.timers[f"TIM{3 + side}"].registers[_CNT].read() for side in range(2)]

    def _measure(self, samples: Mapping[str, int]) -> None:
        if not self.converts:
            return
        met = {self._channels[name]: sample for name, sample in samples.items() if self.wiring.meets(name)}
        filled = self._converter.convert(met)
        if filled is not None:
            self._core.write(*filled)
