"""Plants each fault of faults.toml in a copy of the tree, and runs the tests that must fail with it.

Example: python -m tests.planted 27-31. Without a number, plants all, which takes about ten minutes. Prints those that
no test found. Exit code 1 if there are more than MISSED_MAX.
"""

import argparse
import json
import os
import runpy
import shutil
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

from host_sim.base.toml_file import parse_toml

ROOT = Path(__file__).resolve().parents[2]
MISSED_MAX = 2
_NOT_COPIED = shutil.ignore_patterns("build", ".venv", ".git", "__pycache__", "out", ".*_cache")
_FAILED, _NONE_COLLECTED = 1, 5


class Fault(NamedTuple):
    """A fault, and the tests that find it."""

    file: str
    old: str
    new: str
    tests: str

    @property
    def text(self) -> str:
        """The text of the file with the fault."""
        return (ROOT / self.file).read_text().replace(self.old, self.new, 1)


def faults() -> list[Fault]:
    """All faults, in the order of the file."""
    return [Fault(*row) for row in parse_toml(Path(__file__).with_name("faults.toml").read_text())["faults"]]


@contextmanager
def copy_of_the_tree() -> Iterator[Path]:
    """A copy of the sources, with their builds; its tools/setup does nothing, so that they stay as they are."""
    with TemporaryDirectory() as folder:
        tree = Path(folder) / "tree"
        shutil.copytree(ROOT, tree, ignore=_NOT_COPIED, symlinks=True)
        for name in ("build", ".venv"):
            (tree / name).symlink_to(ROOT / name)
        (tree / "tools/setup").write_text("#!/bin/sh\n")
        yield tree


def is_found(fault: Fault, tree: Path) -> bool:
    """Whether a test fails with a fault."""
    if fault.file.endswith(".c"):
        return _is_found_in_c(fault)
    path = tree / fault.file
    path.write_text(fault.text)
    try:
        return _code(fault, tree) == _FAILED
    finally:
        shutil.copyfile(ROOT / fault.file, path)


def _code(fault: Fault, tree: Path) -> int:
    """Exit code of the tests of a fault.

    Raises:
        ValueError: There are none.
    """
    words = [".venv/bin/python", "-B", "-m", "pytest", "-x", "-q", "-n0", "-p", "no:cacheprovider"]
    environment = {**os.environ, "PYTHONPATH": os.fspath(tree)}
    code = subprocess.run(
        [*words, *fault.tests.split()], cwd=tree, env=environment, capture_output=True, check=False
    ).returncode
    if code == _NONE_COLLECTED:
        raise ValueError(f"there is no test {fault.tests}")
    return code


def _is_found_in_c(fault: Fault) -> bool:
    """The same, for a source in C: it is built as tools/mutate builds its mutants."""
    mutate = runpy.run_path(os.fspath(ROOT / "tools/mutate"))
    told = mutate["output"]("ctest", "--test-dir", mutate["BUILD"], "--show-only=json-v1")
    names = [test["name"] for test in json.loads(told)["tests"]]
    tests = mutate["tests_of"](ROOT / fault.file, [it for it in names if it.startswith(fault.tests)])
    if not tests:
        raise ValueError(f"there is no test {fault.tests}")
    return not mutate["lives"](tests, fault.text)


def missed(chosen: Sequence[tuple[int, Fault]]) -> list[str]:
    """Those of some faults that no test finds, as lines."""
    lines = []
    with copy_of_the_tree() as tree:
        for number, fault in chosen:
            if not is_found(fault, tree):
                lines.append(f"{number}: {fault.file}: {fault.old.strip()!r} -> {fault.new.strip()!r}: {fault.tests}")
                sys.stdout.write(f"{lines[-1]}\n")
                sys.stdout.flush()
    return lines


def main() -> int:
    """Returns 0 if enough are found."""
    parser = argparse.ArgumentParser(prog="python -m tests.planted", description=__doc__)
    parser.add_argument("numbers", nargs="?", default="", metavar="FIRST-LAST", help="only these, counted from 1")
    first, _, last = parser.parse_args().numbers.partition("-")
    every = list(enumerate(faults(), 1))
    chosen = every[int(first) - 1 : int(last or first)] if first else every
    lines = missed(chosen)
    sys.stdout.write(f"{len(chosen) - len(lines)} of {len(chosen)} planted faults found\n")
    return int(len(lines) > MISSED_MAX)


if __name__ == "__main__":
    sys.exit(main())
