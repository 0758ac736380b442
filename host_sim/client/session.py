"""A session with a robot: its settings at the start, its counters, and what it was told or asked."""

from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from zlib import crc32

from host_sim.client.robot_reports import Arrival
from host_sim.protocol.codec import COUNTERS, DecodedFrame, Frame, counter_of
from host_sim.protocol.generated import Opcode


@dataclass
class Session:
    """The settings with which a robot was started, so that it can be restarted.

    Attributes:
        seed: Seed for its random turns, 0..2**32 - 1.
        profile: Number of its profile.
        settings: Parameters to set, by name.
        frozen: Whether its learning is frozen.
        halted: Whether it has stopped because its wheels did not follow the command.
        missing: Number of frames that were missing before it was started.
    """

    seed: int
    profile: int = 0
    settings: Mapping[str, int] = field(default_factory=dict)
    frozen: bool = False
    halted: bool = False
    missing: int = 0


@dataclass
class FrameCounts:
    """Frame counters of a client; `summary.frame_counts` adds those that the robot reports.

    Attributes:
        sent: Number of frames sent to the robot, each counted once.
        received: Number of valid frames received from it, each counted once.
        repeated: Number of frames sent again because no answer came in time.
        duplicate: Number of valid frames received with nothing new: answers to repeated frames, late or doubled
            ones, and a waiting robot's signs of life.
        lost: Number of senses that were not answered in time.
        refused: Number of frames that were damaged or foreign.
    """

    sent: int = 0
    received: int = 0
    repeated: int = 0
    duplicate: int = 0
    lost: int = 0
    refused: int = 0

    @property
    def missing(self) -> int:
        """Number of frames known to be lost or damaged."""
        return self.lost + self.repeated + self.refused


_ASKING = (Opcode.GET, Opcode.REPORT)
_BEGINNING = (Opcode.START, Opcode.RESUME)
_KNOWN = COUNTERS - 1
_RIVAL_S = 1.0
_LATE_MAX = 256
"""A report that is more ticks late than this comes after several newer ones, so it is not read."""
_NO_DRIVE = bytes(8)


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


def heard_more(heard: int, senses: bytes, drive: bytes) -> int:
    """Continues the check over senses; the drive is the answer to the previous ones, or zeros."""
    both = int.from_bytes(senses[1:], "big") ^ int.from_bytes(drive[1:], "big")
    return crc32(both.to_bytes(len(senses) - 1, "big"), heard)


class HeldCheck:
    """What a robot was told: the commands that it has carried out, and in lockstep the senses that it has obeyed.

    HEALTH's `held` and the answer to a stop are compared with it.

    Attributes:
        owned: Whether a command has made this simulator the robot's owner.
        settled: Whether it agreed after it was stopped.
        given_up: Whether another simulator has commanded it; from then on everything counts as agreement.
        asked: The senses in lockstep that it has not answered yet; it may have obeyed them.
        answered: Those that it has answered since the check over them was last computed, each with its answer.
        takes_senses: Whether it obeys the senses sent here; False for a robot that senses for itself.
    """

    def __init__(self, *, takes_senses: bool = True) -> None:
        """Starts with a robot that is stopped and has no owner."""
        self.takes_senses = takes_senses
        self.owned = self.given_up = self.settled = False
        self.asked: Frame | None = None
        self.answered: list[tuple[Frame, Frame]] = []
        self._heard, self._drive = 0, _NO_DRIVE
        self._before: deque[int] = deque(maxlen=_LATE_MAX)
        self._crc = self._opcodes = 0
        self._proved = True

    @property
    def commands(self) -> int:
        """CRC-32 over the commands that it has carried out."""
        return self._crc

    @property
    def heard(self) -> int:
        """CRC-32 over the senses that it has answered since it was started, and over the answers before the last."""
        for senses, drive in self.answered:
            self._before.append(self._heard)
            self._heard, self._drive = heard_more(self._heard, senses.data, self._drive), drive.data
        self.answered.clear()
        return self._heard

    def ask(self, senses: Frame | None) -> None:
        """Notes senses that were sent in lockstep, in place of earlier ones; None for others."""
        self.asked = senses if self.takes_senses else None

    @property
    def drive(self) -> bytes:
        """The last answer; zeros for none."""
        return self.answered[-1][1].data if self.answered else self._drive

    def take_drive(self, drive: Frame) -> None:
        """Notes the answer to the senses asked in lockstep, if any."""
        if self.asked is not None:
            self.answered.append((self.asked, drive))
            self.asked = None

    def go_on(self, *heard: int, drive: Frame) -> None:
        """Takes over the check after each of the last senses that were answered, in order, and the last answer."""
        self._before.extend((self.heard, *heard[:-1]))
        self._heard, self._drive = heard[-1], drive.data

    def carry_out(self, command: Frame, answer: DecodedFrame) -> None:
        """Notes a command that the robot has carried out."""
        opcode = command.data[1] >> 4
        if opcode in _ASKING:
            return
        if opcode == Opcode.STOP and self.owned:
            of_robot = answer.signals["value"], answer.signals["which"]
            self._proved = self._proved and of_robot == (self._crc, self._opcodes % 256)
        if opcode in _BEGINNING or not self.owned:
            self._heard, self._drive = 0, _NO_DRIVE
            self.answered.clear()
            self._before.clear()
        if opcode == Opcode.STOP and not self.owned:
            self._proved = self._proved and (self.settled or not self._crc)
            self._crc = self._opcodes = 0
        else:
            self._crc, self._opcodes = crc32(command.data[1:], self._crc), self._opcodes + opcode
        self.owned = opcode in _BEGINNING or (self.owned and opcode != Opcode.STOP)
        self.settled = self.settled and opcode not in _BEGINNING

    def agrees(self, held: int, memory: Sequence[int]) -> bool:
        """Whether the robot got exactly these commands and senses; without an owner, also whether this is its memory.

        While it runs, the report may be late, so that it does not cover the last senses.
        """
        crc = self._crc if self.owned else crc32(bytes(memory), self._crc)
        is_reset = self.settled and held == crc32(bytes(memory)) & 0xFFFF
        return self.given_up or (self._proved and (is_reset or self._may_have_heard((held ^ crc) & 0xFFFF)))

    def settle(self, held: int, memory: Sequence[int]) -> None:
        """Notes for good if a report of a stopped robot agrees: another stop, or a late copy, sets its check to 0."""
        self.settled = self.settled or (not self.owned and self.agrees(held, memory))

    def _may_have_heard(self, half: int) -> bool:
        """Whether this is the lower half of a check over the senses, with or without those not answered yet."""
        heard = self.heard if self.takes_senses else 0
        checks = [heard, *(self._before if self.owned else ())]
        if self.asked is not None:
            checks.append(heard_more(heard, self.asked.data, self.drive))
        return any(check & 0xFFFF == half for check in checks)


class Rivals:
    """Other simulators that command the same robot.

    Attributes:
        heard: Second frame heard within a second from another simulator, if any.
    """

    def __init__(self, owner: int, asked: AskedCommands) -> None:
        """Starts without any known rival.

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
