"""TOML files that people write: a mistake in one is reported with its line."""

import importlib
import re
import sys
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from host_sim.base.errors import UsageError
from host_sim.base.files import read_text

_SIZE_MAX = 1_000_000
_WHERE = re.compile(r" ?\(at (?:line (\d+), column \d+|end of document)\)")
_HEADER = re.compile(r"\s*\[\[?\s*([^\[\]]+?)\s*\]\]?\s*(?:#.*)?$")
_LIST_IN_LIST = 2


@dataclass(frozen=True)
class TomlFile:
    """A TOML file that was read.

    Attributes:
        path: Path of the file.
        text: Its text.
        content: Its parsed content.
    """

    path: Path
    text: str
    content: Mapping[str, Any]

    def error(self, message: object, key: str, **where: Any) -> UsageError:
        """An error about a key, with its line; see `line_of`."""
        return UsageError(f"{self.path}:{line_of(self.text, key, **where)}: {message}")


def read_toml(path: Path, what: str) -> TomlFile:
    """Reads a file that describes something.

    Raises:
        UsageError: The file cannot be read, or is not TOML.
    """
    try:
        text = read_text(path, _SIZE_MAX)
        return TomlFile(path, text, parse_toml(text))
    except FileNotFoundError:
        raise UsageError(f"there is no file {path}") from None
    except UnicodeDecodeError:
        raise UsageError(f"{path} is not {what}: it is not text") from None
    except RecursionError:
        raise UsageError(f"{path}: brackets are nested too deeply") from None
    except ValueError as error:
        where = _WHERE.search(str(error))
        if where is None:  # Python's own: it reads no whole number of thousands of digits
            raise UsageError(f"{path}: a number has too many digits") from None
        line = where[1] or max(1, len(text.splitlines()))
        raise UsageError(f"{path}:{line}: this is not TOML: {_WHERE.sub('', str(error))}") from None


def parse_toml(text: str) -> dict[str, Any]:
    """Parses TOML. Before Python 3.11 the parser is a package of .venv; only this call needs it, help texts do not.

    Raises:
        ValueError: The text is not TOML.
        UsageError: This Python has no parser.
    """
    try:
        parser = importlib.import_module("tomllib" if sys.version_info >= (3, 11) else "tomli")
    except ModuleNotFoundError:
        python = "this python3 cannot read TOML"
        raise UsageError(f"{python}: use 3.11 or newer, or call .venv/bin/python with the same arguments") from None
    parsed: dict[str, Any] = parser.loads(text)
    return parsed


def line_of(text: str, key: str, *, table: str = "", index: int = 0, entry: int = -1) -> int:
    r"""The line number of a key.

    >>> line_of('a = 1\n[[goals]]\n[[goals]]\nb = 2\n', "b", table="goals", index=1)
    4

    Args:
        text: The file.
        key: The key; empty for its table's own line.
        table: Name of the key's table; empty for the keys before the first table.
        index: Which table of that name, from 0.
        entry: Which entry of the key's list, from 0; -1 for all of it.

    Returns:
        The line, from 1. If the key or its table is written in another way: the line of what contains it, or 1.
    """
    lines = text.splitlines()
    first = _first_line(lines, key, table, index)
    depth, begun = 0, -1
    for number, line in enumerate(lines[first - 1 :], first):
        for character in line.partition("#")[0]:
            depth += (character == "[") - (character == "]")
            begun += character == "[" and depth == _LIST_IN_LIST
            if begun == entry >= 0:
                return number
    return first


def _first_line(lines: list[str], key: str, table: str, index: int) -> int:
    names = key, table.partition(".")[0]
    is_key, is_table = (re.compile(rf"""\s*["']?{re.escape(name)}["']?\s*[=.]""") for name in names)
    now, counts, held = "", Counter({"": 1}), 1
    for number, line in enumerate(lines, 1):
        if header := _HEADER.match(line):
            now = header[1].replace('"', "")
            counts[now] += 1
            if now == (table or key) and counts[now] == index + 1:
                held = number
        if key and now == table and counts[now] == index + 1 and is_key.match(line):
            return number
        if table and not now and is_table.match(line):
            held = number
    return held
