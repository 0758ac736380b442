"""The check against MISRA C: the sources pass; a deviation without a row and a row without a deviation do not."""

import runpy
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
MISRA = runpy.run_path(str(ROOT / "tools/misra"))
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


def misra(*arguments: object) -> tuple[int, str]:
    words = [str(argument) for argument in arguments]
    done = subprocess.run([ROOT / "tools/misra", *words], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


@pytest.fixture
def check(tmp_path):
    """Checks a source against a list of rows."""

    def run(source: str, *rows: str) -> tuple[int, str]:
        (tmp_path / "source.c").write_text(source)
        (tmp_path / "rows.txt").write_text("".join(row.format(folder=tmp_path) + "\n" for row in rows))
        return misra("--permitted", tmp_path / "rows.txt", "--sources", tmp_path / "source.c")

    return run


def test_deviations_of_the_images_match_the_rows():
    code, said = misra()

    assert (code, said.splitlines()[-1].split(", ")[1]) == (0, "0 complaints"), said


def test_missing_and_unneeded_rows_are_found_in_the_images(tmp_path):
    rows = tmp_path / "rows.txt"
    kept = (
        (ROOT / "tools/verify/misra.txt").read_text().replace("misra-c2012-19.2:hal/flash_store/flash_store.c\n", "")
    )
    many = ("misra-c2012-2.1:hal/stm32/*", "misra-c2012-2.1:hal/hal.h*", "misra-c2012-2.1:hal/gone.c")
    rows.write_text(kept + "".join(f"{row}\n" for row in many))

    code, said = misra("--permitted", rows)

    assert code == 1
    assert "hal/flash_store/flash_store.c:" in said
    assert "misra-c2012-19.2\n" in said
    assert "hal/stm32/*:0: Unmatched suppression: misra-c2012-2.1" in said
    assert "hal/hal.h*:0: Unmatched suppression: misra-c2012-2.1" in said
    assert "misra-c2012-2.1:hal/gone.c is no source that is checked" in said


def test_only_sources_that_need_an_operating_system_are_left_out():
    checked = {Path(command["file"]) for command in MISRA["built_sources"]()}
    sources = {path for folder in MISRA["OURS"] for path in (ROOT / folder).rglob("*.c")}

    assert {path.relative_to(ROOT).as_posix() for path in sources - checked} == OF_A_SYSTEM


def test_source_that_keeps_the_rules_passes(check):
    assert check(CLEAN) == (0, "1 sources, 0 complaints\n")


def test_deviation_is_reported_with_its_line_and_needs_its_row(check):
    code, said = check(OCTAL)

    assert code == 1
    assert "source.c:9: " in said
    assert ": misra-c2012-7.1\n" in said
    assert check(OCTAL, "misra-c2012-7.1:{folder}/source.c")[0] == 0


@pytest.mark.parametrize(
    ("source", "row", "why"),
    [
        (OCTAL, "misra-c2012-7.1:{folder}/other.c", "is no source that is checked"),
        (OCTAL, "misra-c2012-7.1:*/source.c", "is no source that is checked"),
        (CLEAN, "misra-c2012-7.2:{folder}/source.c", "Unmatched suppression: misra-c2012-7.2"),
    ],
)
def test_row_for_no_checked_source_or_no_deviation_fails(check, source, row, why):
    code, said = check(source, row)

    assert code == 1
    assert why in said


def test_unparsable_source_fails(check):
    code, said = check("int broken(void) { return (1; }\n")

    assert code == 1
    assert "syntaxError" in said or "internalAstError" in said, said
