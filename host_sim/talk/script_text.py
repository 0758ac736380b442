"""The text of a script: words in nested lists, each with its line number."""

import re
from typing import Any

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
