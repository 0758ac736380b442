"""The profile `adaptive`: as `forgetful`, with confidence."""

from tests.firmware.oracles.forgetful import Oracle as Forgetful
from tests.firmware.oracles.listing import pattern


class Oracle(Forgetful):
    """A cell is its side and four times its confidence, which is 1 to 3; or 0."""

    def recall(self, feel: int) -> int:
        """The side alone."""
        return self.mem[pattern(feel)] % 4

    def learn(self, feel: int, side: int) -> None:
        """A lesson has confidence 1."""
        super().learn(feel, side + 4)

    def find_way_clear(self) -> None:
        """Praise."""
        self.judge(1)

    def begin_about_face(self) -> None:
        """Blame."""
        self.repeat_count = 0
        self.judge(-2)

    def judge(self, change: int) -> None:
        """Changes the confidence of each used cell that has a side."""
        for cell in range(1, 8):
            if self.used >> cell & 1 and not self.frozen and self.mem[cell]:
                confidence, side = divmod(self.mem[cell], 4)
                confidence = min(3, confidence + change)
                self.mem[cell] = side + 4 * confidence if confidence > 0 else 0
                self.unlearned |= (confidence <= 0) << cell
        self.used = 0
