"""A run on a real pseudo-terminal, and its keys.

A run drawn in plain characters of any size.
"""

import asyncio
import fcntl
import json
import os
import pty
import re
import select
import selectors
import signal
import struct
import subprocess
import sys
import termios
import time
from collections.abc import Callable
from contextlib import nullcontext
from dataclasses import replace
from pathlib import Path

import pytest

from host_sim.live import terminal_view
from host_sim.live.page_commands import FULL_SPEED, Play, WriteCell
from host_sim.live.terminal_view import faster, slower
from host_sim.live.text_picture import draw_text
from host_sim.recording.phrases import sentence
from host_sim.recording.state import states
from host_sim.recording.state_types import EnvironmentScene, State, Trial
from tests.live.support import order, play

DEADLINE_S = 600
WATCH = (sys.executable, "-m", "host_sim", "watch", "--terminal", "--seed", "3")
LEAVE_FULL_SCREEN = b"\x1b[?1049l"
CHANGED_TO_2 = b"\x1b[1;13H2"
"""Of "environment 1 of 5" in the first line, only the changed number is sent."""


def test_speed_goes_up_and_down_in_steps():
    assert [faster(1.0), faster(1000.0), faster(FULL_SPEED)] == [2.0, FULL_SPEED, FULL_SPEED]
    assert [slower(1.0), slower(0.25), slower(FULL_SPEED)] == [0.5, 0.25, 1000.0]


class Screen:
    """Counts how often it is drawn."""

    def __init__(self) -> None:
        self.drawn = 0

    def getmaxyx(self) -> tuple[int, int]:
        return 24, 80

    def refresh(self) -> None:
        self.drawn += 1

    def getch(self) -> int:
        return -1

    def nodelay(self, flag: bool) -> None:
        pass

    def erase(self) -> None:
        pass

    def addnstr(self, *_: object) -> None:
        pass


class PassingTime(selectors.SelectSelector):
    """A clock that jumps over every wait."""

    now = 0.0

    def select(self, timeout: float | None = None) -> list[tuple[selectors.SelectorKey, int]]:
        self.now += timeout or 0.0
        return super().select(0)


class Idle:
    """A run in which a second passes."""

    done = False

    async def play(self) -> None:
        await asyncio.sleep(1.0)

    def close(self) -> None:
        pass


def test_terminal_view_draws_at_most_ten_times_a_second(view, monkeypatch):
    monkeypatch.setattr(terminal_view, "_view", lambda _: view)
    monkeypatch.setattr(terminal_view, "on_ending_signals", lambda *_: nullcontext())
    screen = Screen()

    time = PassingTime()
    loop = asyncio.SelectorEventLoop(time)
    monkeypatch.setattr(loop, "time", lambda: time.now)

    loop.run_until_complete(terminal_view._show(Idle(), screen))
    loop.close()

    assert 10 <= screen.drawn <= 11


class Terminal:
    """`tools/octet watch --terminal` on a terminal of 80 x 24."""

    def __init__(self, out: Path, *words: str, term: str = "xterm") -> None:
        self._ours, self._theirs = pty.openpty()
        fcntl.ioctl(self._theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 80, 0, 0))
        self.before = termios.tcgetattr(self._theirs)
        self._process = subprocess.Popen(
            [*WATCH, "--out", os.fspath(out), *words],
            stdin=self._theirs,
            stdout=self._theirs,
            stderr=self._theirs,
            env={**os.environ, "TERM": term},
            start_new_session=True,
            preexec_fn=lambda: fcntl.ioctl(0, termios.TIOCSCTTY, 0),  # noqa: PLW1509 - so that Ctrl-C is a signal
        )
        self.output = b""

    def read_until(self, *wanted: bytes) -> None:
        give_up = time.monotonic() + DEADLINE_S
        while not all(text in self.output for text in wanted):
            assert time.monotonic() < give_up, self.output[-2000:]
            self._read()

    def press(self, keys: bytes) -> None:
        os.write(self._ours, keys)

    def signal(self, number: int) -> None:
        self._process.send_signal(number)

    def end(self) -> int:
        give_up = time.monotonic() + DEADLINE_S
        while self._process.poll() is None:
            assert time.monotonic() < give_up, self.output[-2000:]
            self._read()
        self._read()
        return self._process.returncode

    @property
    def after(self) -> list:
        return termios.tcgetattr(self._theirs)

    def close(self) -> None:
        self._process.kill()
        self._process.wait()
        os.close(self._ours)
        os.close(self._theirs)

    def _read(self) -> None:
        if select.select([self._ours], [], [], 0.05)[0]:
            self.output += os.read(self._ours, 65536)


@pytest.fixture
def terminal(tmp_path):
    """One that shows a run."""
    shown = Terminal(tmp_path)
    yield shown
    shown.close()


@pytest.mark.parametrize("leave", [b"q", b"\x03", "terminate"], ids=["q", "Ctrl-C", "terminate"])
def test_terminal_is_restored_when_the_run_ends(terminal, tmp_path, leave):
    terminal.read_until(b"environment 1 of 5", b"real time")

    if leave == "terminate":
        terminal.signal(signal.SIGTERM)
    else:
        terminal.press(leave)

    assert terminal.end() == 0
    assert LEAVE_FULL_SCREEN in terminal.output
    assert b"Traceback" not in terminal.output
    assert terminal.after == terminal.before
    assert {"run.log", "summary.json", "replay.html"} <= {path.name for path in tmp_path.iterdir()}


