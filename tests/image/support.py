"""What the tests of images share: a talk with a board, frame by frame."""

from dataclasses import dataclass, field
from pathlib import Path

from host_sim.client.commands import handshake
from host_sim.client.connection import Connection
from host_sim.client.frame_log import FrameLog
from host_sim.client.robot_client import RobotClient
from host_sim.emulator.board import EmulatedBoard, start_board
from host_sim.emulator.hardware import Faults
from host_sim.lab.bench.short_run import step_through
from host_sim.protocol.codec import COUNTERS as COUNTER_SPAN
from host_sim.protocol.codec import DecodedFrame, Frame, Protocol
from host_sim.protocol.generated import ODOMETER_COUNTS_PER_MM, ODOMETER_SPAN, TICK_SPAN, Senses
from host_sim.sim.make import assemble
from host_sim.sim.run_config import RunConfig

TICK_S = 0.02
READY_S = 5.0
COUNTERS = (
    *("silences", "missed", "stale", "damaged", "foreign", "unsent", "refused", "unsaved", "twins", "contradictions"),
    *("denied", "bus_offs", "dropped"),
)


@dataclass
class Talk:
    """Orders and senses to a board, and all that it said."""

    board: EmulatedBoard
    lockstep: int = 1
    heard: list[DecodedFrame] = field(default_factory=list)
    tick: int = -1
    counter: int = 0
    odometers: list[int] = field(default_factory=lambda: [0, 0])
    protocol: Protocol = field(default_factory=Protocol)

    def order(self, opcode: str, **signals: int) -> None:
        self.counter = (self.counter + 1) % COUNTER_SPAN
        number = self.protocol.choices("COMMAND", "opcode")[opcode]
        fixed = {"counter": self.counter, "opcode": number, "owner": 1}
        self.board.send(self.protocol.encode("COMMAND", {**fixed, **signals}))
        self.wait(0.005)

    def start(self) -> None:
        self.order("start", profile=0, seed=1, lockstep=self.lockstep)

    def senses(self, feel: int = 0) -> Frame:
        self.tick += 1
        self.roll()
        return self.protocol.encode_senses(
            Senses(self.tick % TICK_SPAN, feel, False, False, 0, *self.odometers), self.tick % COUNTER_SPAN
        )

    def roll(self) -> None:
        """The wheels do as they were told last."""
        drive = next((said.signals for said in reversed(self.heard) if said.name == "DRIVE"), {"left": 0, "right": 0})
        speeds = (drive["left"], drive["right"])
        turned = (round(speed * TICK_S * ODOMETER_COUNTS_PER_MM) for speed in speeds)
        self.odometers = [(at + more) % ODOMETER_SPAN for at, more in zip(self.odometers, turned, strict=True)]

    def live(self, ticks: int, feel: int = 0) -> list[DecodedFrame]:
        """Runs a number of ticks in real time; returns the drives."""
        before = len(self.heard)
        for _ in range(ticks):
            self.board.send(self.senses(feel))
            self.wait(TICK_S)
        return [said for said in self.heard[before:] if said.name == "DRIVE"]

    def wait(self, span_s: float) -> list[DecodedFrame]:
        said = [self.protocol.decode(frame) for frame in self.board.pass_time(span_s)]
        assert None not in said, "the board sent a frame that the protocol does not have"
        self.heard.extend(said)
        return said

    def last(self, name: str) -> dict[str, int]:
        return next(said.signals for said in reversed(self.heard) if said.name == name)

    def ask(self) -> dict[str, int]:
        """Stops the robot; returns what it says of itself: all its reports together."""
        before = len(self.heard)
        self.order("stop")
        self.wait(0.02)
        report: dict[str, int] = {}
        for said in self.heard[before:]:
            report |= said.signals
        return report

    @property
    def memory(self) -> tuple[int, ...]:
        """The eight cells, as last reported."""
        cells = {
            name: value
            for said in self.heard
            if said.name == "MEMORY"
            for name, value in said.signals.items()
            if name.startswith("cell_")
        }
        return tuple(cells[f"cell_{cell}"] for cell in range(8))


def run_robot(connection: Connection, seed: int, ticks: int, log: Path) -> RobotClient:
    """A run of a number of ticks with a robot that is there already; returns its client, as it was at the end."""
    client = RobotClient(connection, Protocol(), FrameLog(log))
    handshake(client, READY_S)
    step_through(assemble([client], RunConfig(seed=seed)), ticks)
    client.log.close()
    return client


def talk_to(name: str, faults: Faults | None = None, lockstep: int = 0) -> Talk:
    talk = Talk(start_board(name, faults), lockstep)
    talk.wait(0.001)
    talk.heard.clear()  # what it said while it waited for this
    return talk


def is_rest(said: DecodedFrame) -> bool:
    return said.signals["left"] == said.signals["right"] == 0


def counted(report: dict[str, int]) -> dict[str, int]:
    """The fault counters that are not zero."""
    return {name: report[name] for name in COUNTERS if report[name]}


def write(peripheral, offset, value):
    """Writes a register of a model."""
    peripheral.registers[offset].write(value)


def read(peripheral, offset):
    """Reads one."""
    return peripheral.registers[offset].read()
