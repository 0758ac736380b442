"""The profile `recheck`: the article's challenge, word for word."""

from tests.firmware.oracles.listing import Listing, count_sensors, pattern


class Oracle(Listing):
    """After each remembered turn the cell is erased, unless fewer sensors are triggered than before."""

    def end_remembered(self, feel: int) -> None:
        """Checks what was remembered."""
        if count_sensors(pattern(self.robot.feel())) >= count_sensors(pattern(feel)) and not self.frozen:
            self.mem[pattern(feel)] = 0
