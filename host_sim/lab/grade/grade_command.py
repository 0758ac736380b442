"""`tools/octet grade`: judges behaviours in C files as solutions of an exercise."""

import argparse
import sys
from pathlib import Path

from host_sim.base.errors import UsageError
from host_sim.cli.parsing import Subparsers, add_command, check_outputs, file_path, number

EXERCISES = 8
_OUTPUTS = ("--html", "--csv", "--junit")
_EXAMPLES = """\
examples:
  tools/octet grade 4 mine.c                                right, or the first wrong decision in words
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
    for flag, what in zip(
        _OUTPUTS, ("a page", "a table for spreadsheets", "a report in JUnit's format"), strict=True
    ):
        parser.add_argument(flag, type=file_path, metavar="FILE", help=f"write {what} to FILE")
    results = "write a file for each solution to DIR, in the format of Exercism's test runners"
    parser.add_argument("--results", type=file_path, metavar="DIR", help=results)


def _check(arguments: argparse.Namespace) -> None:
    check_outputs("grade", None, {flag: getattr(arguments, flag.removeprefix("--")) for flag in _OUTPUTS})


def _grade(arguments: argparse.Namespace) -> int:
    from host_sim.lab.grade import grading

    files = grading.files_of(arguments.paths)
    if not grading.network_is_off():
        sys.stderr.write("octet: this system does not let solutions run without network (unshare --net)\n")
    grades = grading.grade(arguments.exercise, arguments.seed, files)
    for file, status, said in grading.rows_of(grades):
        right = {"pass": "right", "fail": "wrong", "error": "no solution"}[status]
        print(f"{file}: {right}{f': {said}' if said else ''}")
    writers = {"html": grading.write_html, "csv": grading.write_csv, "junit": grading.write_junit}
    for name, write in writers.items():
        if (path := getattr(arguments, name)) is not None:
            write(arguments.exercise, grades, path)
    if arguments.results is not None:
        _make_folder(arguments.results)
        grading.write_exercism(arguments.exercise, grades, arguments.results)
    return 0 if all(it.verdict.status == "pass" for it in grades) else 1


def _make_folder(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UsageError(f"cannot write to {folder}: {error.strerror}") from error
