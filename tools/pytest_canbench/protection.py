"""Profiles of the CRCs and alive counters of messages, by name."""

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple


def crc(data: bytes, bits: int, polynomial: int, start: int, final: int) -> int:
    """A CRC, most significant bit first; `final` is XORed with the result."""
    value, top = start, 1 << (bits - 1)
    for byte in data:
        value ^= byte << (bits - 8)
        for _ in range(8):
            value = value << 1 ^ ((polynomial | 2 * top) if value & top else 0)
    return value ^ final


def _low_high(number: int) -> bytes:
    return (number & 0xFFFF).to_bytes(2, "little")


class Profile(NamedTuple):
    """A profile that protects messages.

    Attributes:
        crc: The CRC over the data without its own bytes, for the data IDs of a message and a counter.
        bits: Bits of the CRC.
        counters: Number of values of the counter; 0 for all that its signal has room for.
    """

    crc: Callable[[bytes, Sequence[int], int], int]
    bits: int
    counters: int


PROFILES: Mapping[str, Profile | None] = {
    "e2e1": Profile(lambda data, ids, _: crc(_low_high(ids[0]) + data, 8, 0x1D, 0, 0), 8, 15),
    "e2e2": Profile(lambda data, ids, n: crc(data + bytes([ids[n % len(ids)] & 0xFF]), 8, 0x2F, 0xFF, 0xFF), 8, 16),
    "e2e5": Profile(lambda data, ids, _: crc(data + _low_high(ids[0]), 16, 0x1021, 0xFFFF, 0), 16, 256),
    "j1850": Profile(lambda data, _ids, _n: crc(data, 8, 0x1D, 0xFF, 0xFF), 8, 0),
    "none": None,
}
"""AUTOSAR's E2E profiles 1, 2 and 5; SAE J1850's CRC-8 over the data alone; or no CRC."""
