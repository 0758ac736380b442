"""Reads `octet.dbc` and `robot.toml`, and checks that they fit together."""

import hashlib
import itertools
from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import cantools
from cantools.database.can import Database, Message
from cantools.database.can.signal import Signal

from host_sim.base.toml_file import parse_toml
from tools.robot_words.description import Description, DescriptionError, Member, Parameter

_BYTE_MAX = 255
_UNITS_PER_MM = {"0.1 mm": 10, "mm": 1}
_SUFFIXES = {"mm": "_mm", "mm/s": "_mm_s"}
_UNSAID = ("crc", "counter")
_BODY = "body_"
_OWN = "own"


def read(dbc: Path, words: Path) -> Description:
    """Reads and checks both files.

    Raises:
        DescriptionError: They do not fit together.
    """
    try:
        return _describe(_load(dbc), parse_toml(words.read_text(encoding="utf-8")))
    except DescriptionError:
        raise
    except (OSError, LookupError, TypeError, AttributeError, ValueError) as error:
        raise DescriptionError(_one_line("invalid", error)) from error


def _one_line(what: str, error: Exception) -> str:
    return " ".join(f"{what}: {error!r}".split())


def _load(dbc: Path) -> Database:
    try:
        database = cantools.database.load_file(dbc)
    except cantools.Error as error:
        raise DescriptionError(_one_line("not a valid DBC file", error)) from error
    if not isinstance(database, Database):
        raise DescriptionError("not a database of CAN messages")
    return database


def _describe(database: Database, words: Mapping[str, Any]) -> Description:
    for message in database.messages:
        _check_message(message)
    _check_nodes(words["numbers"]["node_max"], database)
    signal = partial(_signal, database)
    enums = {
        "reason": _choices(signal("DRIVE.reason")),
        "opcode": _same_choices(signal("COMMAND.opcode"), signal("ANSWER.opcode")),
        "result": _choices(signal("ANSWER.result")),
        "fault": _choices(signal("EMERGENCY.first")),
        "side": {name: number for number, name in enumerate(words["sides"])},
        "memory_kind": {kind: number for number, kind in enumerate(words["memory_kind"])},
        "edit_kind": {name: number for number, name in enumerate(words["edits"])},
        "body_fault": {name: number for number, name in enumerate(words["body_faults"])},
    }
    profiles = _listed(_same_choices(signal("COMMAND.profile"), signal("HEARTBEAT.profile")), "profile")
    if profiles[-1] != _OWN:
        raise DescriptionError(f"the last profile is {profiles[-1]}, not {_OWN}, which is for a user's behaviour")
    meanings = {name: words.get(name, {}) for name in enums}
    _check_meanings(enums, meanings)
    hashed = layout_hash(database)
    parameters = _parameters(database, _choices(signal("COMMAND.parameter")))
    senses, drive = (_members(database.get_message_by_name(name)) for name in ("SENSES", "DRIVE"))
    return Description(
        messages=sorted(database.messages, key=lambda message: message.frame_id),
        enums=enums,
        avoiding={name: enums["reason"][name] for name in words["avoiding"]},
        meanings=meanings,
        parameters=[parameter for parameter in parameters if not parameter.name.startswith(_BODY)],
        body_parameters=[parameter for parameter in parameters if parameter.name.startswith(_BODY)],
        profiles=profiles,
        memory=_memory(words["memory"], profiles, enums["memory_kind"]),
        patterns=_patterns(words["patterns"]),
        feel=_feel(words["feel"], signal("SENSES.feel")),
        edits=words["edits"],
        senses=senses,
        drive=drive,
        row=_row(senses, drive, words["recorded"]),
        columns=_columns(words["columns"], [*(it.signal for it in (*senses, *drive)), *words["recorded"]]),
        sentences=_sentences(words["sentences"], enums["reason"]),
        kit_settings=words["kit_settings"],
        body_sentences=words["body_sentences"],
        numbers={
            **words["numbers"],
            "cell_count": _cell_count(words["patterns"], database.get_message_by_name("MEMORY")),
            "tick_span": 1 << signal("SENSES.tick").length,
            "action_span": 1 << signal("DRIVE.action").length,
            "odometer_span": 1 << signal("SENSES.odometer_left").length,
            "odometer_counts_per_mm": _counts_per_mm(signal("SENSES.odometer_left"), signal("SENSES.odometer_right")),
        },
        layout_hash=hashed,
        same_layout=[int(text, 16) for text in words.get("same_layout", {}).get(f"{hashed:04X}", [])],
    )


