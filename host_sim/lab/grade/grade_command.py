"""`tools/octet grade`: judges behaviours in C files as solutions of an exercise."""

import argparse
import sys
import webbrowser
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from host_sim.base.errors import UsageError
from host_sim.base.paths import as_called
from host_sim.base.system import has_screen
from host_sim.base.terminal import GREEN, RED, coloured
from host_sim.cli.own_source import log_words
from host_sim.cli.parsing import Subparsers, add_command, check_outputs, file_path, number

if TYPE_CHECKING:
    from host_sim.lab.grade.grading import Grade

EXERCISES = 8
_PAGE = Path("out/wrong.html")
_OUTPUTS = ("--html", "--csv", "--junit")
_EXAMPLES = """\
examples:
  tools/octet grade 4 mine.c                                right, or the first wrong decision in words
  tools/octet grade 4 mine.c --page                         and opens the run at that decision
  tools/octet grade 4 submissions --html grades.html        a row for each C file in a folder, and in its folders
  tools/octet grade 8 submissions --seed 4711 --csv grades.csv

docs/exercises.md has the exercises. The seed chooses the worlds: with the same one, verdicts are the same everywhere.
"""


def add(commands: Subparsers) -> None:
    """Adds the command."""
    parser = add_command(
        commands,
        "grade",
        _grade,
        summary="judge solutions of the exercises",
        description="Says whether a behaviour in a C file solves an exercise; if not, its first wrong decision in\n"
        "words. The exit code is 1 if one does not.",
        epilog=_EXAMPLES,
        check=_check,
    )
    parser.add_argument("exercise", type=number(1, EXERCISES), metavar="N", help=f"the exercise, 1..{EXERCISES}")
    parser.add_argument("paths", nargs="+", type=file_path, metavar="FILE", help="a C file, or a folder with C files")
    parser.add_argument("--seed", type=number(0, 2**31), default=1, help="seed of worlds and robots (default: 1)")
    kinds = "a page", "a table for spreadsheets", "a report in JUnit's format"
    for flag, what in zip(_OUTPUTS, kinds, strict=True):
        parser.add_argument(flag, type=file_path, metavar="FILE", help=f"write {what} to FILE")
    page = f"of one file: write the run up to its first wrong decision to {_PAGE}, and open it there"
    parser.add_argument("--page", action="store_true", help=page)
    results = "write a file for each solution to DIR, in the format of Exercism's test runners"
    parser.add_argument("--out", type=file_path, metavar="DIR", help=results)


def _check(arguments: argparse.Namespace) -> None:
    check_outputs("grade", None, {flag: getattr(arguments, flag.removeprefix("--")) for flag in _OUTPUTS})


def _grade(arguments: argparse.Namespace) -> int:
    from host_sim.lab.grade import grading

    files = grading.files_of(arguments.paths)
    if arguments.page and len(files) > 1:
        raise UsageError(f"--page is for one file, not for {len(files)}: name one, or leave --page out")
    for folder in (*[_PAGE.parent] * arguments.page, *filter(None, [arguments.out])):
        _make_folder(folder)
    if not grading.network_is_off():
        sys.stderr.write("octet: this system does not let solutions run without network (unshare --net)\n")
    grades = grading.grade(arguments.exercise, arguments.seed, files, *[_PAGE] * arguments.page)
    for file, status, message in grading.rows_of(grades):
        words = {"pass": ("right", GREEN), "fail": ("wrong", RED), "error": ("no solution", RED)}[status]
        print(f"{file}: {coloured(*words, sys.stdout)}{f': {message}' if message else ''}")
    if arguments.page:
        _open(grades[0])
    _write(arguments, grades)
    return 0 if all(it.verdict.status == "pass" for it in grades) else 1


def _write(arguments: argparse.Namespace, grades: "Sequence[Grade]") -> None:
    from host_sim.lab.grade import grading

    writers = {"html": grading.write_html, "csv": grading.write_csv, "junit": grading.write_junit}
    for name, write in writers.items():
        if (path := getattr(arguments, name)) is not None:
            write(arguments.exercise, grades, path)
    if arguments.out is not None:
        grading.write_exercism(arguments.exercise, grades, arguments.out)


def _open(grade: "Grade") -> None:
    """Opens the page of a wrong decision, and names the debugger's command for it."""
    if grade.verdict.tick is None:
        return
    where = f"{log_words(_PAGE.with_suffix('.log'), grade.file)} --tick {grade.verdict.tick}"
    print(as_called(f"  page      {_PAGE}\n  debugger  tools/octet debug {where}"))
    if has_screen() and sys.stdout.isatty():
        webbrowser.open(_PAGE.resolve().as_uri())


def _make_folder(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UsageError(f"cannot write to {folder}: {error.strerror}") from error
