"""CAN frames as a wire carries them."""

from typing import NamedTuple

_STANDARD_BITS, _EXTENDED_BITS = 47, 67
_STANDARD_SHIFT = 18


class CanFrame(NamedTuple):
    """One frame of any kind.

    Attributes:
        id: 11 bits, or 29.
        data: 0..8 bytes; of a remote frame, its length is what counts.
        extended: The identifier has 29 bits.
        remote: It asks for data and has none.
    """

    id: int
    data: bytes = b""
    extended: bool = False
    remote: bool = False

    @property
    def bits(self) -> int:
        """Length on the wire with the pause after it, without stuff bits."""
        fixed = _EXTENDED_BITS if self.extended else _STANDARD_BITS
        return fixed + (0 if self.remote else 8 * len(self.data))

    @property
    def rank(self) -> tuple[int, bool, int, bool]:
        """Order in which frames win the bus: the lowest does."""
        base = self.id >> _STANDARD_SHIFT if self.extended else self.id
        return base, self.extended, self.id if self.extended else 0, self.remote


def disregard(_frame: CanFrame) -> None:
    """Does nothing with a frame."""
