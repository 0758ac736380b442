"""The status that a boot loader reports, and its reasons to refuse an update."""

import struct
from dataclasses import dataclass

from host_sim.base.errors import RobotError

_STATUS = struct.Struct(">BBBBIIIBIB4s")
REASONS = {
    1: "it is not an Octet image",
    2: "it is for another chip",
    3: "it is for another board",
    4: "it is for another layout of the flash",
    5: "it is for the other slot",
    6: "it is too long for its slot",
    7: "it is older than the board accepts; --allow-older permits it",
    8: "it is not the image that was announced",
    9: "it arrived damaged",
    10: "it is not signed by the key of this board",
    11: "the board could not write its flash",
}


class UpdateError(RobotError):
    """The board refused the update and keeps its old firmware; the message says why."""

    exit_code = 2


@dataclass(frozen=True)
class Status:
    """The status of a board, as its boot loader reports it.

    Attributes:
        installed: Bit s is set if slot s has a signed image.
        slot: The slot that starts.
        trial: 0 if its image is confirmed, else 1 more than its starts so far.
        free: The slot that an update goes to.
        floor: Lowest version that is accepted.
        versions: Versions in the slots; 0 for none.
        reason: Why the last image was refused.
        signer: The first bytes of the public key.
    """

    installed: int
    slot: int
    trial: int
    free: int
    floor: int
    versions: tuple[int, int]
    reason: int
    signer: bytes

    @classmethod
    def unpack(cls, data: bytes) -> "Status":
        """Decodes what the board sends."""
        installed, slot, trial, free, floor, a, b, _, _, reason, signer = _STATUS.unpack(data)
        return cls(installed, slot, trial, free, floor, (a, b), reason, signer)
