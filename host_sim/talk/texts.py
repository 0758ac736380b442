"""The texts in which a robot states its facts: a file beside the script, one for each language."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from host_sim.base.toml_file import parse_toml
from host_sim.protocol.generated import Side
from host_sim.recording.phrases import ENGLISH, Words
from host_sim.talk.languages import languages

POINT = "\u00b7"
"""Stands for the decimal point in a question, since ELIZA takes a full stop for the end of a sentence."""

_BITS = {"turns": 0, "all": 7, "right": 1, "left": 4, "front": 2}
_DECIMAL = re.compile(r"(?<=[0-9])[.,](?=[0-9])")


@dataclass(frozen=True)
class Texts:
    """The words of one language.

    Attributes:
        words: Words used in the robot's sentences.
        facts: A text with placeholders in braces for each fact, and for each case without anything to report.
        spoken: Phrases in questions for turns, and for the front sensors; longer phrases first.
        joined: Words before which a comma does not split a sentence; None for a script that is not the robot's, which
            gets each sentence unchanged.
    """

    words: Words
    facts: Mapping[str, str]
    spoken: Mapping[str, Sequence[str]]
    joined: Sequence[str] | None

    def say(self, name: str, /, **values: object) -> str:
        """A text with its placeholders filled in."""
        return self.facts[name].format(**values)

    def times(self, count: int) -> str:
        """A number of times, in words."""
        return self.say("once" if count == 1 else "times", count=count)

    def of_cell(self, cell: int, side: int) -> dict[str, str]:
        """The placeholders of a text about a cell."""
        return {"pattern": self.words.patterns[cell], "side": self.words.sides[side]}

    def cell_in(self, words: Sequence[str]) -> int:
        """The pattern of front sensors named in a question; 0 if there is none."""
        said, cell = f" {' '.join(words)} ".replace("-", " "), 0
        for where, names in self.spoken.items():
            for name in names:
                if f" {name} " in said:
                    cell |= _BITS[where]
                    said = said.replace(f" {name} ", " ")
        return cell

    def side_in(self, words: Sequence[str]) -> int:
        """The side named in a question; 0 if there is none."""
        sides = (Side.LEFT, "left"), (Side.RIGHT, "right")
        return next((side for side, name in sides if not set(self.spoken[name]).isdisjoint(words)), Side.NOTHING)

    def heard(self, sentence: str) -> str:
        """Prepares a question for the script: replaces decimal points, and drops commas that do not split it."""
        if self.joined is None:
            return sentence
        joined = rf",(?=\s+(?:{'|'.join(self.joined)})\s)"
        return re.sub(joined, " ", _DECIMAL.sub(POINT, sentence), flags=re.IGNORECASE)


def read_texts(path: Path) -> Texts:
    """Reads the texts of a language.

    Raises:
        OSError, ValueError, KeyError: The file is not a valid file of texts.
    """
    read = parse_toml(path.read_text(encoding="utf-8"))
    own: dict[str, Any] = languages()[read["language"]]["robot"]
    words = replace(ENGLISH, **{**own, "sentences": {**ENGLISH.sentences, **own.get("sentences", {})}})
    return Texts(words, read["facts"], read["spoken"], read["joined"])
