"""Opens log files: our readers for text and ASC, python-can's for other formats; plain or compressed."""

import bz2
import codecs
import gc
import gzip
import importlib
import io
import logging
import lzma
import os
import sqlite3
import struct
import sys
import zlib
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, closing, contextmanager, suppress
from functools import partial
from itertools import dropwhile
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO, TextIO, cast

from host_sim.base.errors import UsageError
from host_sim.base.extra_library import library
from host_sim.base.files import open_bytes
from host_sim.base.terminal import SOON_S, ProgressLine
from host_sim.protocol.codec import Frame
from host_sim.recording.log_text import (
    ERROR,
    EXTENDED,
    FD,
    OTHER,
    REMOTE,
    AscReader,
    LineReader,
    Recorded,
    counts_from_the_line_before,
    is_relative,
)

if TYPE_CHECKING:
    from can import Message

_SIZE_MAX = 64_000_000_000
_LINE_MAX = 4096
_BOM = codecs.BOM_UTF8.decode("cp1252")
_COMPRESSED: dict[bytes, Callable[[BinaryIO], Any]] = {
    b"\x1f\x8b": gzip.open,
    b"BZh": bz2.open,
    b"\xfd7zXZ": lzma.open,
}
_DATABASE = b"SQLite format 3"
_ASC = (b"date ", b"base ", b"// version")
_PCAP = (b"\xd4\xc3\xb2\xa1", b"\xa1\xb2\xc3\xd4", b"\x4d\x3c\xb2\xa1", b"\x0a\x0d\x0d\x0a")
_DAMAGED = (gzip.BadGzipFile, EOFError, zlib.error, lzma.LZMAError)
_READS = (
    "Octet reads logs of candump and of python-can (.log .asc .blf .trc .csv .mf4 .db), also as .gz .bz2 or .xz;"
    " python-can's can_logconvert writes them"
)

Read = tuple[bytes | str, Recorded | str]
"""The channel that a frame was on, and the frame; or the kind of one that the protocol does not use."""


def mf4_module() -> Any:
    """python-can's module for MF4 with asammdf, which takes seconds to load.

    Raises:
        UsageError: asammdf is not installed.
    """
    library("asammdf", "export")
    module = importlib.import_module("can.io.mf4")
    return module if module.asammdf is not None else importlib.reload(module)


def frames_in(path: Path) -> Iterator[Read]:
    """Yields the frames of a log file in order, each with its channel.

    Raises:
        UsageError: The file cannot be read, or is not a log.
        UsageError: It is empty or damaged; the message names file and line. An incomplete last line of text is
            left out.
    """
    with _open(path) as file:
        try:
            yield from _reader_for(path, file)(path, file)
        except _DAMAGED as error:
            raise UsageError(f"{path} is damaged, or cut short: {error or type(error).__name__}") from None


@contextmanager
def _open(path: Path) -> Iterator[BinaryIO]:
    """The uncompressed contents of a file."""
    with ExitStack() as stack:
        try:
            file = stack.enter_context(open_bytes(path, _SIZE_MAX))
        except FileNotFoundError:
            raise UsageError(f"there is no file {path}: tools/run writes out/run.log") from None
        start = file.read(8)
        file.seek(0)
        if _DATABASE.startswith(start):  # sqlite3 opens the file itself
            yield file
            return
        line = stack.enter_context(ProgressLine(os.fstat(file.fileno()).st_size, after_s=SOON_S))
        read = io.BufferedReader(_Watched(file, _progress_shown(line, path)))
        opened = next((each for magic, each in _COMPRESSED.items() if start.startswith(magic)), None)
        if opened:
            unpacked = cast("BinaryIO", stack.enter_context(opened(read)))
            read = io.BufferedReader(_Watched(unpacked, _limited(path)))
        yield cast("BinaryIO", read)


class _Watched(io.RawIOBase):
    """A file that tells how much of it has been read, in bytes."""

    def __init__(self, file: BinaryIO, watch: Callable[[int], None]) -> None:
        self._file: Any = file
        self._watch, self._at = watch, 0

    def readable(self) -> bool:
        return True

    def seekable(self) -> bool:
        return True

    def readinto(self, buffer: Any) -> int:
        data = self._file.read1(len(buffer))  # readinto loses the last data of a truncated file
        buffer[: len(data)] = data
        self._at += len(data)
        self._watch(self._at)
        return len(data)

    def seek(self, offset: int, whence: int = io.SEEK_SET) -> int:
        self._at = self._file.seek(offset, whence)
        return self._at


