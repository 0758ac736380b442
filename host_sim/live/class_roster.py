"""Who is in a class, and what each has reached in the lessons; kept in a file."""

import json
import re
import time
import unicodedata
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from host_sim.base.errors import OctetError, UsageError
from host_sim.base.files import csv_text, read_text, write_bytes
from host_sim.protocol.generated import CELL_COUNT, Side
from host_sim.talk.languages import languages

NAME_MAX, PUPILS_MAX, LINK_MAX = 20, 100, 4000
"""Maximum lengths of a name and of a link, characters, and maximum number of pupils."""

_FILE_MAX = PUPILS_MAX * (LINK_MAX + 2000)
_KEY = re.compile(r"[0-9a-f]{32}")
_LINK = re.compile(r"(#[ -~]*)?")
_DIGITS = "0123456789ABCDEFGHJKMNPQRSTVWXYZ"
"""Digits of a code, which are hard to confuse: those of Crockford's base 32."""

_DIGIT_BITS, _CHECK_BITS = 5, 10
_FORMULA = ("=", "+", "-", "@")
"""A spreadsheet takes a text that begins with one of these for a formula."""

_FNV_START, _FNV_PRIME = 0x811C9DC5, 0x01000193


class RosterError(OctetError):
    """What a page or a teacher sent is refused."""


def lesson_goals() -> dict[str, int]:
    """The number of goals of each lesson, in the lessons' order."""
    lessons = languages()["en"]["lessons"]["lessons"]
    return {name: len(lesson["goals"]) for name, lesson in lessons.items()}


@dataclass
class Pupil:
    """A pupil, as the page last reported.

    Attributes:
        name: Printable text, at most `NAME_MAX` characters.
        lesson: The lesson that is open; empty if none was reported.
        step: The step of it that is open, from 0.
        goals: The goals reached, by lesson; once reached, a goal stays.
        memory: The cells of the robot shown; empty if none was reported.
        link: The part of the page's address behind #, which holds the run shown.
        heard_s: When the page last reported, s since 1970; 0 for goals that came as a code.
    """

    name: str
    lesson: str = ""
    step: int = 0
    goals: dict[str, list[int]] = field(default_factory=dict)
    memory: list[int] = field(default_factory=list)
    link: str = ""
    heard_s: float = 0.0


