"""The record of a run: the environments, the changes made by people, by tick, and the results."""

import hashlib
from dataclasses import dataclass, field
from typing import NamedTuple

from host_sim.protocol.generated import CELL_COUNT
from host_sim.world.body_kinds import BodyKind
from host_sim.world.edits import Edit
from host_sim.world.layouts import World
from host_sim.world.names import RANDOM
from host_sim.world.worlds import world_of

_SHOWN = 12


@dataclass
class RobotResult:
    """The result of one robot in one environment.

    Attributes:
        node: Its node number on the bus.
        begun: Number of actions begun, by reason.
        food_eaten: Number of pieces of food that it ate.
        collisions: Number of collisions: times that its body began to touch something.
        stuck_sensors: Number of proximity sensors that are stuck at the end.
        memory: The eight cells at the end.
    """

    node: int
    begun: dict[int, int] = field(default_factory=dict)
    food_eaten: int = 0
    collisions: int = 0
    stuck_sensors: int = 0
    memory: tuple[int, ...] = (0,) * CELL_COUNT


@dataclass
class EpisodeResult:
    """The result of one environment.

    Attributes:
        tick_s: Length of a tick, s.
        robots: The result of each robot.
        ticks: Number of ticks.
        eaten: For each piece of food, whether it was eaten.
    """

    tick_s: float
    robots: list[RobotResult]
    ticks: int = 0
    eaten: list[bool] = field(default_factory=list)

    @property
    def finished(self) -> bool:
        """Whether all the food was eaten."""
        return bool(self.eaten) and all(self.eaten)

    @property
    def robot_s(self) -> float:
        """Robot time spent here, s."""
        return round(self.ticks * self.tick_s, 3)

    def begun(self, reason: int) -> int:
        """The number of actions that all robots began for a reason."""
        return sum(robot.begun.get(reason, 0) for robot in self.robots)


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


class Source(NamedTuple):
    """A behaviour in a file of its user, C or a program: the name of the file, without folders, and its text."""

    name: str
    text: bytes

    @property
    def sha256(self) -> str:
        """SHA-256 of the text, in hexadecimal."""
        return hashlib.sha256(self.text).hexdigest()

    def __str__(self) -> str:
        return f"{self.name} (SHA-256 {self.sha256[:_SHOWN]})"


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
        own: The user's behaviour of the robots; None for the firmware's own.
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
    own: Source | None = None
    happened: list[str] = field(default_factory=list, compare=False)

    @property
    def title(self) -> str:
        """The run's title."""
        parts = [f"seed {self.seed}", *[self.world.name] * (self.world.name != RANDOM)]
        return ", ".join([*parts, *[str(self.own)] * (self.own is not None)])

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
