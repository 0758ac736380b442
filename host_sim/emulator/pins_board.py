"""A robot with a body on pins: an emulated board that senses and moves in the arena through its pins."""

from abc import abstractmethod
from collections import deque
from collections.abc import Callable
from pathlib import Path

from host_sim.base.errors import UsageError
from host_sim.base.paths import image_path
from host_sim.emulator.board import EmulatedBoard, TimedBoard
from host_sim.emulator.can import CanFrame
from host_sim.emulator.chips import CHIPS, Chip
from host_sim.emulator.clock import SECOND
from host_sim.emulator.hardware import Faults
from host_sim.emulator.robot_on_pins import PartsOnPins, RobotOnPins
from host_sim.protocol.codec import Frame, Protocol, counter_of
from host_sim.protocol.generated import Opcode, Reason, Senses
from host_sim.world.body import Body

PINS = "pins"
"""Name of the image, and the kind of body."""

_ANSWER_S = 0.1


class SensesByPins(TimedBoard):
    """A `Link` to a robot that senses through its pins; `sense` passes it the state of its body.

    The client's senses never reach the board: they are those that the board reported. Its drives are returned with
    the tick numbers of the client.
    """

    robot: PartsOnPins

    def __init__(self, node: int) -> None:
        """It has said nothing yet.

        Args:
            node: The robot's number.
        """
        TimedBoard.__init__(self)  # a board's own follows
        self._protocol = Protocol(node)
        self._senses_id, self._drive_id = self._protocol.id_of("SENSES"), self._protocol.id_of("DRIVE")
        self._pairs: deque[tuple[Frame, Frame]] = deque()
        self._sensed: Frame | None = None
        self._drive: Frame | None = None
        self._waits = self._asked = False

    @abstractmethod
    def _say(self, frame: Frame) -> None:
        """Sends the board a frame."""

    def sense(self, body: Body, senses: Senses, tick: int) -> Senses:
        """Lets a tick pass on the board.

        Args:
            body: The body, with its position.
            senses: Senses of an ideal body there.
            tick: Number of the tick in the run.

        Returns:
            The senses that the board reports; `senses` if it reports none.
        """
        self._drive = None
        self.robot.feel(body, senses, tick)
        self._waits = True
        deadline = self._moment + round(_ANSWER_S * SECOND)
        said = self._said
        self._said = deque()
        while not self._pairs and self._moment < deadline:
            self._run_until(deadline)
            said.extend(self._said)
            self._said.clear()
        self._said, self._waits = said, False
        if not self._pairs:
            return senses
        sensed, self._drive = self._pairs.popleft()
        decoded = self._protocol.decode(sensed)
        assert decoded is not None  # it was checked when it came
        return senses._replace(
            feel=decoded.signals["feel"],
            bump=bool(decoded.signals["bump"]),
            look=bool(decoded.signals["look"]),
            beacon_mm=decoded.signals["beacon"],
            odometer_left=decoded.signals["odometer_left"],
            odometer_right=decoded.signals["odometer_right"],
        )

    def send(self, frame: Frame) -> None:
        """As in `Link`."""
        if frame.id != self._senses_id:
            self._asked = True
            command = self._protocol.decode(frame)
            if command is not None and command.signals.get("opcode") == Opcode.START:
                self._drive = None  # an earlier drive is no answer
            self._say(frame)
            return
        if self._drive is None and self._pairs:
            _, self._drive = self._pairs.popleft()
        if self._drive is not None:
            drive = self._protocol.decode(self._drive)
            senses = self._protocol.decode(frame)
            assert drive is not None  # it was checked when it came
            assert senses is not None  # encoded by this simulator
            numbers = {"tick": senses.signals["tick"], "counter": counter_of(frame)}
            answer = self._protocol.encode("DRIVE", {**drive.signals, **numbers})
            self._said.append(CanFrame(answer.id, answer.data))

    def _has_news(self) -> bool:
        return bool(self._said) or (self._waits and bool(self._pairs))

    def _receive(self, frame: CanFrame) -> None:
        said = Frame(frame.id, frame.data)
        if said.id == self._senses_id:
            self._sensed = said
        elif said.id == self._drive_id and self._sensed is not None:
            self._take_pair(self._sensed, said)
        else:
            super()._receive(frame)

    def _take_pair(self, sensed: Frame, drive: Frame) -> None:
        """Takes a tick's frames; at rest with nobody waiting, only the first tick after a command is reported."""
        decoded = self._protocol.decode_drive(drive)
        if self._protocol.decode(sensed) is None or decoded is None:
            return
        if self._waits or decoded.reason != Reason.STOP:
            self._pairs.append((sensed, drive))
            self._stop()
        elif self._asked:
            self._asked = False
            super()._receive(CanFrame(drive.id, drive.data))


class PinsBoard(SensesByPins, EmulatedBoard):
    """Such a robot on a board that is emulated here."""

    robot: RobotOnPins

    def __init__(self, chip: Chip, image: Path, faults: Faults | None = None, node: int = 1) -> None:
        """As in `EmulatedBoard`."""
        SensesByPins.__init__(self, node)
        EmulatedBoard.__init__(self, chip, image, faults)
        assert self.hardware.robot is not None  # only such chips have this image
        self.robot = self.hardware.robot

    def status(self) -> str:
        """As in `EmulatedBoard`."""
        return f"{super().status()}; it runs on its own pins"

    def _say(self, frame: Frame) -> None:
        EmulatedBoard.send(self, frame)


def start_robot(name: str, faults: Faults | None = None, image: Callable[[str, str], Path] = image_path) -> PinsBoard:
    """Starts a board with the image of a robot with a body on pins.

    Args:
        name: A board with pins for one, such as `blue_pill`.
        faults: Hardware faults to simulate.
        image: Names the image, as in `start_board`.

    Raises:
        UsageError: The board has no such image.
        OctetError: The image is not built.
        BoardError: The image did something that the hardware does not allow.
    """
    boards = [chip.name for chip in CHIPS.values() if chip.converter]
    if name not in boards:
        raise UsageError(f"there is no image with a body on pins for {name}: use --board {', '.join(boards)} or pico")
    return PinsBoard(CHIPS[name], image(name, PINS), faults)