def _progress_shown(line: ProgressLine, path: Path) -> Callable[[int], None]:
    """Returns a function that shows how much of a log has been read."""

    def show(count: int) -> None:
        if line.is_due():
            line.show(f"reading {path}", count)

    return show


def _limited(path: Path) -> Callable[[int], None]:
    """Returns a function that refuses a log that is too large when it is unpacked."""

    def check(count: int) -> None:
        if count > _SIZE_MAX:
            raise UsageError(f"cannot read {path}: it is larger than {_SIZE_MAX:,} bytes when it is unpacked")

    return check


def _reader_for(path: Path, file: BinaryIO) -> Callable[[Path, BinaryIO], Iterator[Read]]:
    first = file.readline(_LINE_MAX).removeprefix(codecs.BOM_UTF8)
    file.seek(0)
    if not first:
        raise UsageError(f"{path} is not a frame log: it is empty")
    if first.startswith(_PCAP):
        raise UsageError(f"{path} is a capture of Wireshark or tcpdump, not a frame log: {_READS}")
    formats = {b"LOGG": _blf, b"MDF ": _mf4, _DATABASE: _db, b";": _trc, b"timestamp,arbitration_id,": _csv}
    formats |= dict.fromkeys(_ASC, _asc)
    return next((read for start, read in formats.items() if first.lower().startswith(start.lower())), _text)


def _text(path: Path, file: BinaryIO) -> Iterator[Read]:
    reader = LineReader(deltas=_has_deltas(file))
    for number, line in enumerate(_lines(file), start=1):
        if len(line) < _LINE_MAX and not line.endswith(b"\n"):
            if number == 1 and line.isascii():
                raise UsageError(f"{path} is not a frame log: no whole line, only {line[:60].decode('ascii')!r}")
            if line.isascii():
                return  # cut short during writing
        try:
            read = reader.read(line)
        except ValueError as error:
            raise _not_a_frame(path, number, line, str(error)) from None
        if read is not None:
            yield read


def _lines(file: BinaryIO) -> Iterator[bytes]:
    """Yields lines, up to the last whole one of a compressed file cut short during writing."""
    with suppress(EOFError):
        for line in iter(partial(file.readline, _LINE_MAX), b""):
            yield line.removeprefix(codecs.BOM_UTF8)


def _has_deltas(file: BinaryIO) -> bool:
    """Whether time stamps are differences; scans the whole log only if they are ambiguous."""
    first = next(dropwhile(lambda line: not line.strip(), _lines(file)), b"")
    deltas = is_relative(first) and counts_from_the_line_before(_lines(file))
    file.seek(0)
    return deltas


def _not_a_frame(path: Path, number: int, line: bytes, why: str) -> UsageError:
    known = f"; {_READS}" if number == 1 else ""
    if not line.isascii() or b"\0" in line:
        return UsageError(f"{path} is not a frame log: it is not text, from line {number} on{known}")
    return UsageError(f"{path}, line {number}: {why}: {line[:60].decode('ascii')!r}{known}")


class _Lines:
    """A text file for readers of python-can.

    Attributes:
        number: Number of lines read.
        content: Number of these that are not comments.
        is_cut: Whether the last line read has no end.
    """

    def __init__(self, file: BinaryIO) -> None:
        self._text = io.TextIOWrapper(file, encoding="cp1252", errors="replace")
        self.number = self.content = 0
        self.is_cut = False

    def __iter__(self) -> Iterator[str]:
        return self

    def __next__(self) -> str:
        line = self._text.readline(_LINE_MAX)
        if not line:
            raise StopIteration
        self.number += 1
        self.is_cut = not line.endswith("\n")
        self.content += bool(line.strip()) and not line.startswith(";")
        return line if self.number > 1 else line.removeprefix(_BOM)

    def close(self) -> None:
        """As in a file."""
        self._text.close()


def _asc(path: Path, file: BinaryIO) -> Iterator[Read]:
    reader = AscReader()
    with closing(_Lines(file)) as lines:
        for line in lines:
            try:
                read = reader.read(line)
            except ValueError as error:
                if lines.is_cut:
                    return
                raise UsageError(f"{path}, line {lines.number}: {error}: {line.strip()[:60]!r}") from None
            if read is not None:
                yield read


