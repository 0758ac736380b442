"""`tools/octet watch --robot observe`: looks on while a robot runs by itself, on a bus within this process."""

import contextlib
import io
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import can
import pytest
from can.interfaces import virtual

from host_sim.api import run
from host_sim.base.errors import OctetError
from host_sim.cli.main import main
from host_sim.client.frame_log import NoLog
from host_sim.live import observer as observer_module
from host_sim.live.observer import Line, Observer, observe
from host_sim.live.text_picture import draw_text
from host_sim.recording import run_recorder
from host_sim.recording.log_reader import Recorded, read_log
from host_sim.sim.run_config import RunConfig

SECONDS = 4.0
LISTENS_S = 20.0
"""At the latest."""


@pytest.fixture(scope="module")
def recorded(tmp_path_factory) -> list[Recorded]:
    """What a robot and its body say in a run in which it learns."""
    log = tmp_path_factory.mktemp("run") / "run.log"
    run(RunConfig(seed=6, environments=1, limit_s=SECONDS), log)
    return list(read_log(log))


@contextlib.contextmanager
def spoken(recorded: list[Recorded], channel: str) -> Iterator[list[can.Message]]:
    """They say it on a virtual bus, once somebody listens; what else is said there is collected."""
    heard: list[can.Message] = []

    def speak() -> None:
        with can.Bus(interface="virtual", channel=channel) as bus:
            deadline = time.monotonic() + LISTENS_S
            while len(virtual.channels[channel]) < 2 and time.monotonic() < deadline:
                time.sleep(0.01)
            for time_us, frame in recorded:
                stamp = 1000.0 + time_us / 1e6
                bus.send(can.Message(stamp, frame.id, is_extended_id=False, data=frame.data))
            time.sleep(0.3)
            while (message := bus.recv(0.0)) is not None:
                heard.append(message)

    thread = threading.Thread(target=speak)
    thread.start()
    yield heard
    thread.join()


def test_observer_describes_the_robot_sends_nothing_and_logs_each_frame(recorded, tmp_path, capsys):
    with spoken(recorded, "observed") as heard:
        words = ["watch", "--bus", "virtual:observed", "--robot", "observe", "--limit-s", "1.5"]
        assert main([*words, "--out", str(tmp_path)]) == 0
    said = capsys.readouterr().out
    assert "I do not know what helps yet, so I try turning" in said
    assert heard == []
    assert [line.frame for line in read_log(tmp_path / "observed.log")] == [line.frame for line in recorded]
    assert main(["replay", str(tmp_path / "observed.log")]) == 0
    assert all((tmp_path / name).stat().st_size > 1000 for name in ("observed.html", "observed.png"))


@pytest.mark.parametrize(
    "words",
    [
        *("--profile mine.c", "--profile never", "--set step_mm=9", "--memory a.mem", "--fault drop:1%", "--quiet"),
        *("--seed 2", "--environments 1", "--change plant@1s", "--robots 1 --owner 3", "--compress-log", "--port 9"),
        *("--body kit", "--world small", "--physics fast", "--reconnect-s 3", "--late-max 9", "--json"),
    ],
)
def test_observer_refuses_an_option_that_it_does_not_use_in_one_line(words, capsys):
    command = ["watch", "--bus", "virtual:observed", "--robot", "observe", *words.split()]

    assert main(command) == 2

    flag = next(word for word in reversed(words.split()) if word.startswith("--"))
    assert capsys.readouterr().err.endswith(f"leave {flag} out\n")


def test_observer_keeps_only_the_last_ticks(recorded, monkeypatch):
    monkeypatch.setattr(run_recorder, "TICKS_MAX", 60)
    monkeypatch.setattr(observer_module, "_PART_TICKS", 10)
    observer = Observer(1)
    *_, state = observer.follow(line.frame for line in recorded)

    (trail,) = observer.view(state).trails
    assert 60 <= len(trail) <= 60 + 60 // 8 + 2 * 10


def test_observer_view_has_the_robot_in_the_middle_and_its_trail(recorded):
    observer = Observer(1)
    *_, state = observer.follow(line.frame for line in recorded)
    view = observer.view(state)
    assert state["tick"] == round(SECONDS / 0.02) - 1
    assert len(view.trails[0]) == state["tick"] + 1
    assert view.trails[0][-1] == pytest.approx((view.params.width_mm / 2, view.params.height_mm / 2))
    assert any("Ctrl-C ends it" in line for line in draw_text(view, 80, 24))


def test_observer_draws_on_a_terminal_and_restores_it(recorded):
    class Terminal(io.StringIO):
        def isatty(self) -> bool:
            return True

    out, end = Terminal(), time.monotonic() + 1.0
    with spoken(recorded, "terminal"), contextlib.closing(NoLog()) as log:
        observe(Line("virtual:terminal", 1, 500_000), log, out, lambda: time.monotonic() < end)
    assert "senses" in out.getvalue()
    assert out.getvalue().endswith("\x1b[?25h\x1b[?1049l")


def test_observer_skips_a_malformed_frame_on_a_serial_line(recorded, monkeypatch):
    class SerialLine(contextlib.AbstractContextManager):
        def __init__(self) -> None:
            self.said = iter(recorded)
            self.looks = 0

        def __exit__(self, *_: object) -> None:
            pass

        def recv(self, _timeout_s: float) -> can.Message:
            self.looks += 1
            if self.looks == 10:
                raise ValueError("invalid literal for int() with base 16: 'tx'")
            time_us, frame = next(self.said)
            return can.Message(time_us / 1e6, frame.id, is_extended_id=False, data=frame.data)

    line, out = SerialLine(), io.StringIO()
    monkeypatch.setattr("host_sim.live.observer.open_bus", lambda *_: line)

    with contextlib.closing(NoLog()) as log:
        observe(Line("slcan:/dev/ttyACM0", 1, 500_000), log, out, lambda: line.looks < len(recorded))
    assert "so I try turning" in out.getvalue()


def test_observer_fails_if_its_node_is_not_heard(recorded):
    end, line = time.monotonic() + 0.7, Line("virtual:other", 2, 500_000)
    why = pytest.raises(OctetError, match="node 2 was not heard on virtual:other")
    with spoken(recorded, "other"), contextlib.closing(NoLog()) as log, why:
        observe(line, log, io.StringIO(), lambda: time.monotonic() < end)


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (["watch", "--robot", "observe"], "--robot observe needs the bus of the robot, --bus INTERFACE:CHANNEL"),
        (["run", "--robot", "observe", "--bus", "virtual:x"], "tools/octet watch --bus BUS --robot observe"),
        (["watch", "--robot", "observe", "--bus", "virtual:x", "--robots", "2"], "one robot"),
    ],
)
def test_observer_refuses_no_bus_the_run_command_and_two_robots(words: list[str], why: str, tmp_path: Path, capsys):
    assert main([*words, "--out", str(tmp_path)]) == 2
    said = capsys.readouterr().err
    assert why in said
    assert said.count("\n") == 1
