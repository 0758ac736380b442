"""Standard streams that are closed, full or read only in part; the progress line; what a run says of its files."""

import io
import os
import pty
import re
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path
from types import SimpleNamespace

import pytest

from host_sim.api import RunConfig, run
from host_sim.base.terminal import ProgressLine, counted, linked
from host_sim.lab.calibrate import calibration
from host_sim.report import animation
from tests.runs.support import octet, octet_process

RUN = ("run", "--environments", "1", "--limit-s", "2", "--bus", "fd", "--out")


def octet_with(streams: str, *arguments: str, **variables: str) -> subprocess.CompletedProcess[str]:
    """A command, with its streams as the shell's words say."""
    command = ["bash", "-c", f'"$0" -m host_sim "$@" {streams}', sys.executable, *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False, env={**os.environ, **variables})


@pytest.mark.parametrize("streams", ["2>&-", "<&- >&- 2>&-"])
def test_run_succeeds_with_closed_standard_streams(tmp_path, streams):
    done = octet_with(streams, *RUN, str(tmp_path))

    assert (done.returncode, done.stderr) == (0, "")
    assert octet_with("", "replay", str(tmp_path / "run.log")).returncode == 0


@pytest.mark.parametrize("arguments", [("dbc", "--node", "1"), ("--help",)])
def test_printing_command_reports_no_error_with_closed_standard_output(arguments):
    assert octet_with(">&-", *arguments).stderr == ""


@pytest.mark.parametrize("arguments", [("dbc", "--node", "1"), ("--version",), ("--help",), ("run", "--help")])
@pytest.mark.parametrize("unbuffered", ["1", ""])
def test_full_standard_output_is_reported_in_one_line(arguments, unbuffered):
    done = octet_with(">/dev/full", *arguments, PYTHONUNBUFFERED=unbuffered)

    assert done.returncode == 1
    assert done.stderr == "octet: cannot write to standard output: No space left on device\n"


def test_run_with_full_standard_output_keeps_its_files(tmp_path):
    done = octet_with(">/dev/full", *RUN, str(tmp_path), PYTHONUNBUFFERED="")

    assert done.returncode == 1
    assert done.stderr == "octet: cannot write to standard output: No space left on device\n"
    assert (tmp_path / "run.log").exists()


@pytest.mark.parametrize("unbuffered", ["1", ""])
def test_pipe_closed_by_its_reader_prints_no_error(unbuffered):
    assert octet_with("| head -1", "dbc", "--nodes", "1", PYTHONUNBUFFERED=unbuffered).stderr == ""


def test_run_finishes_when_the_reader_closes_the_pipe(tmp_path):
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
def test_progress_line_never_wraps(monkeypatch, columns, total):
    monkeypatch.setenv("COLUMNS", str(columns))
    terminal, line = begun(monkeypatch, total)

    for done in range(3):
        line.show("environment 1 of 5   eaten 0 of 3   memory LLRR....", done)

    shown = CONTROL.sub("\n", terminal.getvalue()).splitlines()
    assert max(map(len, shown)) <= columns
    assert "enviro" in "".join(shown)
    line.clear()
    assert terminal.getvalue().endswith("\x1b[2K")


def test_progress_line_is_due_at_intervals(monkeypatch):
    _, line = begun(monkeypatch)
    assert line.is_due()

    line.show("now")

    assert not line.is_due()


def test_progress_line_of_a_short_task_is_due_after_its_delay(monkeypatch):
    now_s = 5.0
    monkeypatch.setattr(time, "monotonic", lambda: now_s)
    begun(monkeypatch)
    line = ProgressLine(after_s=1.0)
    assert not line.is_due()

    now_s = 6.0

    assert line.is_due()


def test_drawing_an_animation_shows_its_progress(monkeypatch, tmp_path):
    trajectory = run(RunConfig(seed=1, environments=1, limit_s=2)).trajectory
    terminal, _ = begun(monkeypatch)
    monkeypatch.setattr(animation, "SOON_S", 0.0)

    monkeypatch.setenv("COLUMNS", "500")
    animation.write_gif(tmp_path / "a.gif", trajectory, animation.Clip(to_s=1.0))

    assert f" drawing {tmp_path / 'a.gif'}" in CONTROL.sub("", terminal.getvalue())


