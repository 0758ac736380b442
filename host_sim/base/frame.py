"""A CAN frame, which everything on a bus shares."""

from typing import NamedTuple


class Frame(NamedTuple):
    """One CAN frame with an 11-bit identifier, and 0..8 bytes of data."""

    id: int
    data: bytes
