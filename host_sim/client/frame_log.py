"""Frame logs: written as they come, read back with every line checked. The format is candump's (`candump -L`).

Time stamps are robot time, so that a log depends on seed and options, and on nothing else.
"""

import hashlib
import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from host_sim.errors import OctetError, UsageError
from host_sim.protocol.codec import Frame

CHANNEL = "octet"
"""The interface's name in every log, whatever bus it was."""

_LINE = re.compile(r"\((\d+)\.(\d{6})\) (\S+) ([0-9A-F]{3})#((?:[0-9A-F]{2}){0,8})")
_FLUSH_LINES = 4096


class Recorded(NamedTuple):
    """One line of a log: robot time in µs, and the frame."""

    time_us: int
    frame: Frame


def line_of(time_us: int, frame: Frame) -> str:
    """The log's line for a frame, without its end."""
    seconds, micros = divmod(time_us, 1_000_000)
    return f"({seconds:010d}.{micros:06d}) {CHANNEL} {frame.id:03X}#{frame.data.hex().upper()}"


class Recorder:
    """Writes a log beside the old one of the same name, and takes its place when closed: nothing is lost before.

    Attributes:
        time_us: Robot time of the frames that follow.
    """

    def __init__(self, path: Path) -> None:
        """Opens `PATH.part`.

        Raises:
            UsageError: The folder cannot be written.
        """
        self.time_us = 0
        self._path, self._part = path, path.with_name(path.name + ".part")
        self._lines: list[str] = []
        self._digest = hashlib.sha256()
        try:
            self._file = self._part.open("wb")
        except OSError as error:
            reason = f"{error.strerror}; choose another folder with --out"
            raise UsageError(f"cannot write {self._part}: {reason}") from None

    def add(self, frame: Frame) -> None:
        """Records a frame as of now."""
        self._lines.append(line_of(self.time_us, frame))
        if len(self._lines) >= _FLUSH_LINES:
            self._flush()

    def close(self) -> str:
        """Ends the log; once more does nothing. One without a frame leaves no file, and the old one stays.

        Returns:
            SHA-256 of its bytes, in hexadecimal.

        Raises:
            OctetError: The disk did not take it; what it took is in `PATH.part`.
        """
        if self._file.closed:
            return self._digest.hexdigest()
        self._flush()
        try:
            self._file.close()
            if self._part.stat().st_size:
                self._part.replace(self._path)
            else:
                self._part.unlink()
        except OSError as error:
            raise OctetError(f"cannot write {self._path}: {error.strerror}") from error
        return self._digest.hexdigest()

    def _flush(self) -> None:
        block = "".join(f"{line}\n" for line in self._lines).encode("ascii")
        self._lines.clear()
        self._digest.update(block)
        try:
            self._file.write(block)
        except OSError as error:
            raise OctetError(f"cannot write {self._part}: {error.strerror}") from error


def read_log(path: Path) -> Iterator[Recorded]:
    """Reads a log, ours or candump's own.

    Yields:
        Each frame in its order.

    Raises:
        UsageError: The file cannot be read.
        OctetError: A line is no frame, or the last line is cut short; names the line.
    """
    try:
        text = path.read_text(encoding="ascii")
    except OSError as error:
        raise UsageError(f"cannot read {path}: {error.strerror}") from None
    except UnicodeDecodeError:
        raise UsageError(f"{path} is no frame log: it is not even text") from None
    if not text:
        raise OctetError(f"{path} is empty: no frame log")
    for number, line in enumerate(text.splitlines(keepends=True), start=1):
        match = _LINE.fullmatch(line.rstrip("\n"))
        if match is None or not line.endswith("\n"):
            raise OctetError(f"{path}, line {number}: no frame as candump -L writes it, or cut short: {line[:60]!r}")
        seconds, micros, _, frame_id, data = match.groups()
        yield Recorded(int(seconds) * 1_000_000 + int(micros), Frame(int(frame_id, 16), bytes.fromhex(data)))