def test_calibration_shows_the_name_of_its_measurement(monkeypatch):
    values = iter([1, 0, 0])  # it measures, has ended, and refused nothing

    def command(name, **_):
        return SimpleNamespace(signals={"value": next(values)}) if name == "get" else None

    dialogue = SimpleNamespace(command=command)
    terminal, _ = begun(monkeypatch)
    monkeypatch.setattr(calibration, "SOON_S", 0.0)

    why = calibration.Calibration(SimpleNamespace(node=1, dialogue=dialogue), lambda _: None).measure("light")

    assert why == ""
    assert "light: measuring" in terminal.getvalue()


def test_counted_yields_items_and_shows_progress(monkeypatch):
    terminal, _ = begun(monkeypatch)

    assert list(counted(iter("abc"), 3, "letters")) == ["a", "b", "c"]

    assert "1/3 letters" in CONTROL.sub("", terminal.getvalue())


def test_run_prints_no_progress_line_without_a_terminal(tmp_path):
    done = octet_process("run", "--bus", "none", "--environments", "1", "--limit-s", "2", "--out", tmp_path)

    assert (done.returncode, done.stderr) == (0, "")


def test_run_prints_next_steps_with_the_path_of_its_log(tmp_path):
    done = octet("run", "--bus", "none", "--environments", "1", "--limit-s", "1", "--out", tmp_path)

    (line,) = [line for line in done.stdout.splitlines() if line.startswith("next ")]
    assert "open replay.html in a browser" in line
    words = line.partition("tools/octet ")[2].partition(";")[0].split()
    assert words == ["talk", "--log", str(tmp_path / "run.log")]


@pytest.mark.parametrize(
    ("term", "link"), [("xterm-256color", "\x1b]8;;file:///a/b\x1b\\/a/b\x1b]8;;\x1b\\"), ("dumb", ""), ("linux", "")]
)
def test_file_is_printed_as_a_link_if_the_terminal_supports_links(monkeypatch, term, link):
    monkeypatch.setattr(sys.stdout, "isatty", lambda: True)
    monkeypatch.setenv("TERM", term)

    assert linked(Path("/a/b")) == (link or "/a/b")


def on_a_terminal(*arguments: str, **variables: str) -> tuple[int, str]:
    """The exit code of a command on a pseudo-terminal, and what it prints there."""
    primary, secondary = pty.openpty()
    command = [sys.executable, "-m", "host_sim", *arguments]
    environment = {name: value for name, value in os.environ.items() if name != "NO_COLOR"}
    environment |= {"TERM": "xterm", "COLUMNS": "200", **variables}
    process = subprocess.Popen(command, stdin=secondary, stdout=secondary, stderr=secondary, env=environment)
    os.close(secondary)
    shown = b""
    with suppress(OSError):  # Linux says EIO once the command has closed its end
        while part := os.read(primary, 65536):
            shown += part
    os.close(primary)
    return process.wait(), shown.decode().replace("\r\n", "\n")


WRONG = ("run", "--robots", "0")


def test_error_is_red_on_a_terminal_and_plain_in_a_pipe():
    plain = octet_with("", *WRONG, TERM="xterm")

    assert on_a_terminal(*WRONG) == (plain.returncode, plain.stderr.replace("octet:", "\x1b[31moctet:\x1b[39m", 1))
    assert "\x1b" not in plain.stderr


@pytest.mark.parametrize("variables", [{"NO_COLOR": "1"}, {"TERM": "dumb"}])
def test_error_is_plain_with_no_color_or_a_dumb_terminal(variables):
    assert on_a_terminal(*WRONG, **variables)[1] == octet_with("", *WRONG).stderr


def test_error_stays_red_with_an_empty_no_color():
    assert "\x1b[31m" in on_a_terminal(*WRONG, NO_COLOR="")[1]
