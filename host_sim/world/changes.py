"""Scheduled changes of a run, as a person writes them: a new plant, swapped motors."""

import re
from dataclasses import dataclass
from pathlib import Path

from host_sim.base.errors import UsageError, meant
from host_sim.base.files import read_words
from host_sim.protocol.words import BODY_FAULTS
from host_sim.world.body_kinds import check_fault

PLANT, GROW = "plant", "grow"
CHANGE_NAMES = (PLANT, GROW, *BODY_FAULTS)
"""The possible changes."""

_WHEN = r"(?:(?P<from_start>\d{1,6}(?:\.\d{1,3})?)s|env(?P<number>\d{1,4})(?:\+(?P<after>\d{1,6}(?:\.\d{1,3})?)s)?)"
_CHANGE = re.compile(rf"(?P<what>[^@\s]+)@{_WHEN}(?:/(?P<robot>\d{{1,2}}))?")
_FORM = "write NAME@120s, NAME@env6 or NAME@env6+20s, such as plant@120s"
_DETAILS = {
    PLANT: (re.compile(r"(?::(\d{1,4}),(\d{1,4}))?"), "plant, or plant:X,Y for a place in mm"),
    GROW: (re.compile(r"(?::(\d{1,3}))?"), "grow, or grow:MM for so many mm"),
}
_FILE_MAX = 1_000_000


@dataclass(frozen=True)
class Change:
    """A change, and when it is due.

    `NAME[:DETAILS]@WHEN[/ROBOT]`:

    >>> Change.parse("weak-motor:left:60%@env6+20s/2")
    Change(what='weak-motor:left:60%', number=6, after_s=20.0, robot=2)
    >>> str(Change.parse("plant@120s"))
    'plant@120s'

    Attributes:
        what: Name and details of the change.
        number: Number of its environment; None for a time that counts from the start of the run.
        after_s: Robot time since the start of that environment, or of the run, s.
        robot: The robot that it happens to, counted from 1; None for all.
    """

    what: str
    number: int | None = None
    after_s: float = 0.0
    robot: int | None = None

    @staticmethod
    def parse(text: str) -> "Change":
        """Reads a change.

        Raises:
            UsageError: It is not a change; the message says what is expected.
        """
        match = _CHANGE.fullmatch(text)
        if match is None:
            raise UsageError(f"{text!r} is not a change: {_FORM}")
        if problem := _problem(match["what"]):
            raise UsageError(f"{text!r} is not a change: {problem}")
        if match["robot"] and match["what"].partition(":")[0] in _DETAILS:
            raise UsageError(f"{text!r} is not a change: only a change of a body can be for one robot")
        number, robot = (None if match[name] is None else int(match[name]) for name in ("number", "robot"))
        if 0 in {number, robot}:
            raise UsageError(f"{text!r} is not a change: environments and robots are counted from 1")
        return Change(match["what"], number, float(match["from_start"] or match["after"] or 0), robot)

    @property
    def name(self) -> str:
        """Name of the change, without details."""
        return self.what.partition(":")[0]

    @property
    def numbers(self) -> list[int]:
        """The numbers in the details, mm."""
        return [int(number) for number in re.findall(r"\d+", self.what)]

    def __str__(self) -> str:
        seconds = f"{self.after_s:.10g}s"
        when = seconds if self.number is None else f"env{self.number}" + (f"+{seconds}" if self.after_s else "")
        return f"{self.what}@{when}" + (f"/{self.robot}" if self.robot else "")


def _problem(what: str) -> str | None:
    """The error in a change, with a suggestion; None if there is none."""
    name = what.partition(":")[0]
    if name not in CHANGE_NAMES:
        return meant(name, CHANGE_NAMES)
    if name in _DETAILS:
        pattern, form = _DETAILS[name]
        return None if pattern.fullmatch(what.removeprefix(name)) else f"write {form}"
    try:
        check_fault(what)
    except ValueError as error:
        return str(error)
    return None


def read_changes(text: str) -> list[str]:
    """The changes in a command-line argument: one change, or a file with one per line.

    A file is a name without an @, or with one in front: changes.txt, @changes.txt. In it, # begins a comment.

    Raises:
        UsageError: The file cannot be read, or has an invalid change; the message names the line.
    """
    if "@" in text.removeprefix("@"):
        return [str(Change.parse(text))]
    path = Path(text.removeprefix("@"))
    if not path.exists():
        raise UsageError(f"{text!r} is neither a change nor a file of changes that exists: {_FORM}")
    return read_words(path, _FILE_MAX, lambda word: str(Change.parse(word)))
