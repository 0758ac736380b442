"""The robot's numbers and words in C: robot_words.h."""

import json
from collections.abc import Iterable, Mapping, Sequence

from tools.robot_words.description import Description, Parameter

_HEAD = """\
/* robot_words.h: the robot's numbers and words. Made by tools/generate from octet.dbc and robot.toml. */
#ifndef OCTET_ROBOT_WORDS_H
#define OCTET_ROBOT_WORDS_H
"""


def header(robot: Description) -> str:
    """The text of robot_words.h."""
    parts = [_HEAD, _numbers(robot)]
    parts += [_enum(name, words, robot.meanings[name]) for name, words in robot.enums.items()]
    parts += [f"enum {{ MEMORY_KIND_COUNT = {len(robot.enums['memory_kind'])} }};\n"]
    parts += [_names("FEEL_NAMES", robot.feel), _names("BODY_FAULT_NAMES", robot.enums["body_fault"])]
    parts += [_parameters("ROBOT", robot.parameters, "PARAMETER_COUNT")]
    parts += [_parameters("BODY", robot.body_parameters, "BODY_PARAMETER_END")]
    parts += [_profiles(robot), _row(robot), "#endif\n"]
    return "\n".join(parts)


def c_name(*words: str) -> str:
    """A constant's name: REASON_LOOK_AROUND from "reason", "look_around"."""
    return "_".join(words).upper().replace("-", "_")


def _numbers(robot: Description) -> str:
    numbers = {
        **{c_name(name): number for name, number in robot.numbers.items()},
        "AVOIDING_REASONS": sum(1 << number for number in robot.avoiding.values()),
        "FAULT_COUNT": len(robot.enums["fault"]),
        "FEEL_COUNT": len(robot.feel),
        "LAYOUT_HASH": f"0x{robot.layout_hash:04X}",
        **{c_name("feel", name): 1 << bit for bit, name in enumerate(robot.feel)},
    }
    lines = ",\n".join(f"    {name} = {number}" for name, number in numbers.items())
    return f"enum {{\n{lines}\n}};\n"


def _names(name: str, words: Iterable[str]) -> str:
    """A macro that initialises an array of texts."""
    return f"#define {name} {{{', '.join(json.dumps(word) for word in words)}}}\n"


def _enum(name: str, words: Mapping[str, int], meanings: Mapping[str, str]) -> str:
    lines = [
        f"    {c_name(name, word)} = {number}," + (f"   /* {meanings[word]} */" if word in meanings else "")
        for word, number in words.items()
    ]
    return f"enum {name} {{\n" + "\n".join(lines) + "\n};\n"


def _parameters(whose: str, parameters: Sequence[Parameter], end: str) -> str:
    names = "\n".join(
        f"    {c_name(p.name)} = {p.number},   /* {p.unit}, {p.minimum}..{p.maximum}. {p.comment} */"
        for p in parameters
    )
    rows = " \\\n".join(f"    X({c_name(p.name)}, {p.minimum}, {p.maximum}, {p.default})" for p in parameters)
    return (
        f"enum {'body_' if whose == 'BODY' else ''}parameter {{\n{names}\n    {end}\n}};\n\n"
        f"/* X(parameter, minimum, maximum, default) for each. */\n#define {whose}_PARAMETERS(X) \\\n{rows}\n"
    )


def _profiles(robot: Description) -> str:
    *every, own = robot.profiles
    names = "\n".join(f"    {c_name('profile', name)}," for name in every)
    rows = " \\\n".join(
        f"    X({c_name('profile', name)}, {name}, {c_name('memory_kind', robot.memory[name])})"
        for name in robot.profiles
    )
    return (
        f"enum profile {{\n{names}\n    PROFILE_COUNT,   /* of those in each robot */\n"
        f"    {c_name('profile', own)} = PROFILE_COUNT\n}};\n\n"
        "/* X(profile, name, memory_kind) for each: the behaviour of that name. */\n"
        f"#define ROBOT_BEHAVIOURS(X) \\\n{rows}\n"
    )


def _row(robot: Description) -> str:
    """The recorded row of a tick: its indexes, and the members of `struct senses` and `struct drive` in it."""
    places = "".join(f"    {c_name('row', name)},\n" for name in robot.row)
    lists = [
        f"#define {name}(X) {' '.join(f'X({it.name}, {it.signal})' for it in members)}\n"
        for name, members in (("ROBOT_SENSED", robot.senses), ("ROBOT_DRIVEN", robot.drive))
    ]
    return (
        f"/* A tick as a row of numbers. */\nenum {{\n{places}    ROW_COUNT\n}};\n\n"
        "/* X(member, signal) for each that SENSES has of struct senses, and DRIVE of struct drive, as in a row. */\n"
        f"{''.join(lists)}"
    )
