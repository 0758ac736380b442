"""Figures of studies as small tables, and a document that takes its numbers from the tables.

In the document a number is a link to its table: the part after # names the row, with + for a space, and the figure,
such as [0.38 s](tables/learned.csv#article,blocked_s). A third word, interval, selects the 95 % interval instead. A
figure with the suffix _compared is its difference from that of the first row: a ratio, or percentage points. The
table itself follows a comment such as <!-- table learned.csv: finished median_s -->.
"""

import csv
import re
from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path

import numpy as np

from host_sim.base.errors import OctetError
from host_sim.base.files import csv_text, write_bytes
from host_sim.lab.study.figures import FIGURES, Figure, compare, estimate
from host_sim.lab.study.sample import Sample
from host_sim.lab.study.table import interval_of, text_of
from host_sim.lab.table import markdown

TABLES = "tables"

_COMPARED = {
    f"{name}_compared": Figure(it.heading, "", " points" if it.counted else "", 1 if it.counted else 2, it.of)
    for name, it in FIGURES.items()
}
_OF_MAPS = {
    "explained": Figure("variance explained", "", " %", 0, FIGURES["finished"].of),
    "alike": Figure("alike", "", "", 2, FIGURES["by_tour"].of),
    "turned": Figure("alike, turned over", "", "", 2, FIGURES["by_tour"].of),
}
_ALL = {**FIGURES, **_COMPARED, **_OF_MAPS}
_COLUMNS = ("condition", "figure", "value", "low", "high")
_LINK = re.compile(rf"\[[^\]]*\]\(({TABLES}/[\w-]+\.csv)#([^),]+),(\w+)(,interval)?\)")
_BLOCK = re.compile(r"(<!-- table ([\w-]+\.csv): ([\w ]+?) -->\n)(?:\|[^\n]*\n)*")

Rows = dict[tuple[str, str], tuple[float, float, float]]
"""Value, low and high by condition and figure."""


def write_table(samples: Sequence[Sample], path: Path) -> None:
    """Writes every figure of every condition, with its interval, as comma-separated values."""
    write_rows(rows_of(samples), path)


def rows_of(samples: Sequence[Sample]) -> Rows:
    """Every figure of every condition."""
    rows: Rows = {}
    for sample in samples:
        for name, figure in FIGURES.items():
            found = {name: estimate(figure, sample), f"{name}_compared": compare(figure, sample, samples[0])}
            for key, it in found.items():
                if not np.isnan(it.value) and not (sample is samples[0] and key != name):
                    rows[sample.name, key] = it.value, it.low, it.high
    return rows


def write_rows(rows: Rows, path: Path) -> None:
    """Writes figures as comma-separated values."""
    path.parent.mkdir(parents=True, exist_ok=True)
    lines = [_COLUMNS, *([*key, *(f"{it:.6g}" for it in values)] for key, values in rows.items())]
    write_bytes(path, csv_text(lines).encode())


def fill(text: str, folder: Path) -> str:
    """Fills a document with the numbers of the tables in its folder.

    Raises:
        OctetError: A table or a row of it is missing.
    """
    rows_of = cache(lambda table: _read(folder / table))

    def look_up(table: str, condition: str, figure: str, kind: str = "") -> str:
        try:
            value, low, high = rows_of(table)[condition, figure]
        except KeyError:
            raise OctetError(f"{folder / table} has no figure {figure} of {condition}") from None
        what = _ALL[figure]
        return interval_of(what, low, high) if kind else text_of(what, value)

    def link(found: re.Match[str]) -> str:
        number = look_up(found[1], found[2].replace("+", " "), found[3], found[4] or "")
        return f"[{number}]({found[1]}#{found[2]},{found[3]}{found[4] or ''})"

    def block(found: re.Match[str]) -> str:
        table, figures = f"{TABLES}/{found[2]}", found[3].split()
        conditions = dict.fromkeys(condition for condition, _ in rows_of(table))

        def cell(condition: str, figure: str) -> str:
            value, interval = (look_up(table, condition, figure, kind) for kind in ("", "interval"))
            bounds = interval.removesuffix(_ALL[figure].unit)
            return value if interval == f"{value}..{value}" else f"{value} ({bounds})"

        return found[1] + _markdown(list(conditions), figures, cell)

    return _LINK.sub(link, _BLOCK.sub(block, text))


def _markdown(conditions: Sequence[str], figures: Sequence[str], cell: Callable[[str, str], str]) -> str:
    rows = [["", *(_ALL[figure].heading for figure in figures)]]
    rows += [[f"`{condition}`", *(cell(condition, figure) for figure in figures)] for condition in conditions]
    return markdown(rows) + "\n"


def _read(path: Path) -> Rows:
    try:
        with path.open(newline="", encoding="ascii") as file:
            rows = list(csv.DictReader(file))
        return {(row["condition"], row["figure"]): tuple(float(row[it]) for it in _COLUMNS[2:]) for row in rows}  # type: ignore[misc]
    except (OSError, ValueError, LookupError, TypeError) as error:
        raise OctetError(f"cannot read the table {path}: {error}") from None
