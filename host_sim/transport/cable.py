"""Emulated serial lines made of ptys: a cable with noise that can be unplugged."""

import os
import pty
import random
import select
import threading
import tty
from contextlib import suppress
from pathlib import Path

_END, _UNPLUG, _PLUG = b".", b"u", b"p"
_GONE = -1
_ORDER_S = 10.0


class Cable:
    """A cable: what goes into one end comes out of the other, except for bytes changed by noise.

    Attributes:
        ends: The names of the two ttys.
        noise: Chance of each byte to be changed.
        passed: Number of bytes that have passed.
    """

    def __init__(self) -> None:
        self._masters, self._slaves, self.ends = [_GONE] * 2, [_GONE] * 2, [""] * 2
        for end in range(2):
            self._open(end)
        self.noise, self._dice = 0.0, random.Random(1)
        self.passed = 0
        self._told, self._tell = os.pipe()
        self._done = threading.Event()
        self._thread = threading.Thread(target=self._pump, daemon=True)
        self._thread.start()

    def unplug(self) -> None:
        """Unplugs the second end: a program that has it open sees the end; data from the first end is lost."""
        self._order(_UNPLUG)

    def plug(self) -> None:
        """Plugs the second end in again, as another tty."""
        self._order(_PLUG)

    def close(self) -> None:
        """Unplugs it: programs that have an end open see the line end."""
        os.write(self._tell, _END)
        self._thread.join()
        for fd in (*self._masters, *self._slaves, self._told, self._tell):
            if fd != _GONE:
                os.close(fd)

    def _open(self, end: int) -> None:
        self._masters[end], self._slaves[end] = pty.openpty()
        os.set_blocking(self._masters[end], False)  # what is not read is lost
        tty.setraw(self._slaves[end])
        self.ends[end] = os.ttyname(self._slaves[end])

    def _order(self, order: bytes) -> None:
        self._done.clear()
        os.write(self._tell, order)
        if not self._done.wait(_ORDER_S):
            raise OSError("the cable's thread has ended, or is another process's")

    def _pump(self) -> None:
        order = b""
        while order != _END:
            here = [fd for fd in (self._told, *self._masters) if fd != _GONE]
            ready = select.select(here, [], [])[0]
            if self._told in ready:
                order = os.read(self._told, 1)
                self._obey(order)
                continue
            for fd in ready:
                self._pass(fd)

    def _pass(self, fd: int) -> None:
        text = os.read(fd, 4096)
        self.passed += len(text)
        there = self._masters[1 - self._masters.index(fd)]
        if there != _GONE:
            with suppress(BlockingIOError):
                os.write(there, self._spoiled(text))

    def _obey(self, order: bytes) -> None:
        if order == _PLUG:
            self._open(1)
        elif order == _UNPLUG:
            os.close(self._masters[1])
            os.close(self._slaves[1])
            self._masters[1] = self._slaves[1] = _GONE
        self._done.set()

    def _spoiled(self, text: bytes) -> bytes:
        if not self.noise:
            return text
        return bytes(self._dice.randrange(256) if self._dice.random() < self.noise else byte for byte in text)


class Socket:
    """A name for a tty that stays the same while cables are plugged in and out; at first it leads nowhere."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def plug(self, tty_name: str) -> None:
        """Makes the name lead to this tty."""
        fresh = self.path.with_suffix(".new")
        fresh.symlink_to(tty_name)
        fresh.replace(self.path)

    def unplug(self) -> None:
        """Makes the name lead nowhere."""
        self.path.unlink()
