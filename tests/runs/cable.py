"""Serial lines for tests, made of ptys: a cable, with noise on the line if a test wants it, and an slcan adapter."""

import os
import pty
import random
import selectors
import threading
import tty
from contextlib import suppress
from pathlib import Path

from host_sim.protocol.codec import NODE_MAX


class Cable:
    """What goes into one end comes out of the other, but for the bytes that noise changes.

    Attributes:
        ends: The names of the two ttys.
        noise: Chance of each byte to be changed.
        passed: Number of bytes that have passed.
    """

    def __init__(self, noise: float = 0.0) -> None:
        pairs = [pty.openpty() for _ in range(2)]
        self.masters = [master for master, _ in pairs]
        self.slaves = [slave for _, slave in pairs]
        for slave in self.slaves:
            tty.setraw(slave)
        self.ends = [os.ttyname(slave) for slave in self.slaves]
        self.noise, self._dice = noise, random.Random(1)
        self.passed = 0
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
                text = os.read(here, 4096)
                self.passed += len(text)
                os.write(there, self._spoiled(text))
        selector.close()

    def _spoiled(self, text: bytes) -> bytes:
        if not self.noise:
            return text
        return bytes(self._dice.randrange(256) if self._dice.random() < self.noise else byte for byte in text)

    def close(self) -> None:
        """Unplugs it: whoever has an end open sees the line end."""
        os.write(self._stop_write, b".")
        self._thread.join()
        for fd in (*self.masters, *self.slaves, self._stop_read, self._stop_write):
            os.close(fd)


class Adapter:
    """An slcan adapter on a bus with robots. Each hears the frames of its node, as CAN controllers filter them.

    Attributes:
        host: Name of the tty where the adapter is plugged in.
        robots: Names of the robots' ttys, by node; they speak slcan too.
        orders: What the host told the adapter itself.
    """

    def __init__(self, *nodes: int) -> None:
        pairs = [pty.openpty() for _ in range(1 + len(nodes))]
        self._masters, self._slaves = (list(fds) for fds in zip(*pairs, strict=True))
        for slave in self._slaves:
            tty.setraw(slave)
        for master in self._masters:
            os.set_blocking(master, False)  # what nobody reads is lost
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
        frames = [line + b"\r" for line in lines if line.startswith(b"t")]
        if end == self._host:
            self.orders += [line for line in lines if line and not line.startswith(b"t")]
        for other in self._masters:
            if other != end:
                with suppress(BlockingIOError):
                    os.write(other, b"".join(frame for frame in frames if self._hears(other, frame)))

    def _hears(self, end: int, frame: bytes) -> bool:
        return end == self._host or int(frame[1:4], 16) & NODE_MAX == self._nodes[end]

    def close(self) -> None:
        """Unplugs it, and the robots too."""
        os.write(self._stop_write, b".")
        self._thread.join()
        for fd in (*self._masters, *self._slaves, self._stop_read, self._stop_write):
            os.close(fd)


class Socket:
    """A name for a tty that stays the same while cables are plugged in and out."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def plug(self, tty_name: str) -> None:
        """From now on the name leads to this tty."""
        fresh = self.path.with_suffix(".new")
        fresh.symlink_to(tty_name)
        fresh.replace(self.path)

    def unplug(self) -> None:
        """From now on the name leads nowhere."""
        self.path.unlink()
