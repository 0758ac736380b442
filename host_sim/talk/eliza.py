"""ELIZA: answers sentences according to a script, as the program of 1966 did."""

import re
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

from host_sim.base.errors import OctetError
from host_sim.talk.script import AnyOf, Fact, Part, Pieces, Rule, Script, Tagged

_CHARACTERS = 6
_BITS = 36
_ROWS = (
    (0o00, "0123456789"),
    (0o13, "='"),
    (0o20, "+ABCDEFGHI"),
    (0o33, ".)"),
    (0o40, "-JKLMNOPQR"),
    (0o53, "$*"),
    (0o60, " /STUVWXYZ"),
    (0o73, ",("),
)
_CODES = {character: first + i for first, row in _ROWS for i, character in enumerate(row)}


def slip_hash(word: str, bits: int) -> int:
    """The hash of a word, from its last machine word of six characters on an IBM 7094.

    Args:
        word: The word; a character that the machine did not have is taken by its low six bits.
        bits: Number of bits of the result, 0..15.

    >>> slip_hash("ALWAYS", 7), slip_hash("HERE", 2)
    (14, 3)
    """
    last = word[(len(word) - 1) // _CHARACTERS * _CHARACTERS :]
    cell = 0
    for character in last.ljust(_CHARACTERS):
        cell = cell << _CHARACTERS | _CODES.get(character, ord(character) & 0o77)
    cell &= (1 << _BITS - 1) - 1
    return cell * cell >> _BITS - 1 - bits // 2 & (1 << bits) - 1


STEPS_MAX = 100_000
"""Maximum number of keywords tried for a sentence, and of words added to it. With more, a script loops for ever."""

_LIMIT = 4
_NOTHING_MATCHES = ("PLEASE CONTINUE", "HMMM", "GO ON , PLEASE", "I SEE")
_DELIMITERS = frozenset({",", ".", "BUT"})
_SIGNS = {"!?": ".", ":;\u2012\u2013\u2014\u2015": ",", '"`\u201c\u201d\u201e': " ", "\u2018\u2019": "'"}
_PUNCTUATION = str.maketrans({sign: to for signs, to in _SIGNS.items() for sign in signs})
_WORDS = re.compile(r"[,.]|[^,.\x00-\x20\x7f-\xa0\u1680\u2000-\u200a\u2028\u2029\u202f\u205f\u3000\ufeff]+")


class Known(NamedTuple):
    """A fact as text, and its evidence."""

    text: str
    evidence: Any


class Answer(NamedTuple):
    """An answer: its text, and the evidence for each of its facts; empty if it has none."""

    text: str
    evidence: tuple[Any, ...] = ()


Facts = Mapping[str, Callable[[Sequence[str]], Known | None]]
"""Facts by name: each is a function of the words of a part that returns None if the fact is not known."""

Found = list[list[str]]
"""The words of each part of a decomposition."""


def words_of(sentence: str) -> list[str]:
    """The words of a sentence, in capitals; commas and full stops are words of their own.

    >>> words_of("Well, who made you?")
    ['WELL', ',', 'WHO', 'MADE', 'YOU', '.']
    """
    return _WORDS.findall(sentence.upper().translate(_PUNCTUATION))


class Eliza:
    """A conversation. It remembers sentences, and cycles through the reassemblies of its script.

    Attributes:
        facts: The facts that the script may ask for.
    """

    def __init__(self, script: Script, facts: Facts | None = None) -> None:
        self._script, self.facts = script, facts or {}
        self._limit = 1
        self._memories: deque[str] = deque()

    def answer(self, sentence: str) -> Answer:
        """Answers a sentence.

        Raises:
            OctetError: The script loops for ever.
        """
        self._limit = self._limit % _LIMIT + 1
        words, keys = self._scan(words_of(sentence))
        if not keys and self._limit == _LIMIT and self._memories:
            return Answer(self._memories.popleft())
        size = len(words)
        for _ in range(STEPS_MAX):
            rule = self._script.rules[keys.popleft()] if keys else self._script.none
            if len(words) - size > STEPS_MAX:
                break
            done = self._apply(rule, words, keys)
            if isinstance(done, Answer):
                return done
            words = done
        raise OctetError(f"the script loops for ever at {rule.key}: stopped after {STEPS_MAX} steps")

    def _scan(self, words: list[str]) -> tuple[list[str], deque[str]]:
        """The clause to answer, with substitutions made, and its keywords in the order to try."""
        keys: deque[str] = deque()
        begin, highest = 0, -1
        for i, word in enumerate(words):
            if word in _DELIMITERS:
                if keys:
                    return words[begin:i], keys
                begin = i + 1
            elif rule := self._script.rules.get(word):
                if rule.substitute is not None:
                    words[i] = rule.substitute
                if rule.can_answer and rule.rank > highest:
                    keys.appendleft(word)
                    highest = rule.rank
                elif rule.can_answer:
                    keys.append(word)
        return words[begin:], keys

    def _apply(self, rule: Rule, words: list[str], keys: deque[str]) -> Answer | list[str]:
        """Applies a rule. Returns an answer, or the words to which the remaining keywords apply."""
        if rule.key == self._script.memory.key:
            self._remember(words)
        for transformation in rule.transformations:
            found = self._match(transformation.parts, words)
            if found is not None:
                pieces, key = transformation.next()
                if key is not None:
                    keys.appendleft(key)
                    return words if pieces is None else _put_together(pieces, found)
                return (pieces and self._say(pieces, found)) or words
        if rule.link is None:
            return Answer(_NOTHING_MATCHES[self._limit - 1])
        keys.appendleft(rule.link)
        return words

    def _say(self, pieces: Pieces, found: Found) -> Answer | None:
        """Assembles an answer; None if a fact in it is not known."""
        texts, evidence = [], []
        for piece in pieces:
            if isinstance(piece, Fact):
                known = self.facts[piece.fact]([] if piece.part is None else found[piece.part - 1])
                if known is None:
                    return None
                texts.append(known.text)
                evidence.append(known.evidence)
            else:
                texts += _put_together((piece,), found)
        return Answer(" ".join(texts), tuple(evidence))

    def _remember(self, words: Sequence[str]) -> None:
        way = self._script.memory.transformations[slip_hash(words[-1] if words else "", 2)]
        found = self._match(way.parts, words)
        if found is not None:
            self._memories.append(" ".join(_put_together(way.reassemblies[0].pieces or (), found)))

    def _match(self, parts: Sequence[Part], words: Sequence[str]) -> Found | None:
        """The words of each part, each 0 taking as few as possible from left to right; None without a match.

        Zeros separate runs of parts of fixed length: the first run begins the sentence, the last one ends it, and
        each of the others takes the first place where it fits.
        """
        runs: list[list[Part]] = [[]]
        for part in parts:
            if part == 0:
                runs.append([])
            else:
                runs[-1].append(part)
        found: Found = []
        at = 0
        for i, run in enumerate(runs):
            size = sum(part if isinstance(part, int) else 1 for part in run)
            last = len(words) - size
            if at > last:
                return None
            places = range(at, 1) if i == 0 else range(last if i == len(runs) - 1 else at, last + 1)
            start = next((place for place in places if self._fits(run, words, place)), None)
            if start is None:
                return None
            if i > 0:
                found.append(list(words[at:start]))
            at = start
            for part in run:
                size = part if isinstance(part, int) else 1
                found.append(list(words[at : at + size]))
                at += size
        return found if at == len(words) else None

    def _fits(self, run: Sequence[Part], words: Sequence[str], at: int) -> bool:
        for part in run:
            if isinstance(part, int):
                at += part
                continue
            if not self._is_one(part, words[at]):
                return False
            at += 1
        return True

    def _is_one(self, part: str | AnyOf | Tagged, word: str) -> bool:
        if isinstance(part, AnyOf):
            return word in part.words
        if isinstance(part, Tagged):
            rule = self._script.rules.get(word)
            return rule is not None and not set(part.tags).isdisjoint(rule.tags)
        return word == part


def _put_together(pieces: Pieces, found: Found) -> list[str]:
    words: list[str] = []
    for piece in pieces:
        words += found[piece - 1] if isinstance(piece, int) else [str(piece)]
    return words
