"""The sanitizers that the C tests are built with end a program that errs, and let a sound one be."""

import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent


def sanitizer_flags() -> list[str]:
    """What gcc builds the C tests with."""
    options = re.findall(r"add_compile_options\((.*)\)", (ROOT / "tools/cmake/sanitizers.cmake").read_text())
    return " ".join(options).split()


CRASHES = {
    "heap-buffer-overflow": "char *bytes = calloc(8, 1); int result = bytes[7 + argc]; free(bytes);",
    "heap-use-after-free": "char *bytes = malloc(8); free(bytes); int result = bytes[argc];",
    "signed integer overflow": "int result = INT_MAX; result += argc;",
    "shift exponent": "int result = 1 << (31 + argc);",
}


def run_sanitized(folder: Path, body: str) -> subprocess.CompletedProcess[str]:
    source = folder / "canary.c"
    source.write_text(
        "#include <limits.h>\n#include <stdlib.h>\n"
        f"int main(int argc, char *argv[]) {{ (void)argv; {body} return result == 42; }}\n"
    )
    program = folder / "canary"
    subprocess.run(["gcc", "-std=c99", *sanitizer_flags(), "-o", program, source], check=True)
    return subprocess.run([program], capture_output=True, text=True, check=False)


@pytest.mark.parametrize("error", CRASHES)
def test_the_sanitizers_end_a_program_that_errs(tmp_path, error):
    ended = run_sanitized(tmp_path, CRASHES[error])

    assert ended.returncode != 0
    assert error in ended.stderr


def test_the_sanitizers_let_a_sound_program_be(tmp_path):
    assert run_sanitized(tmp_path, "char *bytes = calloc(8, 1); int result = bytes[7]; free(bytes);").returncode == 0
