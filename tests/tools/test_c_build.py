"""The build of C tests: one that tests nothing fails; a warning stops only a developer's build.

tools/legacy-fpu hides the extended floating-point state from a tracer, and nothing else.
"""

import errno
import os
import re
import subprocess
import sys
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
PROGRAM = '#include "tests/test.h"\n'


def built(folder: Path, tests: str) -> "subprocess.CompletedProcess[str]":
    """Builds a program of these C tests as every C test is built."""
    (folder / "CMakeLists.txt").write_text(PROJECT)
    (folder / "test_canary.c").write_text(PROGRAM + tests)
    configure = ["cmake", "-G", "Ninja", "-DOCTET_WERROR=ON", "-S", folder, "-B", folder / "build"]
    subprocess.run(configure, check=True, capture_output=True)
    return subprocess.run(["ninja", "-C", folder / "build"], check=False, capture_output=True, text=True)


def outcome(folder: Path, tests: str) -> tuple[bool, str]:
    """Builds a program of these C tests and has ctest run it: whether it passes, and what it prints."""
    built(folder, tests).check_returncode()
    command = ["ctest", "-V", "--test-dir", folder / "build"]
    ran = subprocess.run(command, check=False, capture_output=True, text=True)
    assert "1 tests failed" in ran.stdout or "0 tests failed" in ran.stdout, ran.stderr
    return ran.returncode == 0, ran.stdout


def test_c_tests_run_unlisted_in_the_order_of_their_lines(tmp_path):
    body = "{ TEST_ASSERT_TRUE(1); }"
    passed, said = outcome(tmp_path, f"TEST(b)\n{body}\nTEST(a)\n{body}\nTEST(c)\n{body}\n")

    assert passed
    assert re.findall(r"canary\.c:(\d+):(\w+):PASS", said) == [("2", "test_b"), ("4", "test_a"), ("6", "test_c")]


AROUND = """
static int up, down;
void setUp(void) { up++; }
void tearDown(void) { down++; }
TEST(a) { TEST_ASSERT_EQUAL(1, up); TEST_ASSERT_EQUAL(0, down); }
TEST(b) { TEST_ASSERT_EQUAL(2, up); TEST_ASSERT_EQUAL(1, down); }
"""
BELOW = """
static int up, first, second;
void setUp(void) { up++; }
TEST(a) { TEST_ASSERT_EQUAL(1, up); TEST_ASSERT_EQUAL(0, first); }
BEFORE_EACH(one) { first = up; }
TEST(b) { TEST_ASSERT_EQUAL(2, first); prepare_one(); }
TEST(c) { TEST_ASSERT_EQUAL(3, first); }
BEFORE_EACH(other) { second = up; }
TEST(d) { TEST_ASSERT_EQUAL(4, second); TEST_ASSERT_EQUAL(3, first); }
"""


@pytest.mark.parametrize("tests", [AROUND, BELOW], ids=["set-up around each", "BEFORE_EACH for those below it"])
def test_c_tests_are_prepared(tmp_path, tests):
    assert outcome(tmp_path, tests)[0]


@pytest.mark.parametrize(
    "tests",
    [
        pytest.param("TEST(a) { TEST_ASSERT_TRUE(0); }", id="that fails"),
        pytest.param("TEST(a) {}\nTEST(b) { TEST_ASSERT_TRUE(0); }\nTEST(c) {}", id="that fails among others"),
        pytest.param("BEFORE_EACH(one) { TEST_ASSERT_TRUE(0); }\nTEST(a) {}", id="whose preparation fails"),
        pytest.param("BEFORE_EACH(one) {}", id="that is only prepared"),
        pytest.param("TEST(a) { TEST_IGNORE(); }", id="that is ignored"),
        pytest.param('TEST(a) { TEST_IGNORE_MESSAGE("later"); }', id="that is ignored for a reason"),
        pytest.param("#include <stdlib.h>\nTEST(a) { exit(0); }\nTEST(b) {}", id="that ends the program"),
        pytest.param("", id="that is not there"),
        pytest.param("static bool never(void) { return false; }\nTEST_IF(a, never) {}", id="that never applies"),
    ],
)
def test_c_program_fails_if_a_test_fails_or_does_not_run(tmp_path, tests):
    assert not outcome(tmp_path, tests)[0]


