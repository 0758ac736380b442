"""The progress line: on terminals of any width, and gone in the end."""

import io
import re
import sys

import pytest

from host_sim.cli.progress_line import ProgressLine
from tests.runs.support import octet_process

CONTROL = re.compile(r"\x1b\[[?0-9;]*[A-Za-z]|\r")


class Terminal(io.StringIO):
    """What is written to a terminal."""

    def isatty(self) -> bool:
        return True


def begun(monkeypatch, total: int | None = None) -> tuple[Terminal, ProgressLine]:
    """A terminal, and a line there."""
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setattr(sys, "stderr", Terminal())
    return sys.stderr, ProgressLine(total)


@pytest.mark.parametrize("total", [None, 7])
@pytest.mark.parametrize("columns", [20, 200])
def test_the_line_never_wraps(monkeypatch, columns, total):
    monkeypatch.setenv("COLUMNS", str(columns))
    terminal, line = begun(monkeypatch, total)

    for done in range(3):
        line.show("environment 1 of 5   food 0 of 3   memory LLRR....", done)

    shown = CONTROL.sub("\n", terminal.getvalue()).splitlines()
    assert max(map(len, shown)) <= columns
    assert "enviro" in "".join(shown)
    line.clear()
    assert terminal.getvalue().endswith("\x1b[2K")


def test_it_is_due_now_and_then(monkeypatch):
    _, line = begun(monkeypatch)
    assert line.is_due()

    line.show("now")

    assert not line.is_due()


def test_without_a_terminal_there_is_none(tmp_path):
    done = octet_process("run", "--bus", "none", "--environments", "1", "--limit-s", "2", "--out", tmp_path)

    assert (done.returncode, done.stderr) == (0, "")
