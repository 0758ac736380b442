"""Grades files, each in a process with limits and without network; finds copies; writes tables."""

import html
import json
import os
import re
import subprocess
import sys
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from host_sim.base.errors import UsageError
from host_sim.base.files import csv_text, write_bytes
from host_sim.base.result_files import Case, write_results
from host_sim.base.terminal import counted
from host_sim.lab.grade.attempt import TITLES, Verdict

_WALL_S = 120.0
_TAIL = 400
_NOISE = re.compile(r"/\*.*?\*/|//[^\n]*|\s+", re.DOTALL)
_NAME = re.compile(r"\b[A-Za-z_]\w*\b")
_COMMENT_OR_SPACE = " "


@dataclass(frozen=True)
class Grade:
    """A graded file.

    Attributes:
        file: The file.
        verdict: The verdict on it.
        copies: The other files that are equal to it but for names, comments and spaces.
    """

    file: Path
    verdict: Verdict
    copies: tuple[str, ...] = ()


@cache
def network_is_off() -> bool:
    """Whether this system lets attempts run without network."""
    try:
        return subprocess.run([*_NO_NETWORK, "true"], capture_output=True, check=False).returncode == 0
    except OSError:
        return False


_NO_NETWORK = ("unshare", "--net", "--map-root-user")


def grade(number: int, seed: int, files: Sequence[Path], *page: Path) -> list[Grade]:
    """Grades files, several at once; with a page as `attempt` writes it, if there is one file."""
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        judged = pool.map(lambda file: _judged(number, seed, file, *page), files)
        verdicts = list(counted(judged, len(files), "solutions"))
    skeletons = [_skeleton(file) for file in files]
    copies = [
        tuple(str(it) for it, other in zip(files, skeletons, strict=True) if other == skeleton and it != file)
        for file, skeleton in zip(files, skeletons, strict=True)
    ]
    return [Grade(*it) for it in zip(files, verdicts, copies, strict=True)]


def _judged(*task: int | Path) -> Verdict:
    """The verdict of `attempt` in a process of its own; `task` is its arguments."""
    limited, file = _NO_NETWORK if network_is_off() else (), task[2]
    command = [*limited, sys.executable, "-m", "host_sim.lab.grade.attempt", *map(str, task)]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=_WALL_S, check=False)
        found = json.loads(done.stdout.splitlines()[-1])
    except subprocess.TimeoutExpired:
        return Verdict("fail", f"{file} takes longer than {_WALL_S:g} s")
    except (IndexError, ValueError):
        return Verdict(
            "fail", f"{file} was ended by a limit of time, memory or files: {done.stderr[-_TAIL:].strip()}"
        )
    return Verdict(**found)


def _skeleton(file: Path) -> str:
    """A source without comments and spaces, and with the same name for all names."""
    try:
        text = file.read_text(encoding="utf-8", errors="replace")
    except OSError:
        return f"unread {file}"
    return _NOISE.sub("", _NAME.sub("x", _NOISE.sub(_COMMENT_OR_SPACE, text)))


def files_of(paths: Sequence[Path]) -> list[Path]:
    """The C files among paths: the files named, and those in the folders named, and in theirs.

    Raises:
        UsageError: There are none, or a file is not there.
    """
    for path in paths:
        if not path.exists():
            raise UsageError(f"cannot read {path}: there is no such file or folder")
    found = [it for path in paths for it in (sorted(path.rglob("*.c")) if path.is_dir() else [path]) if it.is_file()]
    if not found:
        raise UsageError(f"no C file is in {', '.join(map(str, paths))}")
    return found


def rows_of(grades: Sequence[Grade]) -> list[tuple[str, str, str]]:
    """A row for each file: path, status and message."""
    messages = ["; ".join(filter(None, [it.verdict.message, _copies_note(it)])) for it in grades]
    return [(str(it.file), it.verdict.status, text) for it, text in zip(grades, messages, strict=True)]


def _copies_note(it: Grade) -> str:
    return f"the same but for names and comments: {', '.join(it.copies)}" if it.copies else ""


def write_csv(number: int, grades: Sequence[Grade], path: Path) -> None:
    """Writes a table for spreadsheets."""
    rows = [("exercise", "file", "status", "message"), *((number, *row) for row in rows_of(grades))]
    write_bytes(path, csv_text(rows).encode())


def write_html(number: int, grades: Sequence[Grade], path: Path) -> None:
    """Writes a table for browsers."""
    title = html.escape(f"Exercise {number}: {TITLES[number]}")
    rows = ["".join(f"<td>{html.escape(cell)}</td>" for cell in row) for row in rows_of(grades)]
    lines = [f'<tr class="{it.verdict.status}">{row}</tr>' for it, row in zip(grades, rows, strict=True)]
    style = "body{font:1rem sans-serif}td{border-top:1px solid;padding:.3em;white-space:pre-wrap}.pass{color:#06611f}"
    head = f'<!DOCTYPE html><meta charset="utf-8"><title>{title}</title><style>{style}</style><h1>{title}</h1>'
    write_bytes(path, "\n".join([head, "<table>", *lines, "</table>", ""]).encode())


def write_junit(number: int, grades: Sequence[Grade], path: Path) -> None:
    """Writes a report for CI servers, in JUnit's format."""
    results = {"pass": "passed", "fail": "failed", "error": "error"}
    cases = [Case(str(it.file), results[it.verdict.status], it.verdict.message) for it in grades]
    write_results(f"exercise {number}", cases, None, path)


def write_exercism(number: int, grades: Sequence[Grade], folder: Path) -> None:
    """Writes a file for each pupil, as Exercism's test runners do (version 2 of their format)."""
    for place, it in enumerate(grades, 1):
        status, message = it.verdict.status, it.verdict.message or None
        tests = [] if status == "error" else [{"name": TITLES[number], "status": status, "message": message}]
        content = {"version": 2, "status": status, "message": message if status == "error" else None, "tests": tests}
        path = folder / f"{place:03}-{it.file.parent.name}-{it.file.stem}.json"
        write_bytes(path, f"{json.dumps(content, indent=2)}\n".encode())
