"""An emulated slcan adapter, made of ptys, on a bus with robots."""

import os
import pty
import selectors
import threading
import tty
from collections.abc import Callable
from contextlib import suppress

from host_sim.base.frame import Frame
from host_sim.transport.slcan_link import decode, encode


class Adapter:
    """An slcan adapter on a bus with robots. Each hears the frames of its node, as CAN controllers filter them.

    Attributes:
        host: Name of the tty where the adapter is plugged in.
        robots: Names of the robots' ttys, by node; they speak slcan too.
        orders: Commands from the host to the adapter itself.
    """

    def __init__(self, *nodes: int, node_of: Callable[[int], int]) -> None:
        """Starts the adapter.

        Args:
            *nodes: The robots on its bus.
            node_of: The node that an identifier belongs to.
        """
        self._node_of = node_of
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
            self.orders += [line for line in lines if line and not line.startswith(b"t")]
        for other in self._masters:
            if other != end:
                with suppress(BlockingIOError):
                    os.write(other, b"".join(encode(frame) for frame in frames if self._hears(other, frame)))

    def _hears(self, end: int, frame: Frame) -> bool:
        return end == self._host or bool(self._node_of(frame.id) == self._nodes[end])

    def close(self) -> None:
        """Unplugs it, and the robots too."""
        os.write(self._stop_write, b".")
        self._thread.join()
        for fd in (*self._masters, *self._slaves, self._stop_read, self._stop_write):
            os.close(fd)
