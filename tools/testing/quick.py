"""tools/test --quick: the tests that uncommitted changes concern, and a summary of those left out."""

import argparse
import subprocess
from collections.abc import Sequence
from pathlib import Path

from tools.testing import concerned, places
from tools.testing.stages import C_BUILD, ROOT, Stage, c_stage, pytest_stage, run_stages, set_up


def run(arguments: argparse.Namespace) -> int:
    """Runs the checks and tests that the changes concern.

    Returns:
        0 if all of it passed, or nothing has changed; else 1.
    """
    changed = changed_files(ROOT)
    if not changed:
        print("nothing has changed since the last commit")
        return 0
    tests, farther = python_tests(ROOT, changed)
    own = {name: {test for test in tests if places.is_of(name, test)} for name in places.QUICK}
    own["python"] = {test for test in tests if not test.startswith(tuple(places.named()))}
    deeper = sorted(tests.difference(*own.values()))
    python = (pytest_stage(name, sorted(paths), arguments.allow_missing) for name, paths in own.items() if paths)
    stages = [*_checks(changed), *_c_stage(changed), *python]
    code = run_stages(stages, arguments)
    left = [f"{farther} more test files that import the change, directly or not"] if farther else []
    left += [f"of tools/prove {', '.join(deeper)}"] if deeper else []
    print(f"left out: {'; '.join([*left, 'what needs vcan0'])}. tools/test and tools/prove run all")
    return code


def changed_files(root: Path) -> list[str]:
    """The files of a checkout that were changed or added since the last commit."""
    commands = (("diff", "--name-only", "-z", "HEAD"), ("ls-files", "--others", "--exclude-standard", "-z"))
    named = "".join(subprocess.check_output(("git", *words), cwd=root, text=True) for words in commands)
    return [path for path in named.split("\0") if (root / path).is_file()]


def python_tests(root: Path, changed: Sequence[str]) -> tuple[set[str], int]:
    """The Python test files that the changes concern, and the number of those farther away in the import graph."""
    files = (path for top in ("host_sim", "tests", "tools") for path in (root / top).rglob("*.py"))
    sources = [path.relative_to(root).as_posix() for path in files]
    tests = [path for path in sources if concerned.is_test(path)]
    graph = concerned.importers(root, sources)
    found, farther = {path for path in changed if concerned.is_test(path)}, 0
    for path in changed:
        nearest, others = concerned.by_imports(graph, path) if path.endswith(".py") else (set(), 0)
        found |= nearest | concerned.by_name(root, path, tests)
        farther = max(farther, others)
    return found, farther


def _checks(changed: Sequence[str]) -> list[Stage]:
    """The stages lint and types, if Python files have changed."""
    python = [path for path in changed if path.endswith(".py")]
    if not python:
        return []
    return [
        Stage(
            "lint", "lint", [(".venv/bin/ruff", "check", *python), (".venv/bin/ruff", "format", "--check", *python)]
        ),
        Stage("types", "types", [(".venv/bin/mypy",)], beside=True),
    ]


def _c_stage(changed: Sequence[str]) -> list[Stage]:
    """The stage of the C tests that depend on changed files."""
    sources = [path for path in changed if path.endswith((".c", ".h", ".dbc", "robot.toml"))]
    if not sources or not set_up([c_stage()]):
        return [c_stage()] if sources else []
    names = concerned.c_tests(ROOT / "build" / C_BUILD, sources)
    return [c_stage("-LE", "vcan", "-R", selection(names))] if names else []


def selection(programs: Sequence[str]) -> str:
    """A pattern for ctest: the tests of these programs. A test that passes an argument is named after it, too."""
    return f"^({'|'.join(programs)})(_[a-z]+)?$"