class Roster:
    """The pupils of a class, by the key that a page keeps.

    Attributes:
        pupils: The pupils, by key, in the order in which they came.
        changed: Whether there is something that `save` has not written.
    """

    def __init__(self, path: Path) -> None:
        """Reads the class from its file, if there is one.

        Raises:
            UsageError: The file cannot be read, or is not one of a class.
        """
        self._path = path
        self._goals = lesson_goals()
        self.pupils: dict[str, Pupil] = {}
        self.changed = False
        try:
            read = json.loads(read_text(path, _FILE_MAX))
            for key, each in read["pupils"].items():
                self.report({**each, "key": key})
                self.pupils[key].heard_s = float(each["heard_s"])
        except FileNotFoundError:
            return
        except (ValueError, KeyError, TypeError, AttributeError, RosterError):
            raise UsageError(f"{path} is not the file of a class: name another one") from None
        self.changed = False

    def save(self) -> None:
        """Writes the class to its file.

        Raises:
            OctetError: The file cannot be written.
        """
        content = {"format": 1, "pupils": {key: asdict(pupil) for key, pupil in self.pupils.items()}}
        write_bytes(self._path, f"{json.dumps(content, indent=1)}\n".encode())
        self.changed = False

    def report(self, said: Mapping[str, Any]) -> None:
        """Notes what a page says about its pupil: `key`, 32 hexadecimal digits, and the attributes of `Pupil`.

        Raises:
            RosterError: It is not such a report, or the class is full.
        """
        key, name, goals = said.get("key"), said.get("name"), said.get("goals")
        if not isinstance(key, str) or not _KEY.fullmatch(key) or not isinstance(name, str):
            raise RosterError("a report needs a key of 32 hexadecimal digits and a name")
        lesson, step = said.get("lesson", ""), said.get("step", 0)
        if lesson not in ("", *self._goals) or type(step) is not int or not 0 <= step <= PUPILS_MAX:
            raise RosterError("there is no such lesson or step")
        memory, link = _memory_in(said.get("memory")), _link_in(said.get("link"))
        self._note(key, name, self._checked(goals))
        pupil = self.pupils[key]
        pupil.lesson, pupil.step, pupil.heard_s = lesson, step, time.time()
        pupil.memory, pupil.link = memory, link

    def take_code(self, name: str, code: str) -> None:
        """Notes the goals in the code that the page shows to a pupil of this name.

        Raises:
            RosterError: It is no such code, or the class is full.
        """
        digits = [_DIGITS.find(digit) for digit in code.upper().replace("-", "").replace(" ", "")]
        bits = "".join(f"{digit:0{_DIGIT_BITS}b}" for digit in digits if digit >= 0)
        count = sum(self._goals.values())
        if -1 in digits or len(digits) != -(-(count + _CHECK_BITS) // _DIGIT_BITS):
            raise RosterError("that is not a code of this version's lessons")
        name, flags = name_from(name), bits[:count]
        goals, at = {}, 0
        for lesson, number in self._goals.items():
            goals[lesson] = [place for place in range(number) if flags[at + place] == "1"]
            at += number
        if _PLAIN.sub("", code.upper()) != _PLAIN.sub("", code_of(name, goals)):
            raise RosterError("code and name do not fit: type both as the page shows them")
        self._note(f"{_hash(name.lower()):032x}", name, goals)

    def remove(self, key: str) -> None:
        """Forgets a pupil."""
        self.changed |= self.pupils.pop(key, None) is not None

    def table(self) -> str:
        """The class as CSV: a row for each pupil, a column for each goal; 1 where it is reached."""
        places = [(lesson, place) for lesson, number in self._goals.items() for place in range(number)]
        rows: list[list[object]] = [["name", "goals", *(f"{lesson} {place + 1}" for lesson, place in places)]]
        for pupil in self.pupils.values():
            reached = [int(place in pupil.goals.get(lesson, [])) for lesson, place in places]
            name = f"'{pupil.name}" if pupil.name.startswith(_FORMULA) else pupil.name
            rows.append([name, sum(reached), *reached])
        return csv_text(rows)

    def _note(self, key: str, name: str, goals: Mapping[str, list[int]]) -> None:
        if key not in self.pupils and len(self.pupils) >= PUPILS_MAX:
            raise RosterError(f"the class is full: it has {PUPILS_MAX} pupils")
        pupil = self.pupils.setdefault(key, Pupil(""))
        pupil.name = name_from(name)
        for lesson, reached in goals.items():
            pupil.goals[lesson] = sorted({*pupil.goals.get(lesson, []), *reached})
        self.changed = True

    def _checked(self, goals: object) -> dict[str, list[int]]:
        """The goals in a report.

        Raises:
            RosterError: There are no such goals.
        """
        if not isinstance(goals, dict):
            raise RosterError("goals must be lists by lesson")
        for lesson, reached in goals.items():
            is_list = lesson in self._goals and isinstance(reached, list)
            if not is_list or not all(type(goal) is int and 0 <= goal < self._goals[lesson] for goal in reached):
                raise RosterError("there is no such goal")
        return goals


def name_from(text: str) -> str:
    r"""A pupil's name: printable characters, single spaces, at most `NAME_MAX` long.

    >>> name_from("  Ada \x1b[1m  L.\n")
    'Ada [1m L.'
    """
    known = unicodedata.normalize("NFC", text[: 4 * NAME_MAX])
    printable = "".join(sign if sign.isprintable() else " " for sign in known)
    return " ".join(printable.split())[:NAME_MAX].rstrip()


_PLAIN = re.compile(r"[- ]")


def code_of(name: str, goals: Mapping[str, list[int]]) -> str:
    """The code of the goals that a pupil has reached; web/lab/classroom.ts computes the same.

    A bit for each goal, then ten bits of a hash of these and of the name, as digits in groups of three.
    """
    counts = lesson_goals()
    flags = "".join(str(int(i in goals.get(lesson, []))) for lesson, number in counts.items() for i in range(number))
    check = _hash(f"{flags} {name.lower()}") % (1 << _CHECK_BITS)
    bits = f"{flags}{check:0{_CHECK_BITS}b}"
    bits += "0" * (-len(bits) % _DIGIT_BITS)
    digits = "".join(_DIGITS[int(bits[i : i + _DIGIT_BITS], 2)] for i in range(0, len(bits), _DIGIT_BITS))
    return "-".join(digits[i : i + 3] for i in range(0, len(digits), 3))


def _hash(text: str) -> int:
    """FNV-1a of a text in UTF-8, 32 bits."""
    value = _FNV_START
    for byte in text.encode():
        value = (value ^ byte) * _FNV_PRIME & 0xFFFFFFFF
    return value


def _memory_in(cells: object) -> list[int]:
    if isinstance(cells, list) and len(cells) in (0, CELL_COUNT) and all(it in list(Side) for it in cells):
        return cells
    raise RosterError("a memory has eight cells")


def _link_in(link: object) -> str:
    if not isinstance(link, str) or len(link) > LINK_MAX or not _LINK.fullmatch(link):
        raise RosterError("the link is too long or malformed")
    return link
