"""A standard stream that is closed, full or read only in part ends no command with a traceback, and loses no file."""

import os
import subprocess
import sys

import pytest

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


@pytest.mark.parametrize("arguments", [("load",), ("--help",)])
def test_a_command_that_prints_needs_no_standard_output(arguments):
    assert octet_with(">&-", *arguments).stderr == ""


@pytest.mark.parametrize("arguments", [("load",), ("dbc", "--node", "1")])
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
    assert octet_with("| head -1", "load", PYTHONUNBUFFERED=unbuffered).stderr == ""
