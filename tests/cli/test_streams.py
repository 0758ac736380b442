"""Standard streams that are closed, full or read only in part; the progress line; what a run says of its files."""

import io
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from host_sim.base.progress_line import ProgressLine
from host_sim.cli.outputs import _linked
from tests.runs.support import octet, octet_process

RUN = ("run", "--environments", "1", "--limit-s", "2", "--bus", "fd", "--out")


def octet_with(streams: str, *arguments: str, **variables: str) -> subprocess.CompletedProcess[str]:
    """A command, with its streams as the shell's words say."""
    command = ["bash", "-c", f'"$0" -m host_sim "$@" {streams}', sys.executable, *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False, env={**os.environ, **variables})


@pytest.mark.parametrize("streams", ["2>&-", "<&- >&- 2>&-"])
def test_a_run_needs_no_standard_stream(tmp_path, streams):
    done = octet_with(streams, *RUN, str(tmp_path))

    assert (done.returncode, done.stderr) == (0, "")
    assert octet_with("", "replay", str(tmp_path / "run.log")).returncode == 0


@pytest.mark.parametrize("arguments", [("dbc", "--node", "1"), ("--help",)])
def test_a_command_that_prints_needs_no_standard_output(arguments):
    assert octet_with(">&-", *arguments).stderr == ""


@pytest.mark.parametrize("arguments", [("dbc", "--node", "1"), ("--version",), ("--help",), ("run", "--help")])
@pytest.mark.parametrize("unbuffered", ["1", ""])
def test_a_full_output_is_an_error_in_one_line(arguments, unbuffered):
    done = octet_with(">/dev/full", *arguments, PYTHONUNBUFFERED=unbuffered)

    assert done.returncode == 1
    assert done.stderr == "octet: cannot write to standard output: No space left on device\n"


def test_a_run_whose_output_is_full_leaves_its_files(tmp_path):
    done = octet_with(">/dev/full", *RUN, str(tmp_path), PYTHONUNBUFFERED="")

    assert done.returncode == 1
    assert done.stderr == "octet: cannot write to standard output: No space left on device\n"
    assert (tmp_path / "run.log").exists()


@pytest.mark.parametrize("unbuffered", ["1", ""])
def test_a_reader_who_closes_the_pipe_is_no_error_worth_a_word(unbuffered):
    assert octet_with("| head -1", "dbc", "--nodes", "1", PYTHONUNBUFFERED=unbuffered).stderr == ""


def test_a_run_whose_reader_has_read_enough_is_done(tmp_path):
    done = octet_with("| head -1; exit ${PIPESTATUS[0]}", *RUN, str(tmp_path), PYTHONUNBUFFERED="")

    assert (done.returncode, done.stderr) == (0, "")
    assert (tmp_path / "replay.html").exists()


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
        line.show("environment 1 of 5   eaten 0 of 3   memory LLRR....", done)

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


def test_a_run_says_what_to_do_with_it_next(tmp_path):
    done = octet("run", "--bus", "none", "--environments", "1", "--limit-s", "1", "--out", tmp_path)

    (line,) = [line for line in done.stdout.splitlines() if line.startswith("next ")]
    assert "open replay.html in a browser" in line
    words = line.partition("tools/octet ")[2].partition(";")[0].split()
    assert words == ["talk", "--log", str(tmp_path / "run.log")]


@pytest.mark.parametrize(
    ("term", "link"), [("xterm-256color", "\x1b]8;;file:///a/b\x1b\\/a/b\x1b]8;;\x1b\\"), ("dumb", ""), ("linux", "")]
)
def test_a_file_is_a_link_where_the_terminal_may_know_links(monkeypatch, term, link):
    monkeypatch.setattr(sys.stdout, "isatty", lambda: True)
    monkeypatch.setenv("TERM", term)

    assert _linked(Path("/a/b")) == (link or "/a/b")
