"""The parts wired to a body's pins: motors, encoders, sensors, bumpers, a button and a battery."""

from typing import Any

from host_sim.emulator.converter import Converter
from host_sim.emulator.core import Core
from host_sim.emulator.timers import MotorTimer, Timer
from host_sim.emulator.wiring import Wiring
from host_sim.protocol.generated import FEEL, Senses
from host_sim.world.body import Body
from host_sim.world.world_library import world_library

SIDES = ("LEFT", "RIGHT")
SENSORS = [f"PROXIMITY_{name.upper().replace('-', '_')}" for name in FEEL]
_SAMPLE_PER_MV = 4096 / 3300 / 3
_ONE = 65536
_CNT = 0x24

_NEAR_MM, _STRONG, _WEAK = 150, 4, 4
"""Bursts of a beacon in a tick: strong ones reach as far as it is seen, weak ones `_NEAR_MM`."""


class RobotOnPins:
    """Connects the pins of a board to a body of the world, a `struct kit`.

    Attributes:
        wiring: The board's wiring.
        motors: TIM1.
        timers: TIM2 to TIM4 by name.
        ffi: The interface to the world's library.
        library: The world's library.
        kit: The body; None if there is none: then nothing turns.
        light: Light that each proximity sensor receives from its own LEDs while they are on, 0..4095.
        ambient: Light that it receives with the LEDs off.
        battery_v: Battery voltage while there is no body, V.
        counts_by: Sign of each encoder's counts: -1 if its wires are swapped.
        stalled: Whether each motor is blocked.
        swapped: Whether the connectors of the two motors are swapped.
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
        self._core, self.wiring, self.motors, self.timers, self._converter = core, wiring, motors, timers, converter
        self.ffi, self.library = world_library()
        self.kit: Any = None
        self.light, self.ambient, self.battery_v = [0] * len(SENSORS), 300, 7.4
        self._light: Any = self.ffi.new("uint16_t[]", len(SENSORS))
        self.counts_by, self.stalled, self.swapped, self.converts = [1, 1], [False, False], False, True
        self._duty: Any = self.ffi.new("int32_t[2]")
        self._counts = [0, 0]
        self._channels = wiring.pins.channels
        motors.on_update = self._beat

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

    def set_bridge_fault(self, failed: bool) -> None:
        """Sets or clears the bridge's fault signal."""
        self._set("BRIDGE_FAULT", high=not failed)
        if self.wiring.meets("BRIDGE_FAULT"):
            self.motors.break_at(low=failed)

    def receive_bursts(self, count: int) -> None:
        """Receives bursts of a beacon's light."""
        timer = self.timers["TIM2"]
        if timer.counts_input_1() and self.wiring.meets("BEACON"):
            timer.count(count)

    def _set(self, signal: str, *, high: bool) -> None:
        port, pin = self.wiring.port(signal)
        port.drive(pin, high=high)

    def _high(self, signal: str) -> bool:
        port, pin = self.wiring.port(signal)
        return port.drives(pin)

    def _push(self, side: int) -> int:
        """Motor voltage, 1/65536 of the battery's: that of the PWM half-bridge minus the other's."""
        if not self._high("BRIDGE_AWAKE"):
            return 0
        duty = self.motors.duty(2 + side) if self.wiring.meets(f"{SIDES[side]}_PWM") else 0.0
        return round((duty - self._high(f"{SIDES[side]}_BACK")) * _ONE)

    def _beat(self) -> None:
        if self.kit is not None:
            for side in range(2):
                self._duty[side] = 0 if self.stalled[side] else self._push(1 - side if self.swapped else side)
                if self.stalled[side]:
                    self.kit.wheels[side].speed = 0
            self.library.kit_push(self.kit, self._duty)
            for side in range(2):
                self._count(side)
        if self.converts:
            self._fill()

    def _count(self, side: int) -> None:
        """Updates an encoder's count; with a wire missing, it counts nothing."""
        count = self.library.kit_count(self.kit, side)
        more, self._counts[side] = count - self._counts[side], count
        timer, name = self.timers[f"TIM{3 + side}"], f"{SIDES[side]}_ENCODER_"
        if timer.follows_encoder() and self.wiring.meets(f"{name}A") and self.wiring.meets(f"{name}B"):
            timer.count(self.counts_by[side] * ((more + 0x8000) % 0x10000 - 0x8000))

    @property
    def volts(self) -> float:
        """Voltage of the battery under the load of both motors, V."""
        return self.battery_v if self.kit is None else self.library.kit_supply_mv(self.kit) / 1000

    def figures(self) -> dict[str, Any]:
        """Values at the pins: battery `volts`; left and right encoder `counts` and `duty` in %."""
        return {
            "volts": round(self.volts, 2),
            "counts": [self.timers[f"TIM{3 + side}"].registers[_CNT].read() for side in range(2)],
            "duty": [round(self._push(side) * 100 / _ONE) for side in range(2)],
        }

    def _fill(self) -> None:
        shines, battery_v = self._high("INFRARED"), self.volts
        samples = {}
        for light, signal in zip(self.light, SENSORS, strict=True):
            if self.wiring.meets(signal):
                samples[self._channels[signal]] = self.ambient + light * shines
        if self.wiring.meets("BATTERY"):
            samples[self._channels["BATTERY"]] = round(battery_v * 1000 * _SAMPLE_PER_MV)
        filled = self._converter.convert(samples)
        if filled is not None:
            self._core.write(*filled)
