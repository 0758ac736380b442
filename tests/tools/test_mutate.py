"""Mutants: the tests kill enough of those of the chosen source; other tests do not.

Tests find a sample of faults that are planted in a copy of the tree.
"""

import re
import runpy
import subprocess
from pathlib import Path

import pytest

from host_sim.base.toml_file import parse_toml
from tests.planted.__main__ import Fault, copy_of_the_tree, faults, is_found

ROOT = Path(__file__).resolve().parents[2]
MUTATE = runpy.run_path(str(ROOT / "tools/mutate"))
TABLE = parse_toml((ROOT / "tools/verify/mutants.toml").read_text())
SOURCE = """/* Adds two numbers
   of a kind. */
int sum(int a, int b)
{
    return a + b; /* no more */
}
"""


def mutate(*words: str) -> tuple[int, str]:
    done = subprocess.run([ROOT / "tools/mutate", *words], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


def test_tests_kill_enough_mutants_of_the_chosen_source():
    code, said = mutate("--turn")

    assert code == 0, said


def test_surviving_mutants_are_printed_and_fail():
    code, said = mutate("--test=can_body", "hal/flash_store/crc32.c")

    assert code == 1
    assert re.search(r"^hal/flash_store/crc32.c:\d+: .", said, re.MULTILINE)
    assert float(said.splitlines()[-2].split()[1]) < TABLE["hal/flash_store/crc32.c"]
    assert said.endswith(f"crc32.c: at least {TABLE['hal/flash_store/crc32.c']} % must be killed\n")


def test_source_without_a_test_fails():
    name = "hal/port/cortex_m/startup.c"

    assert mutate(name) == (1, f"{name}: no C test is built from it\n{name}: at least 95 % must be killed\n")


def test_source_that_is_only_in_a_program_has_a_test():
    assert len(MUTATE["tests_of"](ROOT / "firmware/main.c", ["main"])) == 1


def test_source_must_reach_its_row_of_the_table():
    table = {"high.c": 99, "low.c": 80}

    assert MUTATE["misses"]({"high.c": 99.0, "low.c": 80.9}, table, strict=False) == []
    assert MUTATE["misses"]({"high.c": 98.9, "low.c": 79.9, "none.c": 94.9}, table, strict=False) == [
        "high.c: at least 99 % must be killed",
        "low.c: at least 80 % must be killed",
        "none.c: at least 95 % must be killed",
    ]


def test_strict_pass_fails_sources_without_a_row_or_below_95_percent():
    percents = {"high.c": 99.0, "low.c": 80.9, "none.c": 100.0}

    assert MUTATE["misses"](percents, {"high.c": 99, "low.c": 80}, strict=True) == [
        "low.c: at least 95 % must be killed",
        "none.c: not in the table",
    ]


def test_commit_hash_chooses_each_source_in_turn():
    turns = [MUTATE["turn"](("b.c", "a.c"), f"{number:040x}\n") for number in (0, 1, 2)]

    assert turns == ["a.c", "b.c", "a.c"]


def test_table_has_a_row_that_reaches_the_bar_for_each_source():
    sources = {str(file.relative_to(ROOT)) for folder in MUTATE["FOLDERS"] for file in (ROOT / folder).rglob("*.c")}

    assert {name for name, percent in TABLE.items() if MUTATE["BAR"] <= percent <= 100} == sources


def test_line_of_code_beside_a_comment_has_mutants(tmp_path):
    source = tmp_path / "sum.c"
    source.write_text(SOURCE)

    lines = set(MUTATE["mutants_of"](source).values())

    assert "5:     return a - b;" in lines
    assert not any(line.startswith(("1:", "2:")) for line in lines)


@pytest.mark.parametrize("folder", MUTATE["FOLDERS"])
def test_mutated_folder_has_c_sources(folder):
    assert list((ROOT / folder).glob("*.c"))


SAMPLE = 2
"""Number of faults of a run; the commit chooses them."""


def chosen() -> list[Fault]:
    """The faults of the sample, among those whose tests need neither a browser nor the libraries of studies."""
    every = [fault for fault in faults() if not fault.tests.startswith(("tests/web", "tests/lab/study"))]
    head = subprocess.check_output(["git", "-C", ROOT, "rev-parse", "HEAD"], text=True)
    return [every[(int(head, 16) + i * len(every) // SAMPLE) % len(every)] for i in range(SAMPLE)]


@pytest.mark.parametrize("fault", chosen(), ids=lambda fault: fault.file)
def test_planted_fault_is_found_and_the_unchanged_tree_passes(fault):
    with copy_of_the_tree() as tree:
        assert is_found(fault, tree)
        assert not is_found(fault._replace(new=fault.old), tree)
