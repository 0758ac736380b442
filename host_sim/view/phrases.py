"""A robot's actions and reasons, in its own words. The pages use the same sentences, those of robot.toml."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from host_sim.protocol.generated import BODY_SENTENCES, PATTERNS, SENTENCES, SIDES, Reason, Side
from host_sim.view.state_types import Lesson, State, Trial


@dataclass(frozen=True)
class Words:
    """The words of a language.

    Attributes:
        sentences: Sentences by their names in robot.toml.
        patterns: The patterns of the front sensors.
        sides: The sides of a turn.
        point: The decimal point.
        many: A number of turns that is not known.
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
    """A number that is not negative, rounded half up, for pages round so.

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
    """A fault of a body, as in `host_sim.world.body_faults`, in one sentence."""
    name, *details = what.replace("/", " of ").split(":")
    return BODY_SENTENCES[name].format(*details)


def lesson_sentence(lesson: Lesson, words: Words = ENGLISH) -> str:
    """A change of a cell in one sentence."""
    names = ("forgotten", "erased", "learned", "told")
    return _of_cell(names[2 * bool(lesson["side"]) + lesson["by_hand"]], lesson["cell"], lesson["side"], words)


def _of_cell(name: str, cell: int, side: int, words: Words) -> str:
    return words.sentences[name].format(pattern=words.patterns[cell], side=words.sides[side])
