"""Scripts in the language of ELIZA (Weizenbaum, CACM 9/1, 1966), read and checked.

Two extensions: `;` begins a comment, and a reassembly may ask for facts, `(* NAME 1)`.
"""

import re
from collections.abc import Collection, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple, NoReturn

from host_sim.base.errors import UsageError

_COMMENT = re.compile(r";[^\n]*")
_TOKEN = re.compile(r"[\n()=]|[0-9]+|[^\s()=\ufeff]+")


class Word(str):
    """A word, in capitals."""

    line: int

    @classmethod
    def at(cls, line: int, text: str) -> "Word":
        """Creates a word in a line."""
        word = cls(text)
        word.line = line
        return word


class Group(list[Any]):
    """A list of words and lists."""

    line: int

    @classmethod
    def at(cls, line: int) -> "Group":
        """Creates an empty list that begins in a line."""
        group = cls()
        group.line = line
        return group

    def starts_with(self, sign: str) -> bool:
        """Whether its first word begins with a sign."""
        return bool(self) and isinstance(self[0], Word) and self[0].startswith(sign)


Node = Word | Group


def read_groups(text: str, name: str) -> list[Group]:
    """Reads the lists of a script, whose name is for error messages; empty lists are left out.

    Raises:
        UsageError: Parentheses do not match, or a word other than START is outside them.
    """
    line, nested = 1, [Group()]
    for token in _TOKEN.finditer(_COMMENT.sub("", text)):
        where = f"{name}, line {line}"
        sign = token.group().upper()
        if sign == "\n":
            line += 1
        elif sign == "(":
            group = Group.at(line)
            nested[-1].append(group)
            nested.append(group)
        elif sign == ")" and len(nested) > 1:
            nested.pop()
        elif sign != ")" and len(nested) > 1:
            nested[-1].append(Word.at(line, sign))
        elif sign != "START":
            raise UsageError(f"{where}: {sign[:40]} stands outside the lists")
    if len(nested) > 1:
        raise UsageError(f"{name}: the list that begins in line {nested[-1].line} is not closed")
    return [group for group in nested[0] if group]


_DIGITS_MAX = 9

MEMORIES = 4
"""The transformations of a MEMORY rule."""


@dataclass(frozen=True)
class AnyOf:
    """Matches one of several words: `(*A B)`."""

    words: tuple[str, ...]


@dataclass(frozen=True)
class Tagged:
    """Matches a word that has one of several tags: `(/A B)`."""

    tags: tuple[str, ...]


@dataclass(frozen=True)
class Fact:
    """A request for a fact, about a part: `(* NAME 1)`, or in general: `(* NAME)`."""

    fact: str
    part: int | None


Part = str | int | AnyOf | Tagged
"""A part of a decomposition; a number matches that many words, 0 any number."""

Pieces = tuple[str | int | Fact, ...]
"""Pieces of a reassembly: words, part numbers, and facts."""


class Reassembly(NamedTuple):
    """A text to assemble, and the keyword to continue with, if any.

    Pieces alone are an answer; a key alone is `(=KEY)`; both are `(PRE (...) (=KEY))`: the pieces replace the
    sentence. Neither is `(NEWKEY)`: continue with the sentence's next keyword.
    """

    pieces: Pieces | None = None
    key: str | None = None


@dataclass
class Transformation:
    """A decomposition and its reassemblies, used in rotation; `turn` is the number of the next one."""

    parts: tuple[Part, ...]
    reassemblies: tuple[Reassembly, ...]
    turn: int = 0

    def next(self) -> Reassembly:
        """The next reassembly in rotation."""
        turn, self.turn = self.turn, (self.turn + 1) % len(self.reassemblies)
        return self.reassemblies[turn]


