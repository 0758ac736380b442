"""`run.world.json`, beside a run's log: which environments the robot was in, and what a person did to them, by tick.

The log has what the robot sensed, did and was told; this has the world that it did so in. Log and world file together
give the whole run again.
"""

import json
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

from host_sim.errors import OctetError, UsageError
from host_sim.kept.whole_file import write_bytes
from host_sim.world.edits import Edit, MoveBar, MoveFood, edit_from, edit_to, whole

_FORMAT = 1
_SEED_MAX, _TICK_MAX, _NUMBER_MAX = 2**32 - 1, 2**53, 1_000_000


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
        begun: The environments in the order in which they began.
        edits: What a person did, in order.
    """

    seed: int
    environments: int
    limit_ticks: int
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

    def write(self, path: Path) -> None:
        """Writes the file, all or nothing.

        Raises:
            OctetError: The disk did not take it.
        """
        content = {
            "format": _FORMAT,
            "seed": self.seed,
            "of": self.environments,
            "limit_ticks": self.limit_ticks,
            "environments": [begun._asdict() for begun in self.begun],
            "edits": [{"tick": tick, **edit_to(edit)} for tick, edit in self.edits],
        }
        write_bytes(path, (json.dumps(content) + "\n").encode())


def _dragged(edited: Edited) -> tuple[int, type, int] | None:
    """When and what is moved by an edit; None for other edits."""
    edit = edited.edit
    return (edited.tick, type(edit), edit.id) if isinstance(edit, (MoveBar, MoveFood)) else None


def world_path(log: Path) -> Path:
    """Where the world file of a log is: `run.world.json` beside `run.log`."""
    return log.with_suffix(".world.json")


def read_world(path: Path) -> WorldRecord:
    """Reads a world file.

    Raises:
        UsageError: The file cannot be read.
        OctetError: It is no world file, or one of another format; says what is wrong.
    """
    try:
        content = json.loads(path.read_bytes())
        if not isinstance(content, dict) or content.get("format") != _FORMAT:
            raise ValueError(f'no object with "format": {_FORMAT}')
        return _record(content)
    except OSError as error:
        raise UsageError(f"cannot read {path}: {error.strerror}") from None
    except (ValueError, RecursionError) as error:
        raise OctetError(f"{path} is no world file of this version: {error}") from None


def _record(content: dict[str, Any]) -> WorldRecord:
    begun = [_begun(entry) for entry in _objects(content, "environments")]
    edits = [_edited(entry) for entry in _objects(content, "edits")]
    for name, ticks in (("environments", [b.first_tick for b in begun]), ("edits", [e.tick for e in edits])):
        if ticks != sorted(ticks):
            raise ValueError(f"{name} are not in the order of their ticks")
    return WorldRecord(
        whole(content, "seed", 0, _SEED_MAX),
        whole(content, "of", 1, _NUMBER_MAX),
        whole(content, "limit_ticks", 1, _TICK_MAX),
        begun,
        edits,
    )


def _objects(content: dict[str, Any], name: str) -> Iterator[dict[str, Any]]:
    entries = content.get(name)
    if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
        raise ValueError(f"{name} must be a list of objects")
    return iter(entries)


def _begun(entry: dict[str, Any]) -> Begun:
    seed, number = whole(entry, "seed", 0, _SEED_MAX), whole(entry, "number", 1, _NUMBER_MAX)
    return Begun(seed, number, whole(entry, "first_tick", 0, _TICK_MAX))


def _edited(entry: dict[str, Any]) -> Edited:
    edit = edit_from(entry)
    if edit is None:
        raise ValueError(f"there is no edit {entry.get('do')!r}")
    return Edited(whole(entry, "tick", 0, _TICK_MAX), edit)
