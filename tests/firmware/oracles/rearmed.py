"""The profile `rearmed`: boredom can strike again."""

from tests.firmware.oracles.listing import Listing


class Oracle(Listing):
    """The about-face ends the count."""

    def begin_about_face(self) -> None:
        """RepeatCount = 0."""
        self.repeat_count = 0
