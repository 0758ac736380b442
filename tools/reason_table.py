"""Reads the tables of what a gate lets through: rows of a TOML file, each with its reason."""

import importlib
import sys
from pathlib import Path

# Python 3.10 has none of its own.
_toml = importlib.import_module("tomllib" if sys.version_info >= (3, 11) else "tomli")


class TableError(Exception):
    """The table cannot be used; says why."""


def read_table(path: Path, table: str, of: str, patterns: str) -> list[tuple[str, tuple[str, ...]]]:
    """The rows of a table: what each is of, and the patterns that it lets through.

    Args:
        path: The file.
        table: The table's name.
        of: The key of what a row is of.
        patterns: The key of its patterns.

    Raises:
        TableError: It cannot be read, or a row lacks one of these or its reason.
    """
    try:
        rows = _toml.loads(path.read_text())[table]
        read = [(str(row[of]), tuple(map(str, row[patterns])), row["why"].strip()) for row in rows]
    except (OSError, _toml.TOMLDecodeError, KeyError, TypeError, AttributeError) as error:
        raise TableError(f"cannot read {path}: {error!r}") from error
    for subject, found, why in read:
        if not why or not found:
            raise TableError(f"{path}: {of} {subject} has no reason or no {patterns}")
    return [(subject, found) for subject, found, _ in read]