@dataclass
class Rule:
    """The rule for a keyword.

    Attributes:
        key: The keyword.
        line: Its line in the script.
        substitute: The word that replaces it in the sentence.
        tags: Tags by which decompositions match it.
        rank: Its rank among the keywords of a sentence.
        transformations: Tried in order; the first whose decomposition matches is used.
        link: The keyword to continue with if none matches.
    """

    key: str
    line: int
    substitute: str | None = None
    tags: tuple[str, ...] = ()
    rank: int = 0
    transformations: list[Transformation] = field(default_factory=list)
    link: str | None = None

    @property
    def can_answer(self) -> bool:
        """Whether it does more than substitute words and carry tags."""
        return bool(self.transformations or self.link)


@dataclass
class Script:
    """A script.

    Attributes:
        greeting: The opening sentence.
        rules: Rules by keyword.
        none: The rule for sentences without a keyword.
        memory: The rule that remembers sentences with its keyword, by one of four transformations.
        facts: Names of the facts that it uses.
    """

    greeting: str
    rules: dict[str, Rule]
    none: Rule
    memory: Rule
    facts: list[str]


def read_script(text: str, name: str, facts: Collection[str] = ()) -> Script:
    """Reads a script, which may use the named facts; its own name is for error messages.

    Raises:
        UsageError: The script has an error; the message names the line.
    """
    return _Reader(name, facts).read(text)


