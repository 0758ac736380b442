"""A serial line for tests: two ptys whose masters are joined, with noise on the line if a test wants it."""

import os
import pty
import random
import selectors
import threading
import tty
from pathlib import Path


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
