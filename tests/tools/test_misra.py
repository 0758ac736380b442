"""The check against MISRA C: the sources pass, and what is not named in the table does not."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from tools.verify.misra import CHECKED, built_sources  # noqa: E402 - found by the line above

OF_A_SYSTEM = {
    *("hal/library/exchange.c", "hal/port/posix/file_store.c", "hal/port/posix/posix_port.c"),
    *(f"hal/link/{name}.c" for name in ("deadline", "link_by_name", "slcan_link", "socket_link")),
}
"""Sources that need an operating system: no image has them."""
CLEAN = """static int twice(int x)
{
    return 2 * x;
}

int four(void);
int four(void)
{
    return twice(2);
}
"""
OCTAL = CLEAN.replace("twice(2)", "twice(010)")
ROW = '[[exception]]\nwhat = "rule {}"\nin = "{}"\nwhy = "{}"\n'


def misra(*arguments: object) -> subprocess.CompletedProcess[str]:
    words = [str(argument) for argument in arguments]
    return subprocess.run([ROOT / "tools" / "misra", *words], capture_output=True, text=True, check=False)


@pytest.fixture
def check(tmp_path):
    """Checks a source against a table."""

    def run(source: str, table: str = "exception = []\n") -> subprocess.CompletedProcess[str]:
        for name, text in (("source.c", source), ("table.toml", table)):
            (tmp_path / name).write_text(text)
        return misra("--deviations", tmp_path / "table.toml", "--sources", tmp_path / "source.c")

    return run


def test_all_that_deviates_is_named_and_needed():
    result = misra()

    assert result.returncode == 0, result.stderr
    assert " 0 complaints" in result.stdout


def test_only_what_needs_an_operating_system_is_left_out():
    checked = {command["file"] for command in built_sources()}
    sources = {str(path): path for folder in CHECKED for path in (ROOT / folder).rglob("*.c")}

    assert {sources[name].relative_to(ROOT).as_posix() for name in sources.keys() - checked} == OF_A_SYSTEM


def test_a_source_that_keeps_the_rules_passes(check):
    result = check(CLEAN)

    assert (result.returncode, result.stderr) == (0, "")


def test_a_rule_that_is_not_kept_is_told_with_its_line(check):
    result = check(OCTAL)

    assert result.returncode == 1
    assert "source.c:9: rule 7.1: not allowed by the table" in result.stderr


def test_one_that_is_named_for_the_file_passes(check):
    assert check(OCTAL, ROW.format("7.1", "*/source.c", "a canary")).returncode == 0


@pytest.mark.parametrize(
    ("row", "complaint"),
    [
        (ROW.format("7.1", "*/other.c", "a canary"), "*/other.c: `rule 7.1` is not found any more"),
        (ROW.format("7.2", "*/source.c", "a canary"), "rule 7.1: not allowed by the table"),
        (ROW.format("7.1", "*/source.c", " "), "lacks `in`, `what` or `why`"),
        ('[[exception]]\nwhat = "rule 7.1"\n', "cannot read"),
    ],
)
def test_a_table_that_does_not_fit_fails(check, row, complaint):
    result = check(OCTAL, row)

    assert result.returncode == 1
    assert complaint in result.stderr


def test_what_cannot_be_parsed_fails(check):
    result = check("int broken(void) { return (1; }\n")

    assert result.returncode == 1
    assert "does not understand" in result.stderr
