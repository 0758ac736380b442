"""Frames as slcan text over a stream, such as a socket or a serial line: one `tIIILDD..` and carriage return each."""

import os
import re
import select
import time
from collections import deque
from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import Protocol

import serial  # type: ignore[import-untyped]  # pyserial has no types

from host_sim.base.errors import LinkDownError, UsageError
from host_sim.transport.link import OWN_MAX, Frame, LineStats

_LINE = re.compile(rb"t([0-9A-Fa-f]{3})([0-8])((?:[0-9A-Fa-f]{2}){0,12})")
_ENDS = re.compile(rb"[\r\n\a]")
_OTHER_FRAMES = (b"T", b"r", b"R")
_ACKNOWLEDGED = (b"", b"z", b"Z")
_CHUNK = 4096
_LINE_MAX = 64
_STAMPS = (0, 4, 8)
"""Digits of a time stamp, which some adapters append to each frame."""

_SEND_S, _REOPEN_S = 0.1, 1.0
_NO_FRAME = Frame(-1, b"")


class Stream(Protocol):
    """An open file that can be read and written: a connected socket, a serial port."""

    def fileno(self) -> int:
        """Its file descriptor."""

    def close(self) -> None:
        """Closes it."""


def encode(frame: Frame) -> bytes:
    """The line of text for a frame, with its end."""
    return b"t%03X%d%s\r" % (frame.id, len(frame.data), frame.data.hex().upper().encode("ascii"))


def decode(line: bytes) -> Frame | None:
    """The frame in a line without its end; None unless it has an 11-bit identifier and data."""
    match = _LINE.fullmatch(line)
    if match is None or len(match[3]) - 2 * int(match[2]) not in _STAMPS:
        return None
    return Frame(int(match[1], 16), bytes.fromhex(match[3][: 2 * int(match[2])].decode("ascii")))


class SlcanLink:
    """A link over a stream, which `close` closes. Noise on the line costs the frames that it hits, and no more.

    Frames that an adapter returns to their sender are skipped.

    Attributes:
        explain: Called when the line is gone, before the error is raised; it may raise one that says more.
    """

    def __init__(
        self, end: Stream, stats: LineStats | None = None, ids: Sequence[int] = (), opening: bytes = b""
    ) -> None:
        """Takes over the stream.

        Args:
            end: The stream.
            stats: Counts the line's outages and errors.
            ids: The identifiers to listen for, none for all; frames with others are skipped.
            opening: Commands that open the adapter. They are sent now, and each second until the first frame comes:
                an adapter may restart when its port is opened.

        Raises:
            LinkDownError: The line is gone.
        """
        self.explain: Callable[[], object] = lambda: None
        self._end = end
        self._ids = frozenset(ids)
        self._stats = stats or LineStats()
        self._fd = end.fileno()
        os.set_blocking(self._fd, False)
        self._lines: list[bytes] = []
        self._rest = b""
        self._own: deque[Frame] = deque(maxlen=OWN_MAX)
        self._opening, self._open_at_s = opening, 0.0
        self._stats.heard = self._stats.heard or 0
        self._open()

    def send(self, frame: Frame) -> None:
        """As in `Link`."""
        self._own.append(frame)
        self.write(encode(frame) * self._stats.copies)

    def write(self, text: bytes) -> None:
        """Sends any text; what there is no room for in time is lost."""
        give_up = time.monotonic() + _SEND_S
        try:
            while text and self._await(select.POLLOUT, give_up - time.monotonic()):
                with suppress(BlockingIOError):  # a terminal may promise room that it does not have
                    text = text[os.write(self._fd, text) :]
        except OSError as error:
            self.explain()
            raise LinkDownError(f"cannot send to the robot: {error}") from error
        self._stats.unsent += bool(text)

    def receive(self, timeout_s: float) -> Frame | None:
        """As in `Link`."""
        frame = self._next()
        if frame is not None:
            return frame
        give_up = time.monotonic() + timeout_s
        left_s = timeout_s
        while frame is None and left_s >= 0:
            self._open()
            if self._await(select.POLLIN, min(left_s, _REOPEN_S)):
                self._refill()
                frame = self._next()
            elif left_s <= _REOPEN_S:
                break
            left_s = give_up - time.monotonic()
        return frame

    def close(self) -> None:
        """As in `Link`."""
        self._end.close()

    def _open(self) -> None:
        """Sends the opening commands when they are due."""
        if self._opening and time.monotonic() >= self._open_at_s:
            self._open_at_s = time.monotonic() + _REOPEN_S
            self.write(self._opening)

    def _next(self) -> Frame | None:
        """The next received frame; None if there is none for us."""
        while self._lines:
            line = self._lines.pop()
            if line in _ACKNOWLEDGED:
                continue
            frame = decode(line)
            if frame is None:
                if not line.startswith(_OTHER_FRAMES):
                    self._stats.garbled += 1
                    self._stats.strange = ascii(line.decode("latin-1"))
                return _NO_FRAME
            if frame in self._own:
                continue
            self._stats.frames += 1
            self._opening = b""
            if not self._ids or frame.id in self._ids:
                return frame
        return None

    def _await(self, event: int, timeout_s: float) -> bool:
        poll = select.poll()
        poll.register(self._fd, event)
        return bool(poll.poll(max(timeout_s, 0.0) * 1000))

    def _refill(self) -> None:
        try:
            chunk = os.read(self._fd, _CHUNK)
        except BlockingIOError:
            return
        except OSError as error:
            self.explain()
            raise LinkDownError(f"cannot hear the robot: {error}") from error
        if not chunk:
            self.explain()
            raise LinkDownError("cannot hear the robot: its end of the line is closed")
        self._stats.heard = len(chunk) + (self._stats.heard or 0)
        self._stats.errors += chunk.count(b"\a")
        *lines, rest = _ENDS.split(self._rest + chunk)
        self._lines = lines[::-1]
        self._rest = rest[-_LINE_MAX:]


_BAUD = 115_200
_BIT_RATES = (10_000, 20_000, 50_000, 100_000, 125_000, 250_000, 500_000, 800_000, 1_000_000)
"""Bit rates, by the digit of slcan's command S."""


def open_serial_line(channel: str, bitrate: int, ids: Sequence[int], stats: LineStats) -> SlcanLink:
    """Opens a serial port and the bus behind it.

    Args:
        channel: The port's device, with `@BAUD` if its speed is not 115200.
        bitrate: Bus bit rate, bit/s.
        ids: The 11-bit identifiers to listen for; none for all.
        stats: Counts what happens to the line.

    Raises:
        UsageError: There is no such port, or it has no such speed.
        LinkDownError: The port is gone again.
    """
    device, at, baud = channel.partition("@")
    if at and not baud.isdecimal():
        raise UsageError(f"a serial port's speed is a number of baud, not {baud!r}")
    try:
        port = serial.Serial(device, int(baud or _BAUD), timeout=0)
    except (serial.SerialException, OSError, ValueError, OverflowError) as error:
        raise UsageError(f"cannot open the bus slcan:{channel}: {str(error).splitlines()[0]}") from error
    # An end of line first, for what may be left of an older one; then close, no time stamps, speed, open.
    try:
        return SlcanLink(port, stats, ids, b"\rC\rZ0\rS%d\rO\r" % _BIT_RATES.index(bitrate))
    except LinkDownError:
        port.close()
        raise
