"""The profile `forgetful`: bored, it forgets what it has used since the way was last clear."""

from tests.firmware.oracles.listing import Listing, pattern


class Oracle(Listing):
    """As the listing, but boredom can strike again, and what led to it is forgotten."""

    STATE = ("used", "unlearned")

    used = 0
    """Bit p for cell p."""

    unlearned = 0
    """The same for those that boredom has emptied."""

    def learn(self, feel: int, side: int) -> None:
        """A lesson counts as used."""
        super().learn(feel, side)
        self.used |= 1 << pattern(feel)

    def find_way_clear(self) -> None:
        """It led to something."""
        self.used = 0

    def begin_remembered(self, feel: int) -> None:
        """The cell is used."""
        self.used |= 1 << pattern(feel)

    def begin_about_face(self) -> None:
        """It led to nothing."""
        self.repeat_count = 0
        for cell in range(1, 8):
            if self.used >> cell & 1 and not self.frozen:
                self.unlearned |= (self.mem[cell] != 0) << cell
                self.mem[cell] = 0
        self.used = 0
