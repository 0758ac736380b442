"""gdb-multiarch, which nobody here wrote, on the image in QEMU: the world waits for it."""

import json

from tests.runs.support import octet_process

OPTIONS = ("--robot", "qemu", "--environments", "1", "--quiet", "--limit-s")


def test_a_run_waits_while_the_image_stands_at_a_breakpoint(tmp_path):
    words = "delete\nbreak brain_next\ncontinue\nshell sleep 6\nbacktrace\ndelete\ncontinue\n"

    done = octet_process("run", *OPTIONS, "4", "--gdb", "--out", tmp_path, input=words)

    assert done.returncode == 0, done.stdout + done.stderr
    assert "caution_next" in done.stdout
    (robot,) = json.loads((tmp_path / "summary.json").read_text())["robots"]
    assert robot["frames"]["lost"] == 0


def test_who_kills_the_image_in_the_debugger_ends_the_run(tmp_path):
    done = octet_process("run", *OPTIONS, "600", "--gdb", "--out", tmp_path, input="continue\nkill\nquit\n")

    assert done.returncode == 1
    assert "the debugger was left before the run had ended" in done.stderr
