"""Which environments a robot was in, and what a person did to them, by tick."""

from dataclasses import dataclass, field
from typing import NamedTuple

from host_sim.world.edits import Edit, MoveBar, MoveFood


class Begun(NamedTuple):
    """An environment, with the first tick in it. The one before it ended there, finished or not."""

    seed: int
    number: int
    first_tick: int


class Edited(NamedTuple):
    """An edit, with the tick before whose senses it was made. Edits of one tick are in their order."""

    tick: int
    edit: Edit


@dataclass
class WorldRecord:
    """What `run.world.json` holds.

    Attributes:
        seed: Of the run.
        environments: How many the run was to have.
        limit_ticks: Ticks after which an environment ends, finished or not.
        robots: How many are in each environment.
        begun: The environments in the order in which they began.
        edits: What a person did, in order.
    """

    seed: int
    environments: int
    limit_ticks: int
    robots: int = 1
    begun: list[Begun] = field(default_factory=list)
    edits: list[Edited] = field(default_factory=list)

    def begin(self, begun: Begun) -> None:
        """Adds an environment. An edit after the last tick of the one before is forgotten: no robot sensed it."""
        while self.edits and self.edits[-1].tick == begun.first_tick:
            self.edits.pop()
        self.begun.append(begun)

    def add(self, edited: Edited) -> None:
        """Adds an edit. Dragging a thing about between two ticks leaves only where it came to lie."""
        if self.edits and _dragged(self.edits[-1]) == _dragged(edited) is not None:
            self.edits.pop()
        self.edits.append(edited)


def _dragged(edited: Edited) -> tuple[int, type, int] | None:
    """When and what is moved by an edit; None for other edits."""
    edit = edited.edit
    return (edited.tick, type(edit), edit.id) if isinstance(edit, (MoveBar, MoveFood)) else None
