"""The seeds that have been used before, of `studies/used_seeds.toml`, so that no table rests on them unawares."""

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from host_sim.base.paths import ROOT
from host_sim.base.toml_file import read_toml

FILE = ROOT / "studies" / "used_seeds.toml"
_KEYS = {"first": int, "last": int, "what": str}


class Used(NamedTuple):
    """A range of seeds, and what it was used for."""

    first: int
    last: int
    what: str


def read_used(path: Path = FILE) -> list[Used]:
    """The ranges of a file, in its order.

    Raises:
        UsageError: The file cannot be read, or has an error.
    """
    file = read_toml(path, "a list of used seeds")
    ranges = file.content.get("used", [])
    for i, it in enumerate(ranges):
        if {key: type(value) for key, value in it.items()} != _KEYS or it["first"] > it["last"]:
            raise file.error("a range has first, last and what it was used for", "", table="used", index=i)
    return [Used(**it) for it in ranges]


def notes(first: int, last: int, path: Path = FILE) -> Iterator[str]:
    """For each range that has some of these seeds, a line that says so.

    >>> list(notes(3000001, 3000010))
    ['used      seeds 3000001..3000010 for the open board: studies/board.toml']
    """
    for it in read_used(path):
        if first <= it.last and it.first <= last:
            yield f"used      seeds {max(first, it.first)}..{min(last, it.last)} for {it.what}"