def _trc(path: Path, file: BinaryIO) -> Iterator[Read]:
    from can import TRCReader  # noqa: PLC0415 - other logs are read sooner without python-can

    with closing(_Lines(file)) as lines:
        yield from _of_lines(path, lines, TRCReader(cast("TextIO", lines)))


def _csv(path: Path, file: BinaryIO) -> Iterator[Read]:
    from can import CSVReader  # noqa: PLC0415 - as above

    with closing(_Lines(file)) as lines:
        lines.content = -1  # the names of the columns
        yield from _of_lines(path, lines, CSVReader(cast("TextIO", lines)))


def _of_lines(path: Path, lines: _Lines, messages: "Iterable[Message]") -> Iterator[Read]:
    """Yields the frames of a text format, then those that python-can skipped silently."""
    count = 0
    try:
        with _warnings_refused("can.io.trc"):
            for count, message in enumerate(messages, 1):  # noqa: B007 - used below
                yield _channel(message), _from(message)
    except (ValueError, IndexError, KeyError, OverflowError, NotImplementedError) as error:
        if lines.is_cut:
            return
        raise UsageError(f"{path}, line {lines.number}: not a frame: {_reason(error)}") from None
    for _ in range(lines.content - count):
        yield "", OTHER


def _blf(path: Path, file: BinaryIO) -> Iterator[Read]:
    from can.io.blf import BLFParseError, BLFReader  # noqa: PLC0415 - as above

    try:
        with _warnings_refused("can.io.blf"):
            for message in BLFReader(file):
                yield _channel(message, first=1), _from(message)
    except (BLFParseError, ValueError, struct.error) as error:
        why = str(error) or "no object begins where the last one ends"
        raise UsageError(f"{path} is a damaged BLF file, or one cut short: {why}") from None


def _mf4(path: Path, file: BinaryIO) -> Iterator[Read]:
    reader = _mf4_reader(path, file)
    try:
        for message in reader:
            yield _channel(message), _from(message)
    except Exception as error:  # asammdf may raise anything
        raise UsageError(f"{path} is a damaged MF4 file, or one cut short: {_reason(error)}") from None
    finally:
        reader.stop()


def _mf4_reader(path: Path, file: BinaryIO) -> Any:
    module, before = mf4_module(), sys.unraisablehook
    sys.unraisablehook = lambda _: None  # a file that asammdf could not open warns again when freed
    try:
        return module.MF4Reader(io.BytesIO(file.read()))
    except Exception as error:
        why = _reason(error)
    finally:
        gc.collect()
        sys.unraisablehook = before
    raise UsageError(f"{path} is a damaged MF4 file, or one cut short: {why}")


def _db(path: Path, file: BinaryIO) -> Iterator[Read]:
    from can import SqliteReader  # noqa: PLC0415 - as above

    if isinstance(file, io.BufferedReader) and isinstance(file.raw, _Watched):
        raise UsageError(f"{path} is a compressed database: unpack it first")
    try:
        with SqliteReader(path) as reader:
            for message in reader:
                yield "", _from(message)
    except (sqlite3.Error, ValueError) as error:
        raise UsageError(f"{path} is no database of python-can's frames: {_reason(error)}") from None


@contextmanager
def _warnings_refused(name: str) -> Iterator[None]:
    """Raises ValueError when a logger of python-can warns of a damaged file."""

    def refuse(record: logging.LogRecord) -> bool:
        if record.levelno < logging.WARNING:
            return False
        raise ValueError(record.getMessage())

    logger = logging.getLogger(name)
    logger.addFilter(refuse)
    try:
        yield
    finally:
        logger.removeFilter(refuse)


def _reason(error: Exception) -> str:
    return str(error) or type(error).__name__


def _channel(message: "Message", first: int = 0) -> str:
    """The channel as the file names it."""
    return str(message.channel + first) if isinstance(message.channel, int) else str(message.channel or "")


def _from(message: "Message") -> Recorded | str:
    if message.is_error_frame:
        return ERROR
    if message.is_fd or len(message.data) > 8:  # noqa: PLR2004 - .csv and .db do not say which are FD
        return FD
    if message.is_remote_frame:
        return REMOTE
    if message.is_extended_id:
        return EXTENDED
    if len(message.data) != min(8, message.dlc):
        raise ValueError(f"a frame of {message.dlc} bytes with {len(message.data)}")
    return Recorded(round(message.timestamp * 1_000_000), Frame(message.arbitration_id, bytes(message.data)))
