"""Whole runs, each in a folder of its own."""

import subprocess
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest

from tests.runs.support import Run, assert_healthy, octet, octet_process, robot_at


@pytest.fixture
def run(tmp_path: Path, request: pytest.FixtureRequest) -> Iterator[Callable[..., Run]]:
    """Does a run into a folder of its own; after the test, not a frame may have been lost or refused in any.

    With `process=True` it is a process of its own, and draws its picture.
    """
    done: list[Run] = []

    def start(*words: str | Path, process: bool = False) -> Run:
        out = tmp_path / f"out{len(done) + 1}"
        ended = (octet_process if process else octet)("run", "--out", out, *words)
        done.append(Run(ended.returncode, ended.stdout, ended.stderr, out))
        return done[-1]

    yield start
    if request.node.get_closest_marker("faulty") is None:
        for ended in done:
            if ended.code == 0:
                assert_healthy(ended.summary)


@pytest.fixture
def robot_on() -> Iterator[Callable[[str], subprocess.Popen]]:
    """Starts robots on links; they end with the test."""
    with ExitStack() as stack:
        yield lambda link: stack.enter_context(robot_at(link))
