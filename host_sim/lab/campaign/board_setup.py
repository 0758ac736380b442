"""The flash image on an emulated board or on the pins of a robot, with the hardware faults of its models."""

from collections.abc import Callable
from dataclasses import replace

from host_sim.client.robot_client import RobotClient
from host_sim.emulator.board import EmulatedBoard
from host_sim.emulator.can import CanFrame
from host_sim.emulator.clock import NEVER, SECOND, Clock
from host_sim.emulator.robot_on_pins import SENSORS, SIDES, RobotOnPins
from host_sim.lab.campaign.cell import PIN_EVENTS
from host_sim.lab.campaign.host_events import Trigger
from host_sim.lab.campaign.setups import Setup
from host_sim.sim.run_config import RunConfig
from host_sim.transport.faulty_link import FaultyLink

MS = SECOND // 1000
_NOWHERE = 0x60000000
_BELOW_RAM = 0x20000008
_WATCHDOG_S = 4
_RECORD = 16
"""Bytes of a memory record in flash."""
_BABBLE_US = 222
"""Time of a full frame without stuff bits, at 500 kbit/s."""


class Board(Setup):
    """The setup of a robot on an emulated board, which the run creates."""

    def __init__(self, name: str) -> None:
        self._name = name
        self.board: EmulatedBoard
        self.events = {
            "reset": lambda _: self.board.restart("software"),
            "power": lambda _: self.board.cut_power(),
            "watchdog": lambda _: self.board.hardware.clock.skip(_WATCHDOG_S * SECOND),
            "hang": lambda span_ms: self.board.hardware.clock.skip(span_ms * MS),
            "crash": lambda _: self.board.hardware.core.derail(_NOWHERE),
            "stack": lambda _: self.board.hardware.core.derail(_NOWHERE, _BELOW_RAM),
            "flash-cut": self._cut_in_flash,
            "erase-cut": lambda _: self._cut_in_erase(),
            "fast-clock": self._drift,
            "slow-clock": lambda percent: self._drift(-percent),
            "bus-off": lambda span_ms: self._bus("shorted", span_ms),
            "no-ack": lambda span_ms: self._bus("alone", span_ms),
            "wrong-rate": lambda span_ms: self._bus("busy", span_ms),
            "babble": self._babble,
        }

    def configured(self, config: RunConfig) -> RunConfig:
        """As in `Setup`."""
        return replace(config, robot="emulated", board=self._name)

    def found(self, client: RobotClient) -> None:
        """As in `Setup`."""
        link = client.connection.link
        link = link.link if isinstance(link, FaultyLink) else link
        assert isinstance(link, EmulatedBoard)
        self.board = link

    def _drift(self, percent: int) -> None:
        self.board.drift = percent / 100

    def _cut_in_flash(self, after: int) -> None:
        """Cuts the power during the nth write or erase from now on, and again during the next one."""
        flash = self.board.hardware.flash
        flash.cuts |= {flash.operations + after, flash.operations + after + 1}

    def _cut_in_erase(self) -> None:
        """Fills the page of memories, cuts the power, and cuts it again in each of the next two erases."""
        flash = self.board.hardware.flash
        flash.fill_last_page(_RECORD)
        flash.erasure_cuts |= {flash.erasures + 1, flash.erasures + 2}
        self.board.cut_power()

    def _bus(self, what: str, span_ms: int) -> None:
        """Applies a fault to the bus for a span of the board's time."""
        wire = self.board.hardware.can.wire
        setattr(wire, what, True)
        Later(self.board.hardware.clock, span_ms * MS, lambda: setattr(wire, what, False))

    def _babble(self, span_ms: int) -> None:
        """Fills the bus with frames of the highest priority."""
        for _ in range(span_ms * 1000 // _BABBLE_US):
            self.board.put(CanFrame(0, bytes(8)))


class Later:
    """Performs an action once, after a span of the board's time."""

    def __init__(self, clock: Clock, span: int, action: Callable[[], None]) -> None:
        self._clock, self._moment, self._action = clock, clock.now + span, action
        clock.add(self._due)
        clock.expect(self._moment)

    def _due(self) -> int:
        if self._moment <= self._clock.now:
            self._moment = NEVER
            self._action()
        return self._moment


_BOUNCE_MS = 3


class PinsRobot(Board):
    """The setup of a stand-alone robot."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        on_pins: tuple[Trigger, ...] = (
            lambda sensor: self._robot.wiring.rewire(SENSORS[sensor]),
            lambda side: self._robot.wiring.rewire(f"{SIDES[side]}_ENCODER_A"),
            lambda side: self._set("counts_by", side, -1),
            lambda side: self._set("stalled", side, True),
            lambda side: self._robot.wiring.rewire(f"{SIDES[side]}_PWM"),
            lambda _: setattr(self._robot, "swapped", True),
            lambda _: self._robot.set_bridge_fault(True),
            lambda _: setattr(self._robot, "converts", False),
            self._bounce,
        )
        self.events = {**dict(zip(PIN_EVENTS, on_pins, strict=True)), "flash-cut": self.events["flash-cut"]}

    def configured(self, config: RunConfig) -> RunConfig:
        """As in `Setup`."""
        return replace(config, robot="emulated", board=self._name, body="pins")

    def found(self, client: RobotClient) -> None:
        """As in `Setup`."""
        super().found(client)
        assert self.board.hardware.robot is not None  # only such boards have a body
        self._robot: RobotOnPins = self.board.hardware.robot

    def _set(self, what: str, side: int, value: int) -> None:
        getattr(self._robot, what)[side] = value

    def _bounce(self, span_ms: int) -> None:
        """Bounces the button's contacts, each time for less than a press takes."""
        clock = self.board.hardware.clock
        for at in range(0, span_ms, _BOUNCE_MS):
            Later(clock, at * MS, lambda down=not at // _BOUNCE_MS % 2: self._robot.set_button(down))  # type: ignore[misc]
        Later(clock, span_ms * MS, lambda: self._robot.set_button(False))
