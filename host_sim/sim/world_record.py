"""The environments of a run and the changes made by people, by tick."""

from dataclasses import dataclass, field
from typing import NamedTuple

from host_sim.world.body_kinds import BodyKind
from host_sim.world.edits import Edit
from host_sim.world.layouts import World
from host_sim.world.world_names import RANDOM
from host_sim.world.worlds import world_of


class Begun(NamedTuple):
    """An environment and its first tick, at which the previous one ended, finished or not."""

    seed: int
    number: int
    first_tick: int


class Refused(NamedTuple):
    """A scheduled change that could not be made, with the tick before which it was due."""

    tick: int
    what: str
    why: str


class Edited(NamedTuple):
    """An edit and its tick: it was made before the senses of that tick. Edits of one tick keep their order."""

    tick: int
    edit: Edit


@dataclass
class WorldRecord:
    """The contents of `run.world.json`.

    Attributes:
        seed: The run's seed.
        environments: The planned number of environments.
        limit_ticks: Number of ticks after which an environment ends, finished or not.
        robots: Number of robots in each environment.
        begun: The environments, in the order in which they began.
        edits: The changes made by people, in order.
        refused: Scheduled changes that could not be made, in order.
        world: The world from which the environments were drawn.
        kind: Properties of the robots' bodies; None: ideal.
        program: The program that is each robot's brain; None for the firmware's own.
        happened: Scheduled changes that were made, in order; they are also among the edits.
    """

    seed: int
    environments: int
    limit_ticks: int
    robots: int = 1
    begun: list[Begun] = field(default_factory=list)
    edits: list[Edited] = field(default_factory=list)
    refused: list[Refused] = field(default_factory=list)
    world: World = field(default_factory=lambda: world_of(RANDOM))
    kind: BodyKind | None = None
    program: bytes | None = None
    happened: list[str] = field(default_factory=list, compare=False)

    @property
    def title(self) -> str:
        """The run's title."""
        return f"seed {self.seed}" + ("" if self.world.name == RANDOM else f", {self.world.name}")

    @property
    def changes(self) -> int:
        """Number of scheduled changes that were due."""
        return len(self.happened) + len(self.refused)

    @property
    def edits_tried(self) -> int:
        """Number of changes of the world that were attempted, made or not."""
        return len(self.edits) + len(self.refused)

    def begin(self, begun: Begun) -> None:
        """Adds an environment. Edits after the last tick of the previous one are dropped: no robot sensed them.

        Faults of bodies persist, unless the run is started over.
        """
        last: list[Edited] = []
        while self.edits and self.edits[-1].tick == begun.first_tick:
            last.insert(0, self.edits.pop())
        self.edits += [it for it in last if it.edit.do == "body" and begun.number > 1]
        self.begun.append(begun)

    def add(self, edited: Edited) -> None:
        """Adds an edit. When a thing is dragged between two ticks, only its last position is recorded."""
        if self.edits and _dragged(self.edits[-1]) == _dragged(edited) is not None:
            self.edits.pop()
        self.edits.append(edited)


def _dragged(edited: Edited) -> tuple[int, str, int] | None:
    """The tick of an edit that moves a thing, and which thing; None for other edits."""
    edit = edited.edit
    return (edited.tick, edit.do, edit.id) if edit.do in ("move_bar", "move_food") else None
