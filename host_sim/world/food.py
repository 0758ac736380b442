"""The food in an arena, shared by all its robots."""

from host_sim.world.geometry import Point
from host_sim.world.native_world import NativeWorld


class Food:
    """Pieces of food by id: 0, 1, ... as in the layout; a view of those in C."""

    def __init__(self, inside: NativeWorld) -> None:
        """Shows the food of a world."""
        self._inside, self._pieces = inside, inside.food

    @property
    def at(self) -> list[Point]:
        """Position of each piece, eaten or not."""
        return [(piece.x_mm, piece.y_mm) for piece in self._pieces]

    @property
    def eaten(self) -> list[bool]:
        """For each piece, whether it has been eaten."""
        return [piece.eaten for piece in self._pieces]

    @property
    def uneaten(self) -> dict[int, Point]:
        """Positions of the pieces that are left, by id."""
        return {food_id: (piece.x_mm, piece.y_mm) for food_id, piece in enumerate(self._pieces) if not piece.eaten}

    @property
    def left(self) -> int:
        """Number of pieces that are left."""
        return int(self._inside.library.world_food_left(self._inside.world))

    def move(self, food_id: int, at: Point) -> None:
        """Moves a piece; an eaten one stays eaten."""
        self._pieces[food_id].x_mm, self._pieces[food_id].y_mm = at
