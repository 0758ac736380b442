"""An emulated slcan adapter, made of ptys, on a bus with robots."""

import os
import pty
import selectors
import threading
import time
import tty
from collections.abc import Callable
from contextlib import suppress

from host_sim.transport.link import Frame
from host_sim.transport.slcan_link import decode, encode

_RESTART_S = 2.0


class Adapter:
    """An slcan adapter on a bus with robots. Each hears the frames of its node, as CAN controllers filter them.

    Attributes:
        host: Name of the tty where the adapter is plugged in.
        robots: Names of the robots' ttys, by node; they speak slcan too.
        orders: Commands from the host to the adapter itself.
    """

    def __init__(self, *nodes: int, node_of: Callable[[int], int], habit: str = "") -> None:
        """Starts the adapter.

        Args:
            *nodes: The robots on its bus.
            node_of: The node that an identifier belongs to.
            habit: What real adapters do: `crlf`, `stamps`, `echoes`, `restarts` when its port is opened, for 2 s, or
                `refuses` to open the bus. Any but the first says BELL to what it does not know.
        """
        self._node_of, self._habit = node_of, habit
        self._is_open, self._restarted_s = not habit, 0.0
        pairs = [pty.openpty() for _ in range(1 + len(nodes))]
        self._masters, self._slaves = (list(fds) for fds in zip(*pairs, strict=True))
        for slave in self._slaves:
            tty.setraw(slave)
        for master in self._masters:
            os.set_blocking(master, False)  # what is not read is lost
        self.host, *robots = (os.ttyname(slave) for slave in self._slaves)
        self.robots = dict(zip(nodes, robots, strict=True))
        self._host, *others = self._masters
        self._nodes = dict(zip(others, nodes, strict=True))
        self.orders: list[bytes] = []
        self._rests = dict.fromkeys(self._masters, b"")
        self._stop_read, self._stop_write = os.pipe()
        self._thread = threading.Thread(target=self._pump)
        self._thread.start()

    def _pump(self) -> None:
        with selectors.DefaultSelector() as selector:
            for fd in (*self._masters, self._stop_read):
                selector.register(fd, selectors.EVENT_READ)
            while self._stop_read not in (ready := [key.fd for key, _ in selector.select()]):
                for fd in ready:
                    self._take(fd)

    def _take(self, end: int) -> None:
        *lines, self._rests[end] = (self._rests[end] + os.read(end, 4096)).split(b"\r")
        frames = [frame for frame in map(decode, lines) if frame is not None]
        if end == self._host:
            orders = [line for line in lines if line and not line.startswith(b"t")]
            self.orders += orders
            if self._habit:
                self._obey(orders)
                frames = self._passed_on(frames)
        for other in self._masters:
            if other != end:
                with suppress(BlockingIOError):
                    os.write(
                        other, b"".join(self._line(other, frame) for frame in frames if self._hears(other, frame))
                    )

    def _obey(self, orders: list[bytes]) -> None:
        """Opens the bus or not, and says so."""
        if self._habit == "restarts":
            self._restarted_s = self._restarted_s or time.monotonic()
            if time.monotonic() < self._restarted_s + _RESTART_S:
                return
        for order in orders:
            is_done = order[:1] in (b"S", b"O", b"C") and self._habit != "refuses"
            self._is_open = is_done and order == b"O"
            os.write(self._host, b"\r" if is_done else b"\a")

    def _passed_on(self, frames: list[Frame]) -> list[Frame]:
        """What of the host's frames goes onto the bus."""
        if self._habit == "echoes":
            os.write(self._host, b"".join(map(encode, frames)))
        return frames if self._is_open else []

    def _line(self, end: int, frame: Frame) -> bytes:
        """A frame as an end hears it."""
        line = encode(frame)
        if end != self._host or not self._habit:
            return line
        if self._habit == "stamps":
            line = line[:-1] + b"%04X\r" % (time.monotonic_ns() // 10**6 % 60_000)
        return line[:-1] + b"\r\n" if self._habit == "crlf" else line

    def _hears(self, end: int, frame: Frame) -> bool:
        if end == self._host:
            return self._is_open
        return bool(self._node_of(frame.id) == self._nodes[end])

    def close(self) -> None:
        """Unplugs it, and the robots too."""
        os.write(self._stop_write, b".")
        self._thread.join()
        for fd in (*self._masters, *self._slaves, self._stop_read, self._stop_write):
            os.close(fd)
