"""The profile `fixed`: the article's "simple coding solution", a programmed turn for every front pattern."""

from tests.firmware.oracles.listing import TURN_LEFT, TURN_RIGHT, Listing


class Oracle(Listing):
    """It begins with the programmed turns and learns nothing; what a person writes, it does."""

    @staticmethod
    def begin(cells: bytes) -> bytes:
        """Whatever it was: to the right where the left is blocked and the right is not, else to the left."""
        del cells
        turns = (TURN_RIGHT if pattern in (0b100, 0b110) else TURN_LEFT for pattern in range(1, 8))
        return bytes((0, *turns))

    def learn(self, feel: int, side: int) -> None:
        """Nothing."""
