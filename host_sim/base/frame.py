"""A CAN frame, the one thing that all know who are on a bus."""

from typing import NamedTuple


class Frame(NamedTuple):
    """One CAN frame with an 11-bit identifier, and 0..8 bytes of data."""

    id: int
    data: bytes
