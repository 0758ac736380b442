"""A stand-alone robot in LabWired drives in the arena as on our emulator.

Core, GPIO, duties, CAN and store are LabWired's; encoders, ADC and DMA are plain memory there, which `RobotOnPins`
fills, and TIM1 repeats by a prescaler, since LabWired ignores its repetition counter. It takes eight times as long as
the robot's own time. For more than a second: .venv/bin/python -m tests.judges.test_closed_loop, which
prints how many frames were compared and the first that differs; exit code 1 if one does.
"""

import argparse
import sys
import tempfile
from collections import deque
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from unittest.mock import patch

import host_sim.emulator.pins_board as ours
from host_sim.client.frame_log import FrameLog
from host_sim.emulator.board_pins import place_of, read_pins
from host_sim.emulator.can import CanFrame
from host_sim.emulator.chips import Chip
from host_sim.emulator.clock import SECOND
from host_sim.emulator.robot_on_pins import RobotOnPins
from host_sim.lab.bench.short_run import run_ticks
from host_sim.protocol.codec import Protocol
from host_sim.sim.run_config import RunConfig
from tests.judges.labwired_board import INPUTS, Board

TIM1, ADC1_CR2 = 0x40012C00, 0x40012408
PORTS = {0: 0x40010800, 1: 0x40010C00, 2: 0x40011000}
MEMORIES = {"tim2": 0x40000000, "tim3": 0x40000400, "tim4": 0x40000800, "adc1": 0x40012400, "dma1": 0x40020000}
CALIBRATION, REPETITIONS = 12, 13
"""Bits that the ADC clears when it has calibrated itself; 13 x 3600 cycles at an eighth of 72 MHz are 5.2 ms."""


class Port:
    """A port, as `RobotOnPins` uses it."""

    def __init__(self, sim: Any, number: int) -> None:
        """One of `PORTS`."""
        names = {f"gpio{'abc'[number]}": number}
        self._contacts = {pin: name for name, (port, pin) in INPUTS.items() if port in names}
        self._sim, self._odr = sim, PORTS[number] + 0x0C

    def drive(self, pin: int, *, high: bool) -> None:
        """Drives a contact."""
        self._sim.set_pin(self._contacts[pin], high)

    def drives(self, pin: int) -> bool:
        """Whether the robot drives a pin high."""
        return bool(self._sim.read_u32(self._odr) >> pin & 1)


class Timer:
    """A timer in encoder mode, in plain memory."""

    def __init__(self, sim: Any, base: int) -> None:
        """At that address."""
        self._sim, self._base = sim, base

    def follows_encoder(self) -> bool:
        """Whether it counts an encoder."""
        return bool(self._sim.read_u32(self._base + 8) & 7 == 3)

    def counts_input_1(self) -> bool:
        """Whether it counts pulses."""
        return True

    def count(self, more: int) -> None:
        """Counts up or down."""
        self._sim.write_u32(self._base + 0x24, (self._sim.read_u32(self._base + 0x24) + more) & 0xFFFF)


class Motors:
    """TIM1, which is LabWired's."""

    def __init__(self, sim: Any) -> None:
        """Of a simulation."""
        self._sim = sim

    def duty(self, output: str) -> float:
        """Fraction of time for which an output is high."""
        read, channel, enable = self._sim.read_u32, int(output[2]), 2 if output.endswith("n") else 0
        on = read(TIM1 + 0x44) >> 15 & read(TIM1 + 0x20) >> 4 * (channel - 1) + enable & 1
        return read(TIM1 + 0x30 + 4 * channel) / (read(TIM1 + 0x2C) + 1) if on else 0.0

    def break_at(self, *, low: bool) -> None:
        """LabWired has no break input."""


