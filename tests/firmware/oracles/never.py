"""The profile `never`: each blockage is a trial."""

from tests.firmware.oracles.listing import Listing


class Oracle(Listing):
    """It has a memory and makes no use of it."""

    def recall(self, feel: int) -> int:
        """Nothing."""
        del feel
        return 0

    def learn(self, feel: int, side: int) -> None:
        """Nothing."""
