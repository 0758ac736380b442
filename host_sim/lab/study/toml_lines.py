"""Where something stands in a TOML file, for messages."""

import re
from collections import Counter
from collections.abc import Iterable

from host_sim.base.near_word import near_word

_HEADER = re.compile(r"\s*\[\[?\s*([^\[\]]+?)\s*\]\]?\s*(?:#.*)?$")


def line_of(text: str, table: str, key: str = "", index: int = 0) -> int:
    r"""The line in which a key stands.

    >>> line_of('a = 1\n[[goals]]\n[[goals]]\nb = 2\n', "goals", "b", index=1)
    4

    Args:
        text: The file.
        table: Name of the key's table; empty for the keys before the first table.
        key: The key; empty for the table's own line.
        index: Which table of that name, from 0.

    Returns:
        The line, from 1. Where the key or its table is written in another way: the line of what holds it, or 1.
    """
    now, counts, held = "", Counter({"": 1}), 1
    for number, line in enumerate(text.splitlines(), 1):
        if header := _HEADER.match(line):
            now = header[1].replace('"', "")
            counts[now] += 1
            if now == table and counts[now] == index + 1:
                held = number
        is_there = now == table and counts[now] == index + 1
        if key and is_there and re.match(rf"""\s*["']?{re.escape(key)}["']?\s*[=.]""", line):
            return number
        if not now and table and re.match(rf"\s*{re.escape(table.split('.', maxsplit=1)[0])}\s*[=.]", line):
            held = number
    return held


def meant(word: object, words: Iterable[str]) -> str:
    """What there is, for a message about a word that is none of them; the nearest one alone if one is near.

    >>> meant("artcle", ["article", "fixed"])
    'did you mean article?'
    """
    every = list(words)
    near = near_word(str(word), every)
    return f"did you mean {near}?" if near else f"there are {', '.join(every)}"