class LabWiredPins(ours.PinsBoard):
    """A `PinsBoard` whose core is LabWired's."""

    def __init__(self, chip: Chip, image: Path, faults: object = None, node: int = 1) -> None:  # noqa: ARG002 - as ours
        """Starts the image."""
        self._protocol = Protocol(node)
        self._senses_id, self._drive_id = self._protocol.id_of("SENSES"), self._protocol.id_of("DRIVE")
        self._pairs, self._said = deque(), deque()
        self._sensed = self._drive = None
        self._waits = self._asked = self._serial = False
        self.resets, self.drift = [], 0.0
        self._clock: Any = SimpleNamespace(now=0)
        self._folder = tempfile.TemporaryDirectory()
        self._board = Board(chip.name, "pins", Path(self._folder.name), MEMORIES)
        self._sim = sim = self._board.sim
        ports, pins = {number: Port(sim, number) for number in PORTS}, read_pins(chip.name)

        def port(signal: str) -> tuple[Port, int]:
            number, pin = place_of(pins.signals[signal])
            return ports[number], pin

        def convert(samples: Any) -> tuple[int, bytes]:
            values = (min(samples[channel], 4095) for channel in range(6))
            return sim.symbol("samples"), b"".join(value.to_bytes(2, "little") for value in values)

        wiring: Any = SimpleNamespace(pins=pins, port=port, meets=lambda *_: True)
        timers: Any = {f"TIM{n}": Timer(sim, MEMORIES[f"tim{n}"]) for n in (2, 3, 4)}
        core: Any = SimpleNamespace(write=self._board.flash, stop=lambda: None)
        converter: Any = SimpleNamespace(convert=convert)
        motors: Any = Motors(sim)
        self.robot = RobotOnPins(core, wiring, motors, timers, converter)
        can = SimpleNamespace(put=lambda frame: sim.inject_can("bxcan1", frame.id, frame.data))
        self.hardware: Any = SimpleNamespace(chip=chip, robot=self.robot, on_bus=True, core=core, can=can)
        self._start()

    def close(self) -> None:
        """Ends the simulation."""
        self._sim.close()
        self._folder.cleanup()

    def _start(self) -> None:
        sim = self._sim
        for _ in range(4000):
            sim.run_for("50us")
            if sim.read_u32(TIM1) & 1:
                break
            sim.write_u32(ADC1_CR2, sim.read_u32(ADC1_CR2) & ~CALIBRATION)
        sim.write_u32(TIM1 + 0x28, REPETITIONS - 1)
        sim.run_for("3ms")
        for _ in range(8):
            self._beat()

    def _beat(self) -> None:
        self.robot.beat()
        for frame in self._board.listen("5.2ms"):
            self._receive(CanFrame(frame.id, frame.data))
        self._clock.now += SECOND // 200

    def _run_until(self, moment: int) -> None:
        while not self._has_news() and self._clock.now < moment:
            self._beat()


class Backward(LabWiredPins):
    """One whose left encoder counts backward."""

    def __init__(self, *arguments: Any, **named: Any) -> None:
        """As `LabWiredPins`."""
        super().__init__(*arguments, **named)
        self.robot.counts_by[0] = -1


def frames(board: type[ours.PinsBoard], limit_s: float, seed: int) -> list[str]:
    """The frames of a run from the first SENSES to the answer to the last: at rest, ticks are reported by chance."""
    config = RunConfig(seed=seed, robot="emulated", board="blue_pill", body="pins")
    with tempfile.TemporaryDirectory() as folder, patch.object(ours, "PinsBoard", board):
        log = Path(folder) / "run.log"
        run_ticks(config, round(limit_s * 50), FrameLog(log))
        found = [line.rsplit(" ", 1)[-1] for line in log.read_text().splitlines()]
    senses = f"{Protocol().id_of('SENSES'):03X}#"
    ticks = [place for place, frame in enumerate(found) if frame.startswith(senses)]
    return found[ticks[0] : ticks[-1] + 2]


def test_stand_alone_robot_drives_in_labwired_as_on_our_emulator():
    assert frames(LabWiredPins, 1.0, 1) == frames(ours.PinsBoard, 1.0, 1)


def test_backward_encoder_shows_up_as_a_difference():
    assert frames(Backward, 0.3, 1) != frames(ours.PinsBoard, 0.3, 1)


def main() -> int:
    """Returns 0 if all frames are equal, else 1."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--limit-s", type=float, default=5.0, help="robot time (default: %(default)g)")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    expected, heard = (frames(it, arguments.limit_s, arguments.seed) for it in (ours.PinsBoard, LabWiredPins))
    different = [pair for pair in zip(expected, heard, strict=False) if pair[0] != pair[1]]
    print(f"{len(heard)} frames of {len(expected)}, {len(different)} differ", *different[:1])  # noqa: T201 - the result
    return 1 if different or len(heard) != len(expected) else 0


if __name__ == "__main__":
    sys.exit(main())
