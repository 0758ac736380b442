"""tools/test --quick: the tests that uncommitted changes concern, and a summary of those left out."""

import argparse
import re
import subprocess
from collections.abc import Collection, Mapping, Sequence
from pathlib import Path

from tools.testing import affected, stage_paths
from tools.testing.stages import C_BUILD, ROOT, Stage, c_stage, pytest_stage, run_stages, set_up

_CODE = re.compile(r"\.(py|c|h|S|ld|dbc|js|ts|json|html|css|toml|cmake)$|^tools/[^.]+$")


def run(arguments: argparse.Namespace) -> int:
    """Runs the checks and tests that the changes concern.

    Returns:
        0 if all of it passed, or nothing has changed; else 1.
    """
    changed = changed_files(ROOT)
    if not changed:
        print("nothing has changed since the last commit")
        return 0
    found, farther = python_tests(ROOT, changed)
    tests = set().union(*found.values())
    own = {name: {test for test in tests if stage_paths.is_of(name, test)} for name in stage_paths.QUICK}
    own["python"] = {test for test in tests if not test.startswith(tuple(stage_paths.named()))}
    deeper = sorted(tests.difference(*own.values()))
    python = (pytest_stage(name, sorted(paths), arguments.allow_missing) for name, paths in own.items() if paths)
    c_stages, c_sources = _c_stage(changed)
    code = run_stages([*_checks(changed), *c_stages, *python], arguments)
    left = [f"{farther} more test files that import the change, directly or not"] if farther else []
    left += [f"of tools/prove {', '.join(deeper)}"] if deeper else []
    print(f"left out: {'; '.join([*left, 'what needs vcan0'])}. tools/test and tools/prove run all")
    lonely = untested(found, c_sources)
    for path in lonely:
        print(f"no test is known for {path}")
    return 1 if lonely else code


def changed_files(root: Path) -> list[str]:
    """The files of a checkout that were changed or added since the last commit."""
    commands = (("diff", "--name-only", "-z", "HEAD"), ("ls-files", "--others", "--exclude-standard", "-z"))
    named = "".join(subprocess.check_output(("git", *words), cwd=root, text=True) for words in commands)
    return [path for path in named.split("\0") if (root / path).is_file()]


def python_tests(root: Path, changed: Sequence[str]) -> tuple[dict[str, set[str]], int]:
    """The Python test files that each change affects, and the number of those farther away in the import graph."""
    sources = _files(root, ("host_sim", "tests", "tools"), (".py",))
    tests = [path for path in sources if affected.is_test(path)]
    graph = affected.importers(root, sources)
    named = affected.mentions(root, _files(root, ("host_sim", "tests"), (".py", *affected.PAGES)))
    found, farther = {}, 0
    for path in changed:
        users = affected.page_users(named, path) if path.endswith(affected.PAGES) else {path}
        nearest, others = _by_imports(graph, sorted(users))
        near = nearest | set(filter(affected.is_test, users))
        if path.endswith(affected.PAGES):
            near = {it for it in near if it.startswith("tests/web/")} or near
        found[path] = near | affected.by_name(root, path, tests) | _of_documents(path, tests)
        farther = max(farther, others)
    return found, farther


def untested(found: Mapping[str, Collection[str]], c_sources: Collection[str]) -> list[str]:
    """The changed files of code that no test is known for, in Python or in C."""
    return [path for path, tests in found.items() if _CODE.search(path) and not tests and path not in c_sources]


def _files(root: Path, tops: Sequence[str], ends: Sequence[str]) -> list[str]:
    paths = (path for top in tops for path in (root / top).rglob("*") if path.suffix in ends and path.is_file())
    return [path.relative_to(root).as_posix() for path in paths]


def _by_imports(graph: affected.Graph, modules: Sequence[str]) -> tuple[set[str], int]:
    each = [affected.by_imports(graph, module) for module in modules]
    return set().union(*(tests for tests, _ in each)), max((others for _, others in each), default=0)


def _of_documents(path: str, tests: Sequence[str]) -> set[str]:
    return {test for test in tests if test.startswith("tests/docs/")} if path.endswith(".md") else set()


def _checks(changed: Sequence[str]) -> list[Stage]:
    """The stages lint and types, if Python files have changed."""
    python = [path for path in changed if path.endswith(".py")]
    if not python:
        return []
    return [
        Stage(
            "lint", "lint", [(".venv/bin/ruff", "check", *python), (".venv/bin/ruff", "format", "--check", *python)]
        ),
        Stage("types", "types", [(".venv/bin/mypy",)]),
    ]


def _c_stage(changed: Sequence[str]) -> tuple[list[Stage], set[str]]:
    """The stage of the C tests that depend on changed files, and those of the files that some depend on."""
    sources = [path for path in changed if path.endswith((".c", ".h", ".dbc", "robot.toml"))]
    if not sources or not set_up([c_stage()]):
        return [c_stage()] if sources else [], set(sources)
    each = {path: affected.c_tests(ROOT / "build" / C_BUILD, [path]) for path in sources}
    names = sorted(set().union(*each.values()))
    stages = [c_stage("-LE", "vcan", "-R", selection(names))] if names else []
    return stages, {path for path, tests in each.items() if tests}


def selection(programs: Sequence[str]) -> str:
    """A pattern for ctest: the tests of these programs. A test that passes an argument is named after it, too."""
    return f"^({'|'.join(programs)})(_[a-z]+)?$"
