"""A warning stops a developer's build, and is no more than that in the build of who only runs the robot."""

import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PROJECT = f"""
cmake_minimum_required(VERSION 3.22)
project(canary LANGUAGES C)
include({ROOT}/tools/cmake/warnings.cmake)
add_library(canary STATIC canary.c)
target_link_libraries(canary PRIVATE octet_warnings)
"""


@pytest.mark.parametrize(("option", "succeeds"), [("-DOCTET_WERROR=ON", False), ("-DOCTET_WERROR=OFF", True)])
def test_a_warning_is_shown_and_is_an_error_if_asked_for(tmp_path: Path, option: str, succeeds: bool) -> None:
    (tmp_path / "CMakeLists.txt").write_text(PROJECT)
    (tmp_path / "canary.c").write_text("int undeclared(void) { return 0; }\n")
    subprocess.run(["cmake", "-G", "Ninja", "-S", tmp_path, "-B", tmp_path, option], check=True, capture_output=True)

    done = subprocess.run(["ninja", "-C", tmp_path], capture_output=True, text=True, check=False)

    assert (done.returncode == 0) == succeeds
    assert "-Wmissing-prototypes" in done.stdout


def test_who_tests_by_hand_has_warnings_as_errors() -> None:
    command = ["cmake", "--preset", "host-san", "-N"]
    listed = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout

    assert 'OCTET_WERROR="ON"' in listed
