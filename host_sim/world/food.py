"""The food in an arena, which all of its robots share."""

from collections.abc import Sequence

from host_sim.world.geometry import Point


class Food:
    """Pieces of food by their ids: 0, 1, ... as in the layout.

    Attributes:
        at: Where each piece is, or was before it was eaten.
        uneaten: The pieces that are left, by their ids.
    """

    def __init__(self, at: Sequence[Point]) -> None:
        """Lays out the pieces."""
        self.at = list(at)
        self.uneaten = dict(enumerate(self.at))

    @property
    def eaten(self) -> list[bool]:
        """For each piece, whether it has been eaten."""
        return [food_id not in self.uneaten for food_id in range(len(self.at))]

    def eat(self, food_id: int) -> None:
        """Takes a piece away."""
        del self.uneaten[food_id]

    def move(self, food_id: int, at: Point) -> None:
        """Lays a piece elsewhere; one that was eaten stays eaten."""
        self.at[food_id] = at
        if food_id in self.uneaten:
            self.uneaten[food_id] = at
