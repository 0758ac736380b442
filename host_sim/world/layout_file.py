"""Files in which a person describes a world, in TOML; each mistake is reported with its line."""

import importlib
import re
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from host_sim.base.errors import UsageError
from host_sim.base.regular_file import read_text
from host_sim.world.layouts import World
from host_sim.world.written_world import WrittenError, world_from

# Its name depends on the version of Python, and mypy knows only one of them.
_toml = importlib.import_module("tomllib" if sys.version_info >= (3, 11) else "tomli")

_FILE_MAX = 1_000_000
_WHERE = re.compile(r" ?\(at (?:line (\d+), column \d+|end of document)\)")
_LIST_IN_LIST = 2


def read_layout_file(path: Path) -> World:
    """Reads a world that a person wrote. All its environments have the same obstacles and food.

    Raises:
        UsageError: The file cannot be read, or does not describe a fair world; the message says in which line, and
            what was meant.
    """
    content, lines = read_toml(path, "a world")
    try:
        return world_from(content, path.name)
    except WrittenError as error:
        raise UsageError(f"{path}:{line_of(lines, error.key, error.number)}: {error}") from None


def read_toml(path: Path, what: str) -> tuple[Mapping[str, Any], Sequence[str]]:
    """Reads a TOML file that describes something; its content, and its lines.

    Raises:
        UsageError: It cannot be read, or is not TOML.
    """
    try:
        text = read_text(path, _FILE_MAX)
    except OSError as error:
        raise UsageError(f"cannot read {path}: {error.strerror}") from None
    except UnicodeDecodeError:
        raise UsageError(f"{path} is not {what}: it is not text") from None
    return _parsed(path, text), text.splitlines()


def _parsed(path: Path, text: str) -> Mapping[str, Any]:
    try:
        content: Mapping[str, Any] = _toml.loads(text)
    except (ValueError, RecursionError) as error:
        where = _WHERE.search(str(error))
        line = where[1] if where and where[1] else max(1, len(text.splitlines()))
        raise UsageError(f"{path}:{line}: this is not TOML: {_WHERE.sub('', str(error))}") from None
    return content


def line_of(lines: Sequence[str], key: str, number: int) -> int:
    """The line in which a key stands or, for a number from 0 on, that entry of its list."""
    is_key = re.compile(rf"\s*[\[\"']*{re.escape(key)}\b")
    first = next((i for i, line in enumerate(lines, 1) if is_key.match(line)), 1)
    depth, begun = 0, -1
    for i, line in enumerate(lines[first - 1 :], first):
        for character in line.partition("#")[0]:
            depth += (character == "[") - (character == "]")
            begun += character == "[" and depth == _LIST_IN_LIST
            if begun == number >= 0:
                return i
    return first
