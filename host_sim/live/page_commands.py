"""The commands that a page sends, parsed and validated."""

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from host_sim.protocol.generated import CELL_COUNT, NODE_MAX, Side
from host_sim.talk.conversation import SPEAKERS
from host_sim.world.edits import Edit, edit_from, whole

TEXT_MAX = 4096
"""Maximum length of a command, bytes."""

FULL_SPEED = 0.0
_SPEED_MIN, _SPEED_MAX = 0.25, 1000.0
_SEED_MAX = 2**32 - 1


@dataclass(frozen=True)
class Play:
    """Continue the run, or pause it."""

    on: bool


@dataclass(frozen=True)
class OneDecision:
    """Continue the run until the first robot has decided anew, then pause.

    Each turn is a decision; the steps of wandering, or of the way to food, are one together.
    """


@dataclass(frozen=True)
class Speed:
    """Set the speed as a multiple of real time, 0.25..1000; `FULL_SPEED` is as fast as possible."""

    factor: float


@dataclass(frozen=True)
class NextEnvironment:
    """End this environment and begin the next one."""


@dataclass(frozen=True)
class NewSeed:
    """Start over with the environments and random turns of a seed; the robots learn from nothing unless `keep`."""

    seed: int
    keep: bool = False


@dataclass(frozen=True)
class WriteCell:
    """Write one cell, 1..7, of a robot's memory: side 0 nothing, 1 left, 2 right. No node means the first robot."""

    cell: int
    side: int
    node: int | None = None


@dataclass(frozen=True)
class EraseMemory:
    """Erase all cells of a robot's memory."""

    node: int | None = None


@dataclass(frozen=True)
class Freeze:
    """Stop a robot's learning, or let it learn again."""

    on: bool
    node: int | None = None


@dataclass(frozen=True)
class MoveRobot:
    """Lift a robot off the floor, or put a lifted one down: the edit, and the robot's node."""

    edit: Edit
    node: int | None = None


@dataclass(frozen=True)
class Question:
    """Say something to a speaker of `SPEAKERS`, about a robot; no node means the first robot."""

    who: str
    text: str
    node: int | None = None


RobotCommand = WriteCell | EraseMemory | Freeze | MoveRobot
PageCommand = Play | OneDecision | Speed | NextEnvironment | NewSeed | RobotCommand | Edit
"""The commands that a run carries out."""


def page_command_from(text: str) -> PageCommand | Question:
    """The command in a message.

    Args:
        text: A JSON object with the command's name in `do`, and its fields.

    Raises:
        ValueError: The text is not a command, or a field is missing, of the wrong type, or out of range.
    """
    try:
        fields = json.loads(text)
    except RecursionError:
        raise ValueError("too many brackets") from None
    if not isinstance(fields, dict):
        raise ValueError("not an object")
    parse = _PARSERS.get(str(fields.get("do")))
    command = edit_from(fields) if parse is None else parse(fields)
    if command is None or fields.get("do") == "push_bar":  # only robots push
        raise ValueError("no such command")
    if isinstance(command, Edit) and command.do in {"lift", "put"}:
        return MoveRobot(command, _node(fields))
    return command


def _speed(fields: Mapping[str, Any]) -> Speed:
    factor = fields.get("factor")
    if isinstance(factor, bool) or not isinstance(factor, (int, float)):
        raise ValueError("factor must be a number")
    if factor != FULL_SPEED and not _SPEED_MIN <= factor <= _SPEED_MAX:
        raise ValueError(f"factor must be {FULL_SPEED:g}, or from {_SPEED_MIN:g} to {_SPEED_MAX:g}")
    return Speed(float(factor))


def _question(fields: Mapping[str, Any]) -> Question:
    who, text = fields.get("who"), fields.get("text")
    if not isinstance(who, str) or who not in SPEAKERS or not isinstance(text, str):
        raise ValueError(f"who must be one of {', '.join(SPEAKERS)}, and text a text")
    return Question(who, text, _node(fields))


def _flag(fields: Mapping[str, Any], name: str) -> int:
    """An optional field that holds 0 or 1; 0 if it is missing."""
    return whole(fields, name, 0, 1) if name in fields else 0


def _node(fields: Mapping[str, Any]) -> int | None:
    return whole(fields, "node", 1, NODE_MAX) if "node" in fields else None


_PARSERS: dict[str, Callable[[Mapping[str, Any]], PageCommand | Question]] = {
    "play": lambda _: Play(True),
    "pause": lambda _: Play(False),
    "decision": lambda _: OneDecision(),
    "speed": _speed,
    "next": lambda _: NextEnvironment(),
    "seed": lambda fields: NewSeed(whole(fields, "seed", 0, _SEED_MAX), bool(_flag(fields, "keep"))),
    "write": lambda fields: WriteCell(
        whole(fields, "cell", 1, CELL_COUNT - 1), whole(fields, "side", 0, max(Side)), _node(fields)
    ),
    "erase": lambda fields: EraseMemory(_node(fields)),
    "freeze": lambda fields: Freeze(bool(whole(fields, "on", 0, 1)), _node(fields)),
    "ask": _question,
}
