"""The profile `searcher`: as `adaptive`, with another way of looking for food."""

from collections.abc import Iterator

from tests.firmware.oracles.adaptive import Oracle as Adaptive
from tests.firmware.oracles.listing import DIST_MM, REACH_MM, Action


class Oracle(Adaptive):
    """It drives straight on, looks around after a metre without looking, and goes straight to what it sees."""

    STATE = ("used", "unlearned", "since_mm", "misses", "chasing", "ate")

    since_mm = 1000
    misses = 0
    chasing = ate = False

    def go_forward(self) -> Iterator[Action]:
        """The way is clear."""
        robot = self.robot
        if self.ate:
            self.ate = self.chasing = False
            self.since_mm, self.misses = 1000, 0
        if robot.look():
            self.since_mm = 0
            self.chasing = True
        elif self.chasing:
            self.chasing = False
            self.since_mm = 1000 - 200 * 2**self.misses
            self.misses = min(2, self.misses + 1)
        if not robot.look() and self.since_mm >= 1000:
            self.since_mm = 0
            to_the_right = robot.random(2)
            degrees = 360 + robot.random(180)
            yield Action("LOOK_AROUND", degrees if to_the_right else -degrees, until_food=True)
            return
        yield Action("TOWARD_FOOD" if robot.look() else "WANDER", forward_mm=DIST_MM)
        self.since_mm += DIST_MM
        if robot.look():
            self.since_mm = 0
            if robot.beacon_mm() < REACH_MM:
                self.ate = True
                yield Action("EAT")
