"""What robots do and what changes around them, in plain sentences: those of robot.toml, as on the pages."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby

from host_sim.protocol.generated import BODY_SENTENCES, PATTERNS, SENTENCES, SIDES, Reason, Side
from host_sim.recording.state_types import Lesson, State, Trial
from host_sim.sim.world_record import Edited, WorldRecord


@dataclass(frozen=True)
class Words:
    """The words of a language.

    Attributes:
        sentences: Sentences by their names in robot.toml.
        patterns: The patterns of the front sensors.
        sides: The sides of a turn.
        point: The decimal point.
        many: The word for an unknown number of turns.
    """

    sentences: Mapping[str, str]
    patterns: Sequence[str]
    sides: Sequence[str]
    point: str = "."
    many: str = "Many"


ENGLISH = Words(SENTENCES, PATTERNS, SIDES)


def sentence(state: State, words: Words = ENGLISH) -> str:
    """A robot's state in one sentence."""
    side: int = Side.LEFT if state["left"] < state["right"] else Side.RIGHT
    if state["reason"] == Reason.TRIAL and state["trial"]:
        side = state["trial"]["side"]  # it also stands still while it tries
    return words.sentences[_name(state)].format(
        Pattern=words.patterns[state["pattern"]].capitalize(),
        side=words.sides[side],
        turns=state["repeat_count"] or words.many,
        beacon=decimal(state["beacon"] / 1000, 2, words),
    )


def decimal(value: float, digits: int, words: Words = ENGLISH) -> str:
    """Formats a number that is not negative, rounded half up, as the pages do.

    >>> decimal(0.125, 2), decimal(1.015, 2)
    ('0.13', '1.02')
    """
    unit = 10**digits
    return f"{math.floor(value * unit + 0.5 + 1e-9) / unit:.{digits}f}".replace(".", words.point)


def _name(state: State) -> str:
    reason = Reason(state["reason"])
    if state["lifted"]:
        return "lifted"
    if reason == Reason.TOWARD_FOOD and not state["beacon"]:
        return "wander"
    if reason == Reason.REMEMBERED and state["by_hand"][state["pattern"]]:
        return "remembered_told"
    return "look_aside" if reason == Reason.AVOID and state["left"] != state["right"] else reason.name.lower()


def verdict(trial: Trial | None, words: Words = ENGLISH) -> str:
    """The outcome of a trial in two sentences; empty without a trial, or before its end."""
    if trial is None or trial["helped"] is None:
        return ""
    helped = "helped_frozen" if trial["frozen"] else "helped"
    return _of_cell(helped if trial["helped"] else "useless", trial["cell"], trial["side"], words)


def body_sentence(what: str) -> str:
    """A fault of a body, as in `host_sim.world.body_kinds`, in one sentence."""
    name, *details = what.replace("/", " of ").split(":")
    return BODY_SENTENCES[name].format(*details)


def lesson_sentence(lesson: Lesson, words: Words = ENGLISH) -> str:
    """A change of a cell in one sentence."""
    names = ("forgotten", "erased", "learned", "told")
    return _of_cell(names[2 * bool(lesson["side"]) + lesson["by_hand"]], lesson["cell"], lesson["side"], words)


def _of_cell(name: str, cell: int, side: int, words: Words) -> str:
    return words.sentences[name].format(pattern=words.patterns[cell], side=words.sides[side])


News = tuple[int, str]
"""The tick before which something changed, and a sentence."""

_SHOWN = ("plant", "move_plant", "grow_plant", "remove_plant", "body")


def news_of(record: WorldRecord) -> list[News]:
    """All changes in order, including scheduled ones that could not happen, but not things moved by hand."""
    told = [(tick, sentence) for (tick, sentence), _ in groupby(_sentences(record))]
    refused = [(refused.tick, f"{refused.what} could not happen: {refused.why}.") for refused in record.refused]
    return sorted([*told, *refused], key=lambda news: news[0])


def _sentences(record: WorldRecord) -> list[News]:
    edits = [edited for edited in record.edits if edited.edit.do in _SHOWN]
    return [(edited.tick, _sentence(edited, edits, record.robots)) for edited in edits]


def _sentence(edited: Edited, edits: list[Edited], robots: int) -> str:
    edit = edited.edit
    if edit.do != "body":
        return SENTENCES[edit.do]
    everyone = sum((tick, it.do, it.what) == (edited.tick, "body", edit.what) for tick, it in edits)
    return ("" if everyone == robots else f"Robot {edit.robot + 1}: ") + body_sentence(edit.what)
