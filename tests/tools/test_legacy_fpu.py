"""tools/legacy-fpu hides the extended floating-point state from a tracer, and nothing else."""

import errno
import subprocess
import sys
from pathlib import Path

import pytest

LEGACY_FPU = Path(__file__).resolve().parents[2] / "tools/legacy-fpu"
PTRACE_GETREGSET, NT_PRSTATUS, NT_X86_XSTATE = 0x4204, 1, 0x202
# There is no process 0: the kernel says ESRCH to whatever is asked of it, where the filter does not answer first.
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
def test_only_reading_the_extended_state_fails(request_number, kind, error):
    assert error_of(request_number, kind, LEGACY_FPU) == error


def test_without_it_the_kernel_answers():
    assert error_of(PTRACE_GETREGSET, NT_X86_XSTATE) == errno.ESRCH


def test_the_exit_code_is_the_command_s():
    assert subprocess.run([LEGACY_FPU, "sh", "-c", "exit 7"], check=False).returncode == 7
