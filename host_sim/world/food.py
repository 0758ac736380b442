"""The food in an arena, shared by all its robots."""

from collections.abc import Sequence

from host_sim.world.geometry import Point


class Food:
    """Pieces of food by id: 0, 1, ... as in the layout.

    Attributes:
        at: Position of each piece, eaten or not.
        uneaten: Positions of the pieces that are left, by id.
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
        """Removes a piece.

        Raises:
            KeyError: It was eaten before.
        """
        del self.uneaten[food_id]

    def move(self, food_id: int, at: Point) -> None:
        """Moves a piece; an eaten one stays eaten."""
        self.at[food_id] = at
        if food_id in self.uneaten:
            self.uneaten[food_id] = at
