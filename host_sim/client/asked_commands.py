"""The commands of this simulator, matched with answers and with what the robot holds; other simulators."""

from collections import deque
from collections.abc import Sequence
from zlib import crc32

from host_sim.client.robot_reports import Arrival
from host_sim.protocol.codec import COUNTERS, DecodedFrame, Frame, counter_of
from host_sim.protocol.generated import Opcode

_ASKING = (Opcode.GET, Opcode.REPORT)
_BEGINNING = (Opcode.START, Opcode.RESUME)
_KNOWN = COUNTERS - 1
_RIVAL_S = 1.0


class AskedCommands:
    """The latest commands, as many as their alive counters can tell apart.

    Attributes:
        answered: Whether the last command was answered, or there was none.
    """

    def __init__(self) -> None:
        """Starts without any command."""
        self.answered = True
        self._asked: deque[Frame] = deque(maxlen=_KNOWN)

    @property
    def last(self) -> Frame:
        """The last command."""
        return self._asked[-1]

    def add(self, command: Frame) -> None:
        """Adds a command that is about to be sent."""
        self._asked.append(command)
        self.answered = False

    def has(self, command: Frame) -> bool:
        """Whether these include a command, byte for byte."""
        return command in self._asked

    def judge(self, answer: Frame) -> Arrival:
        """Classifies an answer: NEW if first to the last command, AGAIN if repeated, OTHER if nothing matches."""
        counter = counter_of(answer)
        asked = next((command for command in reversed(self._asked) if counter_of(command) == counter), None)
        if asked is None or asked.data[1] != answer.data[1]:
            return Arrival.OTHER
        if self.answered or asked is not self._asked[-1]:
            return Arrival.AGAIN
        self.answered = True
        return Arrival.NEW


class Told:
    """The commands that a robot has carried out, to compare with HEALTH's `held` and the answer to a stop.

    Attributes:
        owned: Whether one of them has made this simulator its owner.
        given_up: Whether another simulator has commanded it; from then on everything counts as agreement.
    """

    def __init__(self) -> None:
        """Starts with a robot that is stopped and has no owner."""
        self.owned = self.given_up = False
        self._crc = self._opcodes = 0
        self._proved = True

    def carry_out(self, command: Frame, answer: DecodedFrame) -> None:
        """Notes a command that the robot has carried out."""
        opcode = command.data[1] >> 4
        if opcode in _ASKING:
            return
        if opcode == Opcode.STOP and self.owned:
            of_robot = answer.signals["value"], answer.signals["which"]
            self._proved = self._proved and of_robot == (self._crc, self._opcodes % 256)
        if opcode == Opcode.STOP and not self.owned:
            self._crc = self._opcodes = 0
        else:
            self._crc, self._opcodes = crc32(command.data[1:], self._crc), self._opcodes + opcode
        self.owned = opcode in _BEGINNING or (self.owned and opcode != Opcode.STOP)

    def agrees(self, held: int, memory: Sequence[int]) -> bool:
        """Whether the robot got exactly these commands; without an owner, also whether this is its memory."""
        crc = self._crc if self.owned else crc32(bytes(memory), self._crc)
        return self.given_up or (self._proved and held == crc & 0xFFFF)


class Rivals:
    """Other simulators that command the same robot.

    Attributes:
        heard: Second frame heard within a second from another simulator, if any.
    """

    def __init__(self, owner: int, asked: AskedCommands) -> None:
        """Starts without any rival heard.

        Args:
            owner: Owner ID of this simulator.
            asked: The commands sent by this simulator.
        """
        self.heard: Frame | None = None
        self._owner, self._asked = owner, asked
        self._last_s: float | None = None

    def hear(self, frame: Frame, now_s: float) -> bool:
        """Counts a frame. Returns whether it is the second within a second: one may be noise, two are not."""
        if self._last_s is not None and now_s - self._last_s <= _RIVAL_S:
            self.heard = frame
        self._last_s = now_s
        return self.heard is frame

    def poses_as_us(self, frame: Frame, decoded: DecodedFrame) -> bool:
        """Whether a frame is a command with our owner ID sent by another: the robot obeys it, and it is not noise."""
        is_ours = decoded.signals.get("owner") == self._owner
        return decoded.name == "COMMAND" and is_ours and not self._asked.has(frame)
