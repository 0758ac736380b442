"""`run.world.json` beside a run's log: the environments of the run and the changes made by people, by tick.

The log holds the robot's senses, drives and commands; this file holds the world around it. Together they are enough
to reconstruct the whole run.
"""

import json
import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

from host_sim.base.errors import UsageError
from host_sim.base.files import COMPRESSED, read_bytes, write_bytes
from host_sim.protocol.codec import NODE_MAX
from host_sim.sim.world_record import Begun, Edited, Refused, Source, WorldRecord
from host_sim.world.body_kinds import IDEAL, KIT, BodyKind, body_kind, kind_from
from host_sim.world.edits import edit_from, edit_to, whole
from host_sim.world.layouts import World, WrittenLayout
from host_sim.world.names import RANDOM, WORLD_NAMES
from host_sim.world.worlds import content_of, world_from, world_of

_FORMAT = 1
_SIZE_MAX = 16_000_000
_TEXT_MAX = 1000
_AS_BYTES = "surrogateescape"
_OWN_NAME = re.compile(r"[^/\0]+\.(c|bas)")
_FRONT_EXTRA_MAX_MM = 100.0
_SEED_MAX, _TICK_MAX, _NUMBER_MAX = 2**32 - 1, 2**53, 1_000_000


def write_world(record: WorldRecord, path: Path) -> None:
    """Writes a world file atomically.

    Raises:
        OctetError: The file cannot be written.
    """
    write_bytes(path, world_text(record).encode())


def world_text(record: WorldRecord) -> str:
    """The text of a world file."""
    content = {
        "format": _FORMAT,
        "seed": record.seed,
        "of": record.environments,
        "limit_ticks": record.limit_ticks,
        "robots": record.robots,
        "front_extra_mm": record.world.params.front_extra_mm,
        **_world_content(record.world),
        **({"body": dict(record.kind.traits)} if record.kind else {}),
        **({"own": _own_content(record.own)} if record.own else {}),
        "environments": [begun._asdict() for begun in record.begun],
        "edits": [{"tick": tick, **edit_to(edit)} for tick, edit in record.edits],
        **({"refused": [refused._asdict() for refused in record.refused]} if record.refused else {}),
    }
    return json.dumps(content) + "\n"


def world_path(log: Path) -> Path:
    """The path of a log's world file: `run.world.json` beside `run.log` or `run.log.gz`."""
    return log.with_name(log.name.removesuffix(COMPRESSED)).with_suffix(".world.json")


def read_world(path: Path) -> WorldRecord:
    """Reads a world file.

    Raises:
        UsageError: The file cannot be read.
        UsageError: The file is not a world file of this format; the message gives the reason.
    """
    try:
        content = json.loads(read_bytes(path, _SIZE_MAX))
        if not isinstance(content, dict) or content.get("format") != _FORMAT:
            raise ValueError(f'expected an object with "format": {_FORMAT}')
        return _record(content)
    except OSError as error:
        raise UsageError(f"cannot read {path}: {error.strerror}") from None
    except (ValueError, RecursionError) as error:
        raise UsageError(f"{path} is not a world file of this version: {error}") from None


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
        whole(content, "robots", 1, NODE_MAX) if "robots" in content else 1,
        begun,
        edits,
        [_refused(entry) for entry in _objects(content, "refused")] if "refused" in content else [],
        _world(content),
        _kind(content.get("body", IDEAL)),
        _own(content),
    )


def _own_content(own: Source) -> dict[str, str]:
    return {"name": own.name, "sha256": own.sha256, "source": own.text.decode(errors=_AS_BYTES)}


def _own(content: dict[str, Any]) -> Source | None:
    """The behaviour in a file; formerly, a program had neither a name nor a SHA-256."""
    former = {"name": "program.bas", "source": content["program"]} if "program" in content else None
    entry = content.get("own", former)
    if entry is None:
        return None
    name, source = (entry.get(key) if isinstance(entry, dict) else None for key in ("name", "source"))
    if not isinstance(source, str) or not isinstance(name, str) or not _OWN_NAME.fullmatch(name):
        raise ValueError("own must have the name of a .c or .bas file, without folders, and its source as texts")
    own = Source(name, source.encode(errors=_AS_BYTES))
    if entry is not former and entry.get("sha256") != own.sha256:
        raise ValueError("the source of own does not have its sha256")
    return own


def _kind(body: Any) -> BodyKind | None:
    """Properties of the bodies; the laboratory page identifies the kit by name."""
    if body in (IDEAL, KIT):
        return body_kind(body)
    if not isinstance(body, dict):
        raise ValueError(f"body must be {IDEAL}, {KIT} or an object")
    return kind_from(body)


def _refused(entry: dict[str, Any]) -> Refused:
    texts = [entry.get(name) for name in ("what", "why")]
    if not all(isinstance(text, str) and len(text) <= _TEXT_MAX for text in texts):
        raise ValueError(f"what and why must be texts of at most {_TEXT_MAX} characters")
    return Refused(whole(entry, "tick", 0, _TICK_MAX), str(texts[0]), str(texts[1]))


def _world_content(world: World) -> dict[str, Any]:
    """The field with a world's name, or with a written world in full; omitted for the random world."""
    if isinstance(world.draw, WrittenLayout):
        return {"world": {"name": world.name, **content_of(world.draw, world.params)}}
    return {} if world.name == RANDOM else {"world": world.name}


def _world(content: dict[str, Any]) -> World:
    world = content.get("world", RANDOM)
    if isinstance(world, dict):
        made = world_from({key: value for key, value in world.items() if key != "name"}, str(world.get("name")))
    elif world in WORLD_NAMES:
        made = world_of(world)
    else:
        raise ValueError(f"there is no world {world!r}")
    return replace(made, params=replace(made.params, front_extra_mm=_front_extra_mm(content)))


def _front_extra_mm(content: dict[str, Any]) -> float:
    """Extra reach of the front cone, mm; 0 for a file without a value, whose world has five equal cones."""
    extra_mm = content.get("front_extra_mm", 0.0)
    if not isinstance(extra_mm, float) or not 0.0 <= extra_mm <= _FRONT_EXTRA_MAX_MM:
        raise ValueError(f"front_extra_mm must be a decimal number from 0.0 to {_FRONT_EXTRA_MAX_MM}")
    return extra_mm


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
