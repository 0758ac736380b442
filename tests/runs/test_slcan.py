"""A robot behind a serial line: slcan text through two ptys, with python-can's own slcan on our side."""

import os
import pty
import selectors
import subprocess
import threading
import tty

import pytest

from tests.runs.support import ROBOT, octet


class Cable:
    """Two ptys whose masters are joined: what goes into one comes out of the other."""

    def __init__(self) -> None:
        pairs = [pty.openpty() for _ in range(2)]
        self.masters = [master for master, _ in pairs]
        self.slaves = [slave for _, slave in pairs]
        for slave in self.slaves:
            tty.setraw(slave)
        self.ends = [os.ttyname(slave) for slave in self.slaves]
        self._stop_read, self._stop_write = os.pipe()
        self._thread = threading.Thread(target=self._pump)
        self._thread.start()

    def _pump(self) -> None:
        selector = selectors.DefaultSelector()
        for here, there in (self.masters, self.masters[::-1]):
            selector.register(here, selectors.EVENT_READ, there)
        selector.register(self._stop_read, selectors.EVENT_READ, None)
        while self._stop_read not in (ready := {key.fd: key.data for key, _ in selector.select()}):
            for here, there in ready.items():
                os.write(there, os.read(here, 4096))
        selector.close()

    def close(self) -> None:
        os.write(self._stop_write, b".")
        self._thread.join()
        for fd in (*self.masters, *self.slaves, self._stop_read, self._stop_write):
            os.close(fd)


@pytest.fixture
def serial_robot():
    """The name of the tty that leads to a robot which is already there."""
    cable = Cable()
    robot = subprocess.Popen([os.fspath(ROBOT), f"slcan:{cable.ends[0]}"], stdout=subprocess.PIPE)
    assert b"listens" in robot.stdout.readline()
    yield cable.ends[1]
    robot.kill()
    robot.communicate()
    cable.close()


def test_over_slcan_a_run_leaves_the_same_bytes(run, serial_robot):
    words = ("--environments", "1", "--limit-s", "20")

    over_slcan = run(*words, "--bus", f"slcan:{serial_robot}", "--robot", "external")
    within = run(*words, "--bus", "none")

    assert (over_slcan.code, over_slcan.errors) == (0, "")
    assert over_slcan.log == within.log
    assert octet("replay", over_slcan.out / "run.log").returncode == 0


def test_an_external_robot_can_be_run_again_and_keeps_its_memory(run, serial_robot):
    words = ("--environments", "1", "--limit-s", "40", "--bus", f"slcan:{serial_robot}", "--robot", "external")

    first, second = run(*words), run(*words)

    assert any(first.memory)
    assert (second.code, second.errors) == (0, "")
    kept = zip(first.memory, second.memory, strict=True)
    assert all(now == before for before, now in kept if before)
    assert octet("replay", second.out / "run.log").returncode == 0
