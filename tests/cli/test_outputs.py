"""What a run says of its files at its end."""

import sys
from pathlib import Path

import pytest

from host_sim.cli.outputs import _linked
from tests.runs.support import octet


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
