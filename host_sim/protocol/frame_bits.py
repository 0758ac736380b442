"""The bits that frames take on a CAN bus, and the most that a robot sends.

A frame with an 11-bit identifier and n bytes of data has 47 + 8 n bits, the gap before the next one included. After
five equal bits in a row, CAN adds a stuff bit; at worst one for every four of the first 34 + 8 n bits.
"""

import re

from host_sim.protocol.codec import Frame
from host_sim.protocol.generated import MESSAGES, Message

OPTIONAL = ("RANGES",)
"""Messages that are only sent to robots that ask for them."""

_STUFFABLE, _FIXED = 34, 13
_RUN = 5
_STUFFED = re.compile("00000(?:11110000)*(?:1111)?|11111(?:00001111)*(?:0000)?")
_CRC_POLYNOMIAL = 0x4599


def worst_bits(length: int) -> int:
    """The most bits that a frame with a number of bytes of data can take."""
    stuffable = _STUFFABLE + 8 * length
    return stuffable + _FIXED + (stuffable - 1) // (_RUN - 1)


def _crc_table() -> tuple[int, ...]:
    table = []
    for byte in range(256):
        crc = byte << 7
        for _ in range(8):
            crc = (crc << 1) ^ (_CRC_POLYNOMIAL if crc & 0x4000 else 0)
        table.append(crc & 0x7FFF)
    return tuple(table)


_CRC_TABLE = _crc_table()


def crc15(data: bytes) -> int:
    """The CRC of CAN 2.0. Leading zero bits do not change it."""
    crc = 0
    for byte in data:
        crc = (crc << 8 & 0x7FFF) ^ _CRC_TABLE[(crc >> 7) ^ byte]
    return crc


def frame_bits(frame: Frame) -> int:
    """The bits that a frame takes on the bus: its own, its stuff bits and the gap before the next one."""
    header = frame.id << 7 | len(frame.data)  # remote, extended and reserved bit are 0
    checked = header.to_bytes(3, "big") + frame.data
    length = _STUFFABLE + 8 * len(frame.data)
    word = int.from_bytes(checked, "big") << 15 | crc15(checked)
    return length + _FIXED + _stuff_bits(f"{word:0{length}b}")


def _stuff_bits(bits: str) -> int:
    """Number of stuff bits: one after five equal bits, which counts as the first of the following run."""
    return sum(1 + (len(run) - _RUN) // (_RUN - 1) for run in _STUFFED.findall(bits))


def frames_a_second(message: Message) -> float:
    """Regular rate of a message, frames per second. A message with pages is sent once per page and cycle."""
    if not message.cycle_ms:
        return 0.0
    pages = {page for signal in message.signals for page in signal.multiplexer}
    return (len(pages) or 1) * 1000 / message.cycle_ms


def robot_bits_a_second(*, optional: bool = False) -> float:
    """The most that one robot and its body send, bits a second.

    Args:
        optional: Whether the messages are sent that a robot must ask for.
    """
    sent = (message for name, message in MESSAGES.items() if optional or name not in OPTIONAL)
    return sum(frames_a_second(message) * worst_bits(message.length) for message in sent)
