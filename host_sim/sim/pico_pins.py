"""A robot with a body on the pins of a Raspberry Pi Pico, which runs in rp2040js."""

from collections.abc import Mapping
from math import inf
from pathlib import Path

from host_sim.emulator.board_pins import place_of, read_pins
from host_sim.emulator.can import CanFrame
from host_sim.emulator.clock import SECOND
from host_sim.emulator.pins_board import SensesByPins
from host_sim.emulator.robot_on_pins import SIDES, PartsOnPins
from host_sim.protocol.codec import Frame
from host_sim.sim.access import PICO
from host_sim.sim.pico import SteppedPico

_BOOT_S = 0.6
"""Enough time to erase the sectors of a full store."""

_LATE_US = 5100
"""A beat is 5 ms; while the flash is written, none comes."""

_HALF, _SPIKE_S = 0.5, 1e-3
_NANOS = 10**9


class PicoParts(PartsOnPins):
    """The parts at a Pico's pins. The supply and the motors' voltages are two thirds of a kit's.

    Attributes:
        orders: Orders to pico.mjs before its next beat, which set its pins.
        places: The pin of each signal's wire.
        shares: The share of the last beat for which each pin was driven high.
    """

    divisor = 4.5
    """A third of the supply is measured, and 4.8 V of it stand for a kit's 7.2 V."""

    def __init__(self) -> None:
        """Starts with everything at rest."""
        super().__init__()
        pins = read_pins(PICO)
        self.orders: list[str] = []
        self.places = {signal: place_of(pin)[1] for signal, pin in pins.signals.items()}
        self.shares = [0.0] * 30
        self._channels = pins.channels
        self._totals = [0, 0]

    def set_bridge_fault(self, failed: bool, lasts_s: float = inf) -> None:
        """As in `PartsOnPins`; a spike is too short to be sampled."""
        self._set("BRIDGE_FAULT", high=not failed)
        if lasts_s < _SPIKE_S:
            self._set("BRIDGE_FAULT", high=True)

    def receive_bursts(self, count: int) -> None:
        """As in `PartsOnPins`: the receiver pulls its output low for each."""
        for _ in range(count):
            self._set("BEACON", high=False)
            self._set("BEACON", high=True)

    def _set(self, signal: str, *, high: bool) -> None:
        self.orders.append(f"drive {self.places[signal]} {high:d}")

    def _high(self, signal: str) -> bool:
        return self.shares[self.places[signal]] > _HALF

    def _input(self, signal: str) -> float:
        return self.shares[self.places[signal]]

    def _turn(self, side: int, more: int) -> None:
        self._totals[side] = (self._totals[side] + more) % 0x10000
        if more:
            self.orders.append(f"turn {self.places[f'{SIDES[side]}_ENCODER_A']} {more}")

    def _counted(self) -> list[int]:
        return list(self._totals)

    def _measure(self, samples: Mapping[str, int]) -> None:
        by_channel = {channel: samples[signal] for signal, channel in self._channels.items()}
        self.orders.append("sample " + " ".join(str(min(by_channel[at], 4095)) for at in sorted(by_channel)))


class PicoOnPins(SensesByPins):
    """A robot with a body on the pins of a Pico."""

    robot: PicoParts

    def __init__(self, image: Path, *options: str, node: int = 1) -> None:
        """Starts the image, and lets it come up.

        Args:
            image: The contents of the flash.
            options: Options of pico.mjs.
            node: The robot's number.

        Raises:
            UsageError: Node or rp2040js is not installed.
            OctetError: The image is not built.
            RobotError: rp2040js ended.
        """
        super().__init__(node)
        self.robot = PicoParts()
        self._now = 0
        self.pico = SteppedPico(image, *options)
        self._said.extend(self._listen(round(_BOOT_S * SECOND)))

    def status(self) -> str:
        """As in `TimedBoard`."""
        return "is an emulated pico that runs on its own pins"

    def close(self) -> None:
        """As in `Link`."""
        super().close()
        self.pico.close()

    @property
    def _moment(self) -> int:
        return self._now

    def _say(self, frame: Frame) -> None:
        self.pico.send(frame)

    def _stop(self) -> None:
        """Does nothing: it stands still between two beats."""

    def _run_until(self, moment: int) -> None:
        while not self._has_news() and self._now < moment:
            orders, self.robot.orders = [*self.robot.orders, f"beat {_LATE_US}"], []
            passed, *shares = self.pico.order(*orders)[-1].split()
            self._now += int(passed) * SECOND // _NANOS
            self.robot.shares = [float(share) for share in shares]
            self.robot.beat()
            said, self.pico.said = self.pico.said, []
            for frame in said:
                self._receive(CanFrame(frame.id, frame.data))
