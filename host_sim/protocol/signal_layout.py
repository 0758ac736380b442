"""Where a message's signals lie in its frame: for the two messages that go to and fro at every tick."""

from collections.abc import Iterable, Sequence

from cantools.database.can import Message


class Layout:
    """Packs and unpacks some signals of one message, in an order of one's own."""

    def __init__(self, message: Message, names: Sequence[str]) -> None:
        """Looks up the signals.

        Args:
            message: All its signals are little-endian whole numbers, with factor 1 and offset 0.
            names: The signals, in the order of the values.
        """
        signals = [message.get_signal_by_name(name) for name in names]
        self._starts = [signal.start for signal in signals]
        self._fields = [
            (signal.start, (1 << signal.length) - 1, 1 << (signal.length - 1) if signal.is_signed else 0)
            for signal in signals
        ]

    def pack(self, values: Iterable[int]) -> int:
        """The frame's data as one little-endian number; each value must be unsigned and fit its signal."""
        word = 0
        for value, start in zip(values, self._starts, strict=True):
            word |= value << start
        return word

    def unpack(self, word: int) -> list[int]:
        """The values in a frame's data, given as one little-endian number."""
        # Taking the sign bit off and adding it again below zero is what makes a number signed.
        return [((word >> start & mask) ^ sign) - sign for start, mask, sign in self._fields]