@pytest.mark.parametrize(
    ("tests", "complaint"),
    [
        pytest.param("TEST(a) {}\nTEST(a) {}", "redefinition of .test_a.", id="two of one name"),
        pytest.param("TEST(a);", "test_a. (used|declared .static.) but never defined", id="one without a body"),
        pytest.param("static void test_a(void) {}", "test_a. defined but not used", id="one beside TEST"),
    ],
)
def test_malformed_c_test_does_not_compile(tmp_path, tests, complaint):
    result = built(tmp_path, tests)

    assert result.returncode != 0
    assert re.search(complaint, result.stdout)


def test_c_tests_are_not_added_with_add_test():
    adding = [path for path in sorted(ROOT.glob("tests/**/CMakeLists.txt")) if "add_test(NAME" in path.read_text()]

    assert adding == []


def test_c_tests_are_not_listed_by_hand():
    listing = [path for path in sorted(ROOT.glob("tests/**/*.c")) if "RUN_TEST(" in path.read_text()]

    assert listing == []


WARNS = f"""
cmake_minimum_required(VERSION 3.22)
project(canary LANGUAGES C)
include({ROOT}/tools/cmake/warnings.cmake)
add_library(canary STATIC canary.c)
target_link_libraries(canary PRIVATE octet_warnings)
"""


@pytest.mark.parametrize(("option", "succeeds"), [("-DOCTET_WERROR=ON", False), ("-DOCTET_WERROR=OFF", True)])
def test_compiler_warning_is_shown_and_an_error_only_on_request(tmp_path: Path, option: str, succeeds: bool) -> None:
    (tmp_path / "CMakeLists.txt").write_text(WARNS)
    (tmp_path / "canary.c").write_text("int undeclared(void) { return 0; }\n")
    subprocess.run(["cmake", "-G", "Ninja", "-S", tmp_path, "-B", tmp_path, option], check=True, capture_output=True)

    done = subprocess.run(["ninja", "-C", tmp_path], capture_output=True, text=True, check=False)

    assert (done.returncode == 0) == succeeds
    assert "-Wmissing-prototypes" in done.stdout


def test_preset_of_the_c_tests_has_warnings_as_errors() -> None:
    command = ["cmake", "--preset", "host-san", "-N"]
    listed = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout

    assert 'OCTET_WERROR="ON"' in listed


LEGACY_FPU = Path(__file__).resolve().parents[2] / "tools/legacy-fpu"
PTRACE_GETREGSET, NT_PRSTATUS, NT_X86_XSTATE = 0x4204, 1, 0x202
# There is no process 0: the kernel answers ESRCH to any request, unless the filter answers first.
ASK = """
import ctypes, sys
libc = ctypes.CDLL(None, use_errno=True)
libc.syscall(101, *map(int, sys.argv[1:]), None)
print(ctypes.get_errno())
"""


def error_of(request: int, kind: int, *launcher: str | Path) -> int:
    command = [*launcher, sys.executable, "-c", ASK, str(request), "0", str(kind)]
    return int(subprocess.run(command, capture_output=True, text=True, check=True).stdout)


@pytest.mark.parametrize(
    ("request_number", "kind", "error"),
    [
        (PTRACE_GETREGSET, NT_X86_XSTATE, errno.EINVAL),
        (PTRACE_GETREGSET, NT_PRSTATUS, errno.ESRCH),
        (PTRACE_GETREGSET + 1, NT_X86_XSTATE, errno.ESRCH),
    ],
)
def test_legacy_fpu_fails_only_reads_of_the_extended_state(request_number, kind, error):
    assert error_of(request_number, kind, LEGACY_FPU) == error


def test_kernel_answers_without_legacy_fpu():
    assert error_of(PTRACE_GETREGSET, NT_X86_XSTATE) == errno.ESRCH


def test_legacy_fpu_returns_the_exit_code_of_its_command():
    assert subprocess.run([LEGACY_FPU, "sh", "-c", "exit 7"], check=False).returncode == 7
