"""A C test that tests nothing fails: Unity itself says OK to no test, and to one that is ignored."""

import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
UNITY = Path(os.environ.get("UNITY_DIR", ROOT / "build/unity"))
PROJECT = f"""\
cmake_minimum_required(VERSION 3.22)
project(canary C)
enable_testing()
list(APPEND CMAKE_MODULE_PATH {ROOT}/tools/cmake)
include(warnings)
set(UNITY_DIR {UNITY})
include(unity)
octet_test(canary)
"""
PROGRAM = """\
#include "unity.h"
void setUp(void) {{}}
void tearDown(void) {{}}
static void test_it(void) {{ {body} }}
int main(void) {{ UNITY_BEGIN(); {run} return UNITY_END(); }}
"""
RUN = "RUN_TEST(test_it);"


def passes(folder: Path, body: str, run: str = RUN) -> bool:
    """Builds a C test with this body as every C test is built, and has ctest run it."""
    (folder / "CMakeLists.txt").write_text(PROJECT)
    (folder / "test_canary.c").write_text(PROGRAM.format(body=body, run=run))
    subprocess.run(["cmake", "-G", "Ninja", "-S", folder, "-B", folder / "build"], check=True, capture_output=True)
    subprocess.run(["ninja", "-C", folder / "build"], check=True, capture_output=True)
    ran = subprocess.run(["ctest", "--test-dir", folder / "build"], check=False, capture_output=True, text=True)
    assert "1 tests failed" in ran.stdout or "0 tests failed" in ran.stdout, ran.stderr
    return ran.returncode == 0


def test_a_test_that_holds_passes(tmp_path):
    assert passes(tmp_path, "TEST_ASSERT_TRUE(1);")


@pytest.mark.parametrize(
    ("body", "run"),
    [
        pytest.param("TEST_ASSERT_TRUE(0);", RUN, id="that fails"),
        pytest.param("TEST_IGNORE();", RUN, id="that is ignored"),
        pytest.param('TEST_IGNORE_MESSAGE("later");', RUN, id="that is ignored for a reason"),
        pytest.param("", "(void)test_it;", id="that is not run"),
    ],
)
def test_one_does_not(tmp_path, body, run):
    assert not passes(tmp_path, body, run)


def test_every_c_test_is_added_so():
    adding = [path for path in sorted(ROOT.glob("tests/**/CMakeLists.txt")) if "add_test(NAME" in path.read_text()]

    assert adding == []