class _Reader:
    def __init__(self, name: str, facts: Collection[str]) -> None:
        self._name, self._facts = name, facts
        self._links: list[Word] = []
        self._asked: set[str] = set()

    def read(self, text: str) -> Script:
        groups = read_groups(text, self._name)
        if not groups:
            raise UsageError(f"{self._name}: a script begins with its greeting, a list of words")
        greeting = " ".join(self._word(node) for node in groups[0])
        rules: dict[str, Rule] = {}
        special: dict[str, Rule] = {}
        for group in groups[1:]:
            key = self._word(group[0])
            known = special if key in {"MEMORY", "NONE"} else rules
            if key in known:
                self._fail(group, f"{key} has a rule already, in line {known[key].line}")
            known[str(key)] = self._memory(group) if key == "MEMORY" else self._rule(group)
        for needed in ("NONE", "MEMORY"):
            if needed not in special:
                self._fail(groups[-1], f"the script has no {needed}")
        script = Script(greeting, rules, special["NONE"], special["MEMORY"], sorted(self._asked))
        self._check_links(script)
        return script

    def _check_links(self, script: Script) -> None:
        memory = script.memory
        if memory.key not in script.rules:
            raise UsageError(f"{self._name}, line {memory.line}: MEMORY's keyword {memory.key} has no rule")
        for link in self._links:
            if link not in script.rules or not script.rules[link].can_answer:
                self._fail(link, f"the link leads to {link}, which has no transformation")

    def _rule(self, group: Group) -> Rule:
        rule, nodes = Rule(group[0], group.line), group[1:]
        if nodes[:1] == ["="]:
            rule.substitute = self._word(nodes[1] if len(nodes) > 1 else group)
            nodes = nodes[2:]
        for node in (node for node in nodes if node != "DLIST"):
            if isinstance(node, Word):
                rule.rank = (
                    int(node) if _is_number(node) else self._fail(node, f"{node} is neither a rank nor a list")
                )
            elif node.starts_with("="):
                rule.link = self._link(node)
            elif node.starts_with("/"):
                rule.tags = tuple(self._listed(node))
            else:
                rule.transformations.append(self._transformation(node))
        if not rule.can_answer and rule.substitute is None and not rule.tags:
            self._fail(group, f"the rule of {rule.key} is empty")
        if rule.key == "NONE" and not any(_always_speaks(it) for it in rule.transformations):
            self._fail(group, "NONE needs a transformation ((0) (...)) with an answer that asks for no fact")
        return rule

    def _memory(self, group: Group) -> Rule:
        if len(group) != MEMORIES + 2:
            self._fail(group, f"MEMORY has a keyword and exactly {MEMORIES} transformations")
        rule = Rule(self._word(group[1]), group.line)
        for node in group[2:]:
            if isinstance(node, Word) or "=" not in node:
                self._fail(node, "a transformation of MEMORY is (DECOMPOSITION = REASSEMBLY)")
            middle = node.index("=")
            parts = self._parts(node[:middle], node)
            pieces = self._pieces(node[middle + 1 :], node, len(parts), ())
            rule.transformations.append(Transformation(parts, (Reassembly(pieces),)))
        return rule

    def _transformation(self, group: Group) -> Transformation:
        decomposition, *reassemblies = group or [group]
        if isinstance(decomposition, Word) or not reassemblies:
            self._fail(group, "a transformation is a decomposition and its reassemblies: ((0) (...) ...)")
        parts = self._parts(decomposition, group)
        return Transformation(parts, tuple(self._reassembly(node, len(parts)) for node in reassemblies))

    def _parts(self, nodes: Sequence[Node], where: Node) -> tuple[Part, ...]:
        return tuple(map(self._part, nodes)) or self._fail(where, "a decomposition is empty")

    def _part(self, node: Node) -> Part:
        if isinstance(node, Word):
            return int(node) if _is_number(node) else node
        if node.starts_with("/"):
            return Tagged(tuple(self._listed(node)))
        if node.starts_with("*"):
            return AnyOf(tuple(self._listed(node)))
        return AnyOf(())  # as in 1966, when a list without a sign matched no word

    def _reassembly(self, node: Node, parts: int) -> Reassembly:
        if isinstance(node, Word):
            self._fail(node, "a reassembly is a list")
        if node.starts_with("="):
            return Reassembly(None, self._link(node))
        if node == ["NEWKEY"]:
            return Reassembly()
        if node[:1] != ["PRE"]:
            return Reassembly(self._pieces(node, node, parts, self._facts))
        match node[1:]:
            case [Group() as pieces, Group() as link] if link.starts_with("="):
                return Reassembly(self._pieces(pieces, node, parts, ()), self._link(link))
        return self._fail(node, "PRE is written (PRE (REASSEMBLY) (=KEY))")

    def _pieces(self, nodes: Sequence[Node], where: Node, parts: int, facts: Collection[str]) -> Pieces:
        def piece(node: Node) -> str | int | Fact:
            if isinstance(node, Word):
                return self._number(node, parts) if _is_number(node) else node
            name, *rest = self._listed(node) if node.starts_with("*") else self._fail(node, "(* NAME 1) is expected")
            if name not in facts:
                self._fail(node, f"there is no fact {name} here; there are: {', '.join(sorted(facts)) or 'none'}")
            self._asked.add(name)
            return Fact(name, self._number(rest[0], parts) if rest else None)

        return tuple(map(piece, nodes)) or self._fail(where, "a reassembly is empty")

    def _number(self, word: Word, parts: int) -> int:
        if _is_number(word) and 1 <= int(word) <= parts:
            return int(word)
        return self._fail(word, f"there is no part {word}: the decomposition has {parts}")

    def _link(self, group: Group) -> Word:
        _, *keys = group
        key = self._word(keys[0] if len(keys) == 1 else group)
        self._links.append(key)
        return key

    def _listed(self, group: Group) -> list[Word]:
        """The words of a list after its sign, which may be attached to the first word."""
        first = Word.at(group.line, self._word(group[0])[1:])
        return [self._word(it) for it in ([first] if first else []) + group[1:]] or self._fail(
            group, "no word follows"
        )

    def _word(self, node: Node) -> Word:
        return node if isinstance(node, Word) else self._fail(node, "a word is expected")

    def _fail(self, node: Node, what: str) -> NoReturn:
        raise UsageError(f"{self._name}, line {node.line}: {what}")


def _is_number(word: str) -> bool:
    return word.isascii() and word.isdigit() and len(word) <= _DIGITS_MAX


def _always_speaks(it: Transformation) -> bool:
    """Whether it has an answer without facts to any sentence."""
    answers = [one.pieces for one in it.reassemblies if one.pieces and one.key is None]
    return it.parts == (0,) and any(not isinstance(piece, Fact) for pieces in answers for piece in pieces)
