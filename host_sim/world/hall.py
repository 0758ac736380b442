"""A hall: arenas side by side without the walls between them, for more robots than fit into one."""

from dataclasses import replace
from math import ceil, sqrt

from host_sim.world.geometry import Bar, Point, Pose
from host_sim.world.layouts import Layout, World
from host_sim.world.params import SimParams

_ROBOTS_EACH = 16
_SEED_SPAN = 2**32


def hall_of(world: World, seed: int, number: int, robots: int) -> tuple[Layout, SimParams]:
    """Lays out a hall with at most sixteen robots in each arena, and its dimensions.

    Each arena is fair by itself: its robots can get to its food.

    >>> from host_sim.world.worlds import world_of
    >>> layout, params = hall_of(world_of("random"), seed=1, number=1, robots=60)
    >>> len(layout.starts), len(layout.food), params.width_mm, params.height_mm
    (60, 12, 8000.0, 6000.0)

    Args:
        world: What the arenas are drawn from.
        seed: Seed of the first arena; each other one has the next number.
        number: Number of the environment.
        robots: Number of robots.

    Raises:
        NoRoomError: An arena has no room for its robots.
    """
    columns = ceil(sqrt(ceil(robots / _ROBOTS_EACH)))
    rows = ceil(robots / _ROBOTS_EACH / columns)
    params = replace(world.params, width_mm=world.params.width_mm * columns, height_mm=world.params.height_mm * rows)
    arenas = []
    for i in range(columns * rows):
        here = robots // (columns * rows) + (i < robots % (columns * rows))
        layout = world.generate((seed + i) % _SEED_SPAN, number, max(1, here))
        arenas.append(
            _moved(layout, i % columns * world.params.width_mm, i // columns * world.params.height_mm, here)
        )
    start, *others = [start for arena in arenas for start in arena[2]]
    bars, food = [bar for arena in arenas for bar in arena[0]], [at for arena in arenas for at in arena[1]]
    return Layout(tuple(bars), tuple(food), start, tuple(others)), params


def _moved(layout: Layout, x_mm: float, y_mm: float, robots: int) -> tuple[list[Bar], list[Point], list[Pose]]:
    """The bars, the food and a number of starts of an arena, in its place in the hall."""

    def there(point: Point) -> Point:
        return point[0] + x_mm, point[1] + y_mm

    starts = [Pose(*there(start[:2]), start.heading_rad) for start in layout.starts[:robots]]
    return [Bar(there(bar.a), there(bar.b)) for bar in layout.bars], [there(at) for at in layout.food], starts
