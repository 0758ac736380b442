"""The robot's numbers and words in Python: host_sim/protocol/generated.py."""

from collections.abc import Mapping, Sequence

from cantools.database.can import Message
from cantools.database.can.signal import Signal

from tools.robot_words.description import Description, Member
from tools.robot_words.to_c import c_name

_HEAD = '''\
"""The robot's numbers and words. Made by tools/generate from octet.dbc and robot.toml."""

from enum import IntEnum
from typing import NamedTuple

from host_sim.protocol.words import PARAMETERS as PARAMETERS


class Signal(NamedTuple):
    """A little-endian whole number in a message.

    `multiplexer` holds the selector's values for which it is present; empty if it always is.
    """

    name: str
    start: int
    length: int
    signed: bool
    selector: bool
    multiplexer: tuple[int, ...]
    choices: dict[int, str]


class Message(NamedTuple):
    """A message of node 1; node n adds n - 1 to the identifier.

    `cycle_ms` is the time between two of them; 0 for one that is sent only when something happens.
    """

    name: str
    id: int
    length: int
    sender: str
    cycle_ms: int
    signals: tuple[Signal, ...]

'''


def module(robot: Description) -> str:
    """The text of generated.py."""
    parts = [_HEAD]
    parts += [_enum(name, words) for name, words in robot.enums.items()]
    parts += [f"{name} = {value}\n" for name, value in _constants(robot).items()]
    parts += _exchanged(robot)
    return "".join([*parts, "MESSAGES: dict[str, Message] = {\n", *map(_message, robot.messages), "}\n"])


def _exchanged(robot: Description) -> list[str]:
    """The exchange between body and robot at each tick, and how it is recorded."""
    ranges = [Member(name.replace("-", "_"), name, False, f"Sensor {name}.") for name in robot.feel]
    return [
        _tuple("Senses", "What the body senses at one tick.", robot.senses),
        _tuple("Drive", "The commands to the wheels until the next tick.", robot.drive),
        _tuple("Ranges", "Whole mm from the rim to the nearest thing in each cone; None: out of reach.", ranges),
        f"\n\nNOTHING_SENSED = Senses({_zeros(robot.senses)})\nREST = Drive({_zeros(robot.drive)})\n",
        f"NOTHING_NEAR = Ranges({', '.join('None' for _ in ranges)})\n",
        f"EDITS: dict[str, tuple[str, ...]] = { ({name: tuple(fields) for name, fields in robot.edits.items()})!r}\n",
        f"ROW: tuple[str, ...] = {tuple(robot.row)!r}\n",
        f"COLUMNS: dict[str, int] = {robot.columns!r}\n",
        f"SENTENCES: dict[str, str] = {robot.sentences!r}\n",
        f"BODY_SENTENCES: dict[str, str] = {robot.body_sentences!r}\n",
    ]


def _zeros(members: Sequence[Member]) -> str:
    return ", ".join("False" if member.is_flag else "0" for member in members)


def _tuple(name: str, title: str, members: Sequence[Member]) -> str:
    meanings = "".join(f"        {member.name}: {member.meaning}\n" for member in members)
    kinds = {member.name: "bool" if member.is_flag else "int" for member in members}
    kinds = dict.fromkeys(kinds, "int | None") if name == "Ranges" else kinds
    lines = "".join(f"    {field}: {kind}\n" for field, kind in kinds.items())
    return f'\n\nclass {name}(NamedTuple):\n    """{title}\n\n    Attributes:\n{meanings}    """\n\n{lines}'


def _enum(name: str, words: Mapping[str, int]) -> str:
    lines = "".join(f"    {c_name(word)} = {number}\n" for word, number in words.items())
    title = name.title().replace("_", "")
    return f'\nclass {title}(IntEnum):\n    """Numbers of {name.replace("_", " ")}, as in the C."""\n\n{lines}\n'


def _constants(robot: Description) -> dict[str, str]:
    same = sorted({robot.layout_hash, *robot.same_layout})
    return {
        "\nPROFILES: dict[str, int]": repr({name: number for number, name in enumerate(robot.profiles[:-1])}),
        "OWN_PROFILE": str(len(robot.profiles) - 1),
        "MEMORY_KINDS: dict[str, MemoryKind]": _memory_kinds(robot),
        "AVOIDING: tuple[Reason, ...]": f"({', '.join(f'Reason.{c_name(name)}' for name in robot.avoiding)},)",
        "PATTERNS: tuple[str, ...]": repr(tuple(robot.patterns)),
        "SIDES: tuple[str, ...]": repr(tuple(robot.enums["side"])),
        "FEEL: dict[str, int]": repr({c_name(name): 1 << bit for bit, name in enumerate(robot.feel)}),
        **{c_name(name): str(number) for name, number in robot.numbers.items()},
        "LAYOUT_HASH": f"0x{robot.layout_hash:04X}",
        "SAME_LAYOUT: frozenset[int]": f"frozenset(({', '.join(f'0x{number:04X}' for number in same)},))",
    }


def _memory_kinds(robot: Description) -> str:
    kinds = (f"{name!r}: MemoryKind.{c_name(robot.memory[name])}" for name in robot.profiles)
    return f"{{{', '.join(kinds)}}}"


def _message(message: Message) -> str:
    (sender,) = message.senders
    signals = "".join(map(_signal, sorted(message.signals, key=_place)))
    values = f"{message.name!r}, {message.frame_id}, {message.length}, {sender!r}, {message.cycle_time or 0}"
    return f"    {message.name!r}: Message({values}, (\n{signals}    )),\n"


def _place(signal: Signal) -> tuple[int, list[int]]:
    return signal.start, list(signal.multiplexer_ids or ())


def _signal(signal: Signal) -> str:
    choices = {number: str(name) for number, name in sorted((signal.choices or {}).items())}
    multiplexer = tuple(sorted(signal.multiplexer_ids or ()))
    flags = (signal.is_signed, signal.is_multiplexer, multiplexer, choices)
    values = (signal.name, signal.start, signal.length, *flags)
    return f"        Signal({', '.join(map(repr, values))}),\n"
