"""The log of a run's frames, written during the run in candump's format (`candump -L`).

Time stamps are in robot time, so that a log depends only on the seed and the options, but for one thing: BOOT names
the build. The digest of a log leaves out the data of BOOT, so that it is the same for every build.
"""

import errno
import hashlib
import os
import re
import stat
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO

from host_sim.base.errors import OctetError, UsageError
from host_sim.base.files import COMPRESSED
from host_sim.base.system import NO_LINK, NO_WAIT
from host_sim.protocol.codec import NODE_MAX, Frame, Protocol

if TYPE_CHECKING:
    from host_sim.base.files import CompressedFile

CHANNEL = "octet"
"""The interface name in every log, for any bus."""

_FLUSH_LINES = 4096
_STAMP = f"({{:010d}}.{{:06d}}) {CHANNEL}"
_BOOTS = frozenset(Protocol(node).id_of("BOOT") for node in range(1, NODE_MAX + 1))
_BOOT_DATA = re.compile(rb"(?<= (?:%s)#)[0-9A-F]+" % b"|".join(b"%03X" % boot for boot in sorted(_BOOTS)))


def digest_of(text: bytes) -> str:
    """SHA-256 of a log's lines without the data of BOOT, in hexadecimal."""
    return hashlib.sha256(_BOOT_DATA.sub(b"", text)).hexdigest()


def line_of(time_us: int, frame: Frame) -> str:
    """The log's line for a frame, without the line end."""
    return f"{_STAMP.format(*divmod(time_us, 1_000_000))} {frame.id:03X}#{frame.data.hex().upper()}"


class FrameLog:
    """Writes a log to `PATH.part`, which replaces an old log of the same name only when closed and complete.

    A log whose name ends with .gz is compressed by gzip. Its digest is that of the text.

    Without a path, only the digest is computed.

    Attributes:
        keeps: Whether the log uses the frames handed over.
    """

    keeps = True

    def __init__(self, path: Path | None = None) -> None:
        """Opens `PATH.part`.

        Raises:
            UsageError: The folder is not writable, or the path does not name a file.
        """
        if path is not None and not path.name:
            raise UsageError(f"{path} is not the name of a file")
        self._path = path or Path(os.devnull)
        self._part = self._path if path is None else path.with_name(path.name + ".part")
        self.set_time(0)
        self._lines: list[str] = []
        self._boots = False
        self._digest = hashlib.sha256()
        self._failed = False
        try:
            self._file = _opened(self._part, is_compressed=self._path.suffix == COMPRESSED)
        except OSError as error:
            reason = f"{error.strerror}; choose another folder with --out"
            raise UsageError(f"cannot write {self._part}: {reason}") from None

    def set_time(self, time_us: int) -> None:
        """Sets the time stamp of the frames that follow.

        Args:
            time_us: Robot time since the start of the run, us.
        """
        seconds, micros = divmod(time_us, 1_000_000)
        self._stamp = _STAMP.format(seconds, micros)

    def line(self, frame: Frame) -> str:
        """The line for a frame with the current time stamp."""
        frame_id, data = frame
        return f"{self._stamp} {frame_id:03X}#{data.hex().upper()}"

    def add(self, frame: Frame) -> None:
        """Records a frame with the current time stamp."""
        frame_id, data = frame
        self._lines.append(f"{self._stamp} {frame_id:03X}#{data.hex().upper()}\n")
        self._boots |= frame_id in _BOOTS
        if len(self._lines) >= _FLUSH_LINES:
            self._flush()

    def flush(self) -> None:
        """Writes all recorded lines.

        Raises:
            OctetError: The file cannot be written, now or before.
        """
        if self._failed:
            raise OctetError(f"cannot write {self._part}: an earlier write failed")
        self._flush()
        try:
            self._file.flush()
        except OSError as error:
            self._failed = True
            raise OctetError(f"cannot write {self._part}: {error.strerror}") from error

    def add_block(self, text: bytes) -> None:
        """Records lines that were written elsewhere, each with its line end; BOOT is not among them."""
        self._flush()
        self._digest.update(text)
        self._write(text)

    def close(self) -> str:
        """Closes the log; closing it again does nothing. A log without frames does not replace the old one.

        Returns:
            SHA-256 of the log's lines without the data of BOOT, in hexadecimal.

        Raises:
            OctetError: The file cannot be written; `PATH.part` holds the part that could be.
        """
        if self._file.closed:
            return self._digest.hexdigest()
        if self._failed:
            with suppress(OSError):  # reported before
                self._file.close()
            return self._digest.hexdigest()
        self._flush()
        try:
            self._file.close()
            if self._part == self._path:
                return self._digest.hexdigest()
            if self._part.stat().st_size:
                self._part.replace(self._path)
            else:
                self._part.unlink()
        except OSError as error:
            raise OctetError(f"cannot write {self._path}: {error.strerror}") from error
        return self._digest.hexdigest()

    def drop(self) -> None:
        """Closes the log, and removes it unless it was closed before or could not be written; an old one stays."""
        if self._file.closed:
            return
        with suppress(OSError):
            self._file.close()
            if not self._failed and self._part != self._path:
                self._part.unlink()

    def _flush(self) -> None:
        block = "".join(self._lines).encode("ascii")
        self._lines.clear()
        self._digest.update(_BOOT_DATA.sub(b"", block) if self._boots else block)
        self._boots = False
        self._write(block)

    def _write(self, block: bytes) -> None:
        try:
            self._file.write(block)
        except OSError as error:
            self._failed = True
            raise OctetError(f"cannot write {self._part}: {error.strerror}") from error


class NoLog(FrameLog):
    """Discards frames, without even a digest."""

    keeps = False

    def add(self, frame: Frame) -> None:
        """Does nothing."""

    def add_block(self, text: bytes) -> None:
        """Does nothing."""


def _opened(path: Path, *, is_compressed: bool) -> "BinaryIO | CompressedFile":
    file = open(path, "wb", opener=_open_regular)  # noqa: SIM115 - the log closes it
    if not is_compressed:
        return file
    from host_sim.base.files import CompressedFile  # noqa: PLC0415 - other runs begin sooner without

    return CompressedFile(file)


def _open_regular(path: str, flags: int) -> int:
    """Opens a file without following a link, and without waiting for the reader of a pipe."""
    if path == os.devnull:
        return os.open(path, flags)
    descriptor = os.open(path, flags | NO_LINK | NO_WAIT, 0o666)
    if not stat.S_ISREG(os.fstat(descriptor).st_mode):
        os.close(descriptor)
        raise OSError(errno.EINVAL, "it is not a regular file")
    return descriptor
