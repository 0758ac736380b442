"""Checks what a robot was told: recomputes the CRC that it reports from the commands that it answered."""

from binascii import crc_hqx
from collections.abc import Sequence

from host_sim.protocol.codec import Frame
from host_sim.protocol.generated import Opcode

_ASKING = (Opcode.GET, Opcode.REPORT)
_BEGINNING = (Opcode.START, Opcode.RESUME)


class Told:
    """The commands that a robot has carried out, as HEALTH's `held` has them.

    Attributes:
        owned: Whether one of them has made this simulator its owner.
    """

    def __init__(self) -> None:
        """A robot that was stopped without having an owner."""
        self.owned = False
        self._crc: int | None = 0

    def carry_out(self, command: Frame) -> None:
        """The robot has said that it carried out a command."""
        opcode = command.data[1] >> 4
        if opcode in _ASKING:
            return
        if opcode == Opcode.STOP and not self.owned:
            self._crc = 0
        elif self._crc is not None:
            self._crc = crc_hqx(command.data[1:], self._crc)
        self.owned = opcode in _BEGINNING or (self.owned and opcode != Opcode.STOP)

    def agrees(self, held: int, memory: Sequence[int]) -> bool:
        """Whether the robot was told this and nothing else; without an owner, also whether its memory is this."""
        if self._crc is None:
            return True
        return held == (self._crc if self.owned else crc_hqx(bytes(memory), self._crc))

    def give_up(self) -> None:
        """Somebody else has told it something: from now on all agrees, until it is stopped without an owner."""
        self._crc = None
