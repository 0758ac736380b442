"""`tools/octet calibrate` of a robot at the far end of a serial line: the image for a Pico's pins, in rp2040js."""

import os
import pty
import select
import threading
import time
import tty
from collections.abc import Iterator

import pytest

from host_sim.base.paths import image_path
from host_sim.sim.pico import SteppedPico
from host_sim.sim.pico_pins import PicoParts
from host_sim.transport.slcan_link import decode, encode
from tests.runs.support import octet

_BEAT_US = 5100


class SerialLine:
    """A Pico on its pins at the far end of a pseudo-terminal, in real time."""

    def __init__(self) -> None:
        self._ours, theirs = pty.openpty()
        tty.setraw(theirs)
        self.name = os.ttyname(theirs)
        self._parts = PicoParts()
        self._pico = SteppedPico(image_path("pico", "pins").with_suffix(".bin"))
        self._rest, self._ends = b"", False
        self._thread = threading.Thread(target=self._run)
        self._thread.start()

    def close(self) -> None:
        self._ends = True
        self._thread.join()
        self._pico.close()

    def _run(self) -> None:
        now_s = time.monotonic()
        while not self._ends:
            self._hear()
            orders, self._parts.orders = [*self._parts.orders, f"beat {_BEAT_US}"], []
            passed_ns, *shares = self._pico.order(*orders)[-1].split()
            self._parts.shares = [float(share) for share in shares]
            self._parts.beat()
            os.write(self._ours, b"".join(map(encode, self._pico.said)))
            self._pico.said.clear()
            now_s += int(passed_ns) / 1e9
            time.sleep(max(now_s - time.monotonic(), 0.0))

    def _hear(self) -> None:
        if select.select([self._ours], [], [], 0)[0]:
            *lines, self._rest = (self._rest + os.read(self._ours, 4096)).split(b"\r")
            for frame in filter(None, map(decode, lines)):
                self._pico.send(frame)


@pytest.fixture
def bus() -> Iterator[str]:
    line = SerialLine()
    yield f"slcan:{line.name}"
    line.close()


def test_calibrate_works_with_a_robot_that_sends_its_own_senses(bus):
    stored = octet("calibrate", "--set", "body_track_mm=163", "--bus", bus)
    shown = octet("calibrate", "--show", "--bus", bus)

    assert (stored.returncode, stored.stderr, shown.returncode, shown.stderr) == (0, "", 0, "")
    assert "body_track_mm" in shown.stdout
    assert next(line for line in shown.stdout.splitlines() if "body_track_mm" in line).split()[1:3] == ["163", "163"]