def _signal(database: Database, path: str) -> Signal:
    """The signal of a path such as DRIVE.reason."""
    message, _, name = path.partition(".")
    try:
        return database.get_message_by_name(message).get_signal_by_name(name)
    except KeyError as missing:
        raise DescriptionError(f"there is no {path}") from missing


def _check_message(message: Message) -> None:
    """The codecs support only little-endian integers."""
    for signal in message.signals:
        if signal.byte_order != "little_endian" or (signal.scale, signal.offset, signal.is_float) != (1, 0, False):
            raise DescriptionError(f"{message.name}.{signal.name} is not an unscaled little-endian integer")


def _choices(signal: Signal) -> dict[str, int]:
    return {str(choice): number for number, choice in sorted((signal.choices or {}).items())}


def _same_choices(one: Signal, other: Signal) -> dict[str, int]:
    choices = _choices(one)
    if choices != _choices(other):
        raise DescriptionError(f"the two signals {one.name} have different names: {choices} and {_choices(other)}")
    return choices


def _listed(choices: Mapping[str, int], what: str) -> list[str]:
    if list(choices.values()) != list(range(len(choices))) or not choices:
        raise DescriptionError(f"the numbers of {what} are not 0, 1, 2..: {choices}")
    return list(choices)


def _parameters(database: Database, choices: Mapping[str, int]) -> list[Parameter]:
    variables = {} if database.dbc is None else database.dbc.environment_variables
    parameters = [
        Parameter(
            name=variable.name,
            number=variable.env_id,
            minimum=int(variable.minimum),
            maximum=int(variable.maximum),
            default=int(variable.initial_value),
            unit=variable.unit or "",
            comment=variable.comment or "",
        )
        for variable in sorted(variables.values(), key=lambda variable: variable.env_id)
    ]
    numbers = {parameter.name: parameter.number for parameter in parameters}
    if numbers != choices:
        raise DescriptionError(f"COMMAND.parameter names {dict(choices)}, the EV_ lines {numbers}")
    _listed(numbers, "parameter")
    for parameter in parameters:
        _check_parameter(parameter)
    if sorted(parameters, key=lambda parameter: parameter.name.startswith(_BODY)) != parameters:
        raise DescriptionError(f"parameters of the robot come after those of a body, {_BODY}..")
    return parameters


def _check_parameter(parameter: Parameter) -> None:
    """The robot keeps each in a byte."""
    if not 0 <= parameter.minimum <= parameter.default <= parameter.maximum <= _BYTE_MAX:
        raise DescriptionError(f"{parameter.name}: 0 <= minimum <= default <= maximum <= {_BYTE_MAX} does not hold")
    if not parameter.comment or not parameter.unit:
        raise DescriptionError(f"{parameter.name} has no unit or no comment")


def _check_meanings(enums: Mapping[str, Mapping[str, int]], meanings: Mapping[str, Mapping[str, str]]) -> None:
    for name, words in meanings.items():
        unknown = sorted(set(words) - set(enums[name]))
        if unknown:
            raise DescriptionError(f"[{name}] explains {', '.join(unknown)}, which octet.dbc does not have")


def _memory(kinds: Mapping[str, str], profiles: Sequence[str], known: Mapping[str, int]) -> Mapping[str, str]:
    """The kind of memory of each profile; each kind needs a profile, so that every stored memory has one."""
    if sorted(kinds) != sorted(profiles):
        raise DescriptionError(f"[memory] is of {', '.join(sorted(kinds))}, the profiles are {', '.join(profiles)}")
    if set(kinds.values()) != set(known):
        raise DescriptionError(f"[memory] has {', '.join(sorted(set(kinds.values())))}, not each of [memory_kind]")
    return kinds


