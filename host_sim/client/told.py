"""Checks which commands a robot obeyed: recomputes its reported CRC from the commands that it answered."""

from collections.abc import Sequence
from zlib import crc32

from host_sim.protocol.codec import DecodedFrame, Frame
from host_sim.protocol.generated import Opcode

_ASKING = (Opcode.GET, Opcode.REPORT)
_BEGINNING = (Opcode.START, Opcode.RESUME)


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
