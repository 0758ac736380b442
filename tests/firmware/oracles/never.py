"""The profile `never`: each blockage is a trial."""

from collections.abc import Iterator

from tests.firmware.oracles.listing import TURN_LEFT, Action, Listing


class Oracle(Listing):
    """It has a memory and makes no use of it."""

    def recall(self, feel: int) -> int:
        """Nothing."""
        del feel
        return 0

    def try_a_turn(self, senses: int) -> Iterator[Action]:
        """The tenth trial in a row is a turn of 150 degrees."""
        if self.repeat_count + 1 < 10:
            self.repeat_count += 1
            yield from super().try_a_turn(senses)
            return
        self.repeat_count = 0
        yield Action("BOREDOM", -150 if self.robot.random(2) + 1 == TURN_LEFT else 150)

    def learn(self, feel: int, side: int) -> None:
        """Nothing."""
