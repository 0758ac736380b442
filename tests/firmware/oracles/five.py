"""The profile `five`: a turn for each reading of all five sensors."""

from tests.firmware.oracles.listing import Listing


class Oracle(Listing):
    """Reading n has two bits, from bit 2n on, the eight bytes taken as one little-endian number.

    The four bits of readings 0 and 1, in which nothing is in the way, are set as soon as something was learned.
    """

    def begin_about_face(self) -> None:
        """Boredom can strike again."""
        self.repeat_count = 0

    def recall(self, feel: int) -> int:
        """The two bits of a reading."""
        return int.from_bytes(bytes(self.mem), "little") >> 2 * feel & 3

    def learn(self, feel: int, side: int) -> None:
        """Changes the two bits of a reading."""
        number = int.from_bytes(bytes(self.mem), "little") & ~(3 << 2 * feel) | side << 2 * feel | 0b1111
        self.mem[:] = number.to_bytes(8, "little")
