"""The profile `distance`: the nearer the thing in the way, the bigger the remembered turn."""

from fractions import Fraction

from tests.firmware.oracles.listing import DEG, Listing

REACH_MM = 60
NOTHING_MM = 255


class Oracle(Listing):
    """Deg is 10 + 20 x (1 - d/60), to the nearest whole degree; d in whole mm makes no halves."""

    def remembered_deg(self) -> int:
        """By the nearest thing that the three front sensors see."""
        _, *front, _ = self.robot.ranges_mm()
        nearest_mm = min(REACH_MM if mm == NOTHING_MM else mm for mm in front)
        return round(DEG + 20 * max(1 - Fraction(nearest_mm, REACH_MM), Fraction(0)))
