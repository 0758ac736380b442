"""A study's folder: its plan, its version, and its rows in Parquet, written in parts.

A part is a file of the same number in each of the folders `contacts`, `environments` and `runs`, written in this
order; it counts once its file in `runs` exists. So a study stopped at any moment has complete runs only.
"""

import json
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple

from host_sim.base.errors import UsageError
from host_sim.base.extra_library import library
from host_sim.base.files import read_bytes, replacing, run_folder, write_bytes
from host_sim.base.paths import ROOT
from host_sim.base.toml_file import read_toml
from host_sim.lab.study.plan import Plan
from host_sim.lab.study.tables import COLUMNS, Row, Rows, Tables
from host_sim.lab.study.version import FORMAT, code_version

STUDY_FILE = "study.json"
PLAN_FILE = "study.toml"
_SIZE_MAX = 1_000_000
_RUNS = "runs"


class StudyFolder:
    """Reads and adds rows; `open_study` opens one for writing."""

    def __init__(self, path: Path) -> None:
        """Takes a folder that contains a study.

        Raises:
            UsageError: There is no study in it, or it is of another version.
        """
        self.path = path
        self.about = _read_about(path)

    def done(self) -> set[tuple[str, int]]:
        """The keys of the completed trials."""
        runs = self._read(_RUNS)
        return set(zip(runs["condition"].tolist(), runs["seed"].tolist(), strict=True))

    def tables(self) -> Tables:
        """All rows."""
        return {name: self._read(name) for name in COLUMNS}

    def add(self, runs: Sequence[Rows]) -> None:
        """Adds a part.

        Raises:
            OctetError: The part cannot be written; the study is unchanged.
        """
        parts = self._parts()
        number = parts[-1] + 1 if parts else 0
        for name in reversed(list(COLUMNS)):
            self._write(name, number, [row for run in runs for row in run[name]])

    def _parts(self) -> list[int]:
        return sorted(int(path.stem) for path in (self.path / _RUNS).glob("[0-9]*.parquet"))

    def _file(self, table: str, number: int) -> Path:
        return self.path / table / f"{number:06d}.parquet"

    def _write(self, name: str, number: int, rows: Sequence[Row]) -> None:
        pyarrow, parquet = library("pyarrow", "study"), library("pyarrow.parquet", "study")
        table = pyarrow.Table.from_pylist(rows, _schema(name))
        with replacing(self._file(name, number)) as part:
            parquet.write_table(table, part, compression="zstd")

    def _read(self, name: str) -> dict[str, Any]:
        pyarrow, parquet = library("pyarrow", "study"), library("pyarrow.parquet", "study")
        try:
            tables = [parquet.read_table(self._file(name, number), schema=_schema(name)) for number in self._parts()]
        except (OSError, pyarrow.ArrowException) as error:
            raise UsageError(f"cannot read the study in {self.path}: {str(error).splitlines()[0]}") from None
        whole = pyarrow.concat_tables([_schema(name).empty_table(), *tables])
        return {column: whole[column].to_numpy() for column in whole.column_names}


@contextmanager
def open_study(path: Path, plan: Plan) -> Iterator[StudyFolder]:
    """Opens a study's folder to add rows, creating it if needed; no other process can add rows meanwhile.

    Raises:
        UsageError: The folder has other contents, or a study of another plan or version; it is not changed.
    """
    with run_folder(path):
        commands = {it.condition: it.config.command() for it in plan.conditions}
        about = {"format": FORMAT, "code": code_version(), "title": plan.title, "conditions": commands}
        if own := {it.config.profile: it.config.own.source.sha256 for it in plan.conditions if it.config.own}:
            about["sources"] = own
        if not (path / STUDY_FILE).exists():
            _make(path, about)
        folder = StudyFolder(path)
        _check_same(folder, about)
        yield folder


def _make(path: Path, about: dict[str, Any]) -> None:
    ours = [path / name for name in COLUMNS]
    # A study stopped here has left empty folders.
    if not {*path.iterdir()} <= {*ours} or any(each.is_file() or any(each.iterdir()) for each in path.iterdir()):
        raise UsageError(f"{path} has something else in it; choose another folder with --out")
    for each in ours:
        each.mkdir(exist_ok=True)
    write_bytes(path / STUDY_FILE, json.dumps(about, indent=1).encode() + b"\n")


def _read_about(path: Path) -> dict[str, Any]:
    try:
        about = json.loads(read_bytes(path / STUDY_FILE, _SIZE_MAX))
        version = about["format"]
    except FileNotFoundError:
        raise UsageError(f"there is no study in {path}") from None
    except (ValueError, LookupError, TypeError):
        raise UsageError(f"{path / STUDY_FILE} was not written by a study") from None
    if version != FORMAT:
        raise UsageError(f"the study in {path} is of format {version}, this Octet's is {FORMAT}; nothing was changed")
    return dict(about)


def _check_same(folder: StudyFolder, about: dict[str, Any]) -> None:
    """Checks that the plan, apart from title and seeds, the robot and the world are the same as before."""
    differ = [key for key in about if key != "title" and folder.about.get(key) != about[key]]
    if differ == ["code"]:
        why = "was made with another version of robot or world"
    elif differ:
        why = f"has other {', '.join(key for key in differ if key != 'code')}"
    else:
        return
    raise UsageError(f"the study in {folder.path} {why}; nothing was changed: choose another folder with --out")


def _schema(name: str) -> Any:
    pyarrow = library("pyarrow", "study")
    kinds = {str: pyarrow.string(), int: pyarrow.int64(), float: pyarrow.float64(), bool: pyarrow.bool_()}
    return pyarrow.schema([(column, kinds[kind]) for column, kind in COLUMNS[name].items()])


USED_SEEDS = ROOT / "studies" / "used_seeds.toml"
_KEYS = {"first": int, "last": int, "what": str}


class Used(NamedTuple):
    """A range of seeds, and what it was used for."""

    first: int
    last: int
    what: str


def read_used(path: Path = USED_SEEDS) -> list[Used]:
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


def used_seed_notes(first: int, last: int, path: Path = USED_SEEDS) -> Iterator[str]:
    """For each range that has some of these seeds, a line that says so.

    >>> list(used_seed_notes(3000001, 3000010))
    ['used      seeds 3000001..3000010 for the open board: studies/board.toml']
    """
    for it in read_used(path):
        if first <= it.last and it.first <= last:
            yield f"used      seeds {max(first, it.first)}..{min(last, it.last)} for {it.what}"