def test_keys_pause_begin_the_next_environment_and_quit(terminal, tmp_path):
    terminal.read_until(b"environment 1 of 5")
    terminal.press(b" ")
    terminal.read_until(b"paused")
    terminal.press(b"n")
    terminal.read_until(CHANGED_TO_2)
    terminal.press(b"q")

    assert terminal.end() == 0
    begun = json.loads((tmp_path / "run.world.json").read_text())["environments"]
    assert [environment["number"] for environment in begun] == [1, 2]


def test_keys_erase_freeze_lift_and_put_down_the_first_robot(live):
    run = live()

    def state() -> State:
        return states(run.simulation, run.recorder.histories)[0]

    def press_until(key: str, happened: Callable[[], bool]) -> None:
        terminal_view._press(run, ord(key))
        play(run, happened)
        assert happened()

    order(run, WriteCell(5, 1), Play(on=True))
    play(run, lambda: state()["memory"][5] == 1)
    press_until("f", lambda: state()["frozen"] == 1)
    press_until("e", lambda: not any(state()["memory"]))
    press_until("l", lambda: state()["lifted"] == 1)
    press_until("l", lambda: state()["lifted"] == 0)
    press_until("f", lambda: state()["frozen"] == 0)


@pytest.mark.parametrize("term", ["teletype-of-1930", "dumb"])
def test_terminal_that_cannot_draw_is_refused_in_one_line(tmp_path, term):
    terminal = Terminal(tmp_path, "--quiet", term=term)

    code = terminal.end()

    terminal.close()
    assert code == 2
    output = re.sub(rb"\x1b\[\d+m", b"", terminal.output)  # without its colours
    assert re.fullmatch(rb"octet: cannot draw in this terminal.*TERM.*\r\n", output)


def test_terminal_option_is_refused_without_a_terminal(tmp_path):
    command = [*WATCH, "--quiet", "--out", os.fspath(tmp_path)]

    done = subprocess.run(command, input="", capture_output=True, text=True, check=False)

    assert done.returncode == 2
    assert re.fullmatch(r"octet: --terminal needs a terminal.*\n", done.stderr)


@pytest.mark.parametrize(("columns", "rows"), [(60, 20), (80, 24), (100, 20), (60, 50), (250, 80)])
def test_text_picture_fits_a_screen_of_any_size(view, columns, rows):
    lines = draw_text(view, columns, rows)

    assert len(lines) <= rows
    assert max(map(len, lines)) <= columns
    assert all(line.isascii() for line in lines)


@pytest.mark.parametrize(("columns", "rows"), [(60, 20), (80, 24), (250, 80)])
def test_text_picture_shows_state_arena_legend_and_keys(view, columns, rows):
    lines = draw_text(view, columns, rows)
    text, arena = "\n".join(lines), "".join(line for line in lines if line.startswith("|"))

    assert "environment 1 of 1   eaten 0 of 3   0:03.4   1 x real time" in text
    assert sentence(view.state) in " ".join(text.split())
    assert "> .|/  -" in text
    assert (arena.count("@"), arena.count("O"), "#" in arena) == (1, 3, True)
    assert "@ robot   O food   x eaten   # obstacle" in text
    assert "q quits" in text


@pytest.mark.parametrize(("columns", "rows"), [(59, 24), (80, 19), (1, 1), (7, 3)])
def test_text_picture_names_the_least_size_on_a_screen_too_small(view, columns, rows):
    lines = draw_text(view, columns, rows)

    assert len(lines) <= rows
    assert max(map(len, lines)) <= columns
    assert re.match(r"\d", lines[0])


@pytest.mark.parametrize("columns", [60, 80])
def test_smallest_screen_names_all_keys(view, columns):
    lines = draw_text(replace(view, keys=terminal_view._KEYS), columns, 20)

    assert lines[-2:] == terminal_view._KEYS.splitlines()


@pytest.mark.parametrize(("helped", "said"), [(0, "It did not help, so I forgot it."), (1, "so I remembered it!")])
def test_text_picture_says_whether_a_trial_helped(view, helped, said):
    trial = Trial(tick=160, cell=7, side=1, helped=helped, frozen=0)
    lines = draw_text(replace(view, states=[{**view.state, "trial": trial}]), 60, 20)

    assert said in " ".join(" ".join(lines).split())
    assert len(lines) <= 20


@pytest.mark.parametrize(
    ("heading", "row", "column", "nose"),
    [
        (0, 0, 1, "-"),
        (785, 1, 1, "\\"),
        (1571, 1, 0, "|"),
        (2356, 1, -1, "/"),
        (-1571, -1, 0, "|"),
        (3141, 0, -1, "-"),
    ],
)
def test_nose_is_drawn_in_the_direction_of_the_heading(view, heading, row, column, nose):
    state = {**view.state, "x": 2000.0, "y": 1500.0, "heading": heading, "eaten": []}
    lines = draw_text(replace(view, states=[state], scene={**view.scene, "bars": [], "food": []}, trails=[]), 80, 24)

    at_row = next(i for i, line in enumerate(lines) if "@" in line)
    assert lines[at_row + row][lines[at_row].index("@") + column] == nose


def test_text_arena_has_the_proportions_of_the_world(view):
    lines = draw_text(view, 200, 60)

    width, height = lines[1].count("-"), sum(line.startswith("|") for line in lines)
    assert width / (2 * height) == pytest.approx(4 / 3, rel=0.05)


def test_text_picture_shows_plants_and_news(view):
    scene = EnvironmentScene(**view.scene, plants=[[0, 2000.0, 1500.0, 200.0]])

    lines = draw_text(replace(view, scene=scene, news="A plant was put down."), 100, 30)

    assert any("*" in line for line in lines)
    assert "A plant was put down." in lines