def _patterns(names: Mapping[str, str]) -> list[str]:
    digits = len(next(iter(names)))
    wanted = ["".join(bits) for bits in itertools.product("01", repeat=digits)]
    if sorted(names) != wanted or len(set(names.values())) != len(names):
        raise DescriptionError(f"[patterns] does not name each of {wanted[0]} to {wanted[-1]} once")
    return [names[bits] for bits in wanted]


def _feel(names: Sequence[str], signal: Signal) -> Sequence[str]:
    if len(names) != signal.length:
        raise DescriptionError(f"feel names {len(names)} sensors, and the signal has {signal.length} bits")
    return names


def _members(message: Message) -> list[Member]:
    return [_member(signal) for signal in message.signals if signal.name not in _UNSAID]


def _member(signal: Signal) -> Member:
    unit = signal.unit or ""
    meaning = f"{signal.comment} {signal.minimum}..{signal.maximum} {unit}".strip()
    return Member(signal.name + _SUFFIXES.get(unit, ""), signal.name, signal.length == 1, meaning)


def _row(senses: Sequence[Member], drive: Sequence[Member], recorded: Sequence[str]) -> list[str]:
    """The names in a row; if both messages have a name, drive's gets the prefix drive_."""
    sensed = [member.name for member in senses]
    return [*sensed, *(f"drive_{it.name}" if it.name in sensed else it.name for it in drive), *recorded]


def _columns(names: Sequence[str], known: Sequence[str]) -> Mapping[str, int]:
    if unknown := sorted(set(names) - set(known)):
        raise DescriptionError(f"columns has {', '.join(unknown)}, which no row has")
    return {name: known.index(name) for name in names}


def _sentences(sentences: Mapping[str, str], reasons: Mapping[str, int]) -> Mapping[str, str]:
    if missing := sorted(set(reasons) - set(sentences)):
        raise DescriptionError(f"[sentences] says nothing of {', '.join(missing)}")
    return sentences


def _cell_count(patterns: Mapping[str, str], memory: Message) -> int:
    """A cell for each pattern; the two halves of a MEMORY carry them all."""
    cells = [signal.name for signal in memory.signals if signal.name.startswith("cell_")]
    if sorted(cells) != [f"cell_{cell}" for cell in range(len(patterns))]:
        raise DescriptionError(f"there are {len(patterns)} patterns, and MEMORY has {', '.join(sorted(cells))}")
    return len(cells)


def _check_nodes(node_max: int, database: Database) -> None:
    ids = sorted(message.frame_id for message in database.messages)
    if any(later - earlier < node_max for earlier, later in itertools.pairwise(ids)):
        raise DescriptionError(f"{node_max} nodes do not fit between the identifiers")


def _counts_per_mm(*odometers: Signal) -> int:
    (unit,) = {odometer.unit for odometer in odometers}
    if unit not in _UNITS_PER_MM:
        raise DescriptionError(f"the odometers' unit is {unit!r}; known are {', '.join(_UNITS_PER_MM)}")
    return _UNITS_PER_MM[unit]


def layout_text(database: Database) -> str:
    """The layout of all messages, one line for each message and signal, the same however the file was written."""
    lines: list[str] = []
    for message in sorted(database.messages, key=lambda message: message.frame_id):
        lines.append(f"{message.frame_id} {message.length}")
        lines += sorted(_signal_line(signal) for signal in message.signals)
    return "\n".join(lines) + "\n"


def layout_hash(database: Database) -> int:
    """The first two bytes of the SHA-256 of `layout_text`, the first one in the high half."""
    return int.from_bytes(hashlib.sha256(layout_text(database).encode()).digest()[:2], "big")


def _signal_line(signal: Signal) -> str:
    sign = "-" if signal.is_signed else "+"
    selects = "M" if signal.is_multiplexer else ""
    selected_by = ",".join(str(number) for number in sorted(signal.multiplexer_ids or ()))
    return f" {signal.start:02} {signal.name} {signal.length} {signal.byte_order} {sign} {selects}{selected_by}"
