"""The positions of a message's signals in its frame."""

from collections.abc import Mapping
from typing import NamedTuple

from host_sim.protocol.generated import Message, Signal

UNSAID = ("crc", "counter")
"""The signals that protect a message: they are not part of what it says."""


class _Field(NamedTuple):
    """A signal's position; `sign` is its sign bit, 0 for an unsigned signal."""

    name: str
    start: int
    mask: int
    sign: int


def _field(signal: Signal) -> _Field:
    sign = 1 << (signal.length - 1) if signal.signed else 0
    return _Field(signal.name, signal.start, (1 << signal.length) - 1, sign)


class MessageLayout:
    """Packs and unpacks one message, all signals that are in a frame together."""

    def __init__(self, message: Message) -> None:
        """Determines the signals present for each value of the message's selector, if it has one."""
        self._message = message
        self._common = tuple(_field(signal) for signal in message.signals if not signal.multiplexer)
        self._selector = next((_field(signal) for signal in message.signals if signal.selector), None)
        numbers = {number for signal in message.signals for number in signal.multiplexer}
        self._branches = {
            number: tuple(_field(s) for s in message.signals if not s.multiplexer or number in s.multiplexer)
            for number in numbers
        }

    def pack(self, signals: Mapping[str, int]) -> bytes:
        """The data of a frame.

        Args:
            signals: Raw numbers, by the names of all signals that are there.

        Raises:
            KeyError: One is missing.
            ValueError: One has no room for its number.
        """
        word = 0
        for field in self._fields(0 if self._selector is None else signals[self._selector.name]):
            number = signals[field.name]
            if not -field.sign <= number <= field.mask - field.sign:
                raise ValueError(f"{self._message.name}.{field.name} has no room for {number}")
            word |= (number & field.mask) << field.start
        return word.to_bytes(self._message.length, "little")

    def unpack(self, data: bytes) -> dict[str, int]:
        """The raw numbers in the data of a frame, which has the message's length."""
        word = int.from_bytes(data, "little")
        selected = 0 if self._selector is None else word >> self._selector.start & self._selector.mask
        # Taking the sign bit off and adding it again below zero is what makes a number signed.
        return {name: ((word >> start & mask) ^ sign) - sign for name, start, mask, sign in self._fields(selected)}

    def _fields(self, selected: int) -> tuple[_Field, ...]:
        return self._branches.get(selected, self._common)


def places(message: Message) -> list[tuple[int, int, int]]:
    """Start, mask and sign bit of what `Senses` and `Drive` have of their messages, in the same order."""
    return [_field(signal)[1:] for signal in message.signals if signal.name not in UNSAID]
