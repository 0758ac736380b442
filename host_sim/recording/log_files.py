"""Opens log files: text, Vector's ASC and BLF, each of them plain or compressed by gzip."""

import codecs
import gzip
import io
import struct
import zlib
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from functools import partial
from itertools import dropwhile
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO, NoReturn, TextIO, cast

from host_sim.base.errors import UsageError
from host_sim.base.regular_file import open_bytes
from host_sim.protocol.codec import Frame
from host_sim.recording.log_text import (
    ERROR,
    EXTENDED,
    FD,
    REMOTE,
    LineReader,
    Recorded,
    counts_from_the_line_before,
    is_relative,
)

if TYPE_CHECKING:
    from logging import LogRecord

    from can import Message

_SIZE_MAX = 64_000_000_000
_LINE_MAX = 4096
_BOM = codecs.BOM_UTF8.decode("cp1252")
_GZIP, _BLF = b"\x1f\x8b", b"LOGG"
_ASC = (b"date ", b"base ", b"// version")
_DAMAGED = (gzip.BadGzipFile, EOFError, zlib.error)


def frames_in(path: Path) -> Iterator[Recorded | str]:
    """Yields the frames of a log file in order; for frames that the protocol does not use, only their kind.

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
        except FileNotFoundError as error:
            raise UsageError(f"cannot read {path}: {error.strerror}") from None
        compressed = file.read(len(_GZIP)) == _GZIP
        file.seek(0)
        yield cast("BinaryIO", stack.enter_context(gzip.GzipFile(fileobj=file))) if compressed else file


def _reader_for(path: Path, file: BinaryIO) -> Callable[[Path, BinaryIO], Iterator[Recorded | str]]:
    first = file.readline(_LINE_MAX).removeprefix(codecs.BOM_UTF8)
    file.seek(0)
    if not first:
        raise UsageError(f"{path} is not a frame log: it is empty")
    if first.startswith(_BLF):
        return _blf
    return _asc if first.lower().startswith(_ASC) else _text


def _text(path: Path, file: BinaryIO) -> Iterator[Recorded | str]:
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
    if not line.isascii() or b"\0" in line:
        return UsageError(f"{path} is not a frame log: it is not text, from line {number} on")
    return UsageError(f"{path}, line {number}: {why}: {line[:60].decode('ascii')!r}")


class _NumberedLines:
    """A text file for `can.ASCReader` that counts the lines read."""

    def __init__(self, file: BinaryIO) -> None:
        self._text = io.TextIOWrapper(file, encoding="cp1252", errors="replace")
        self.number = 0

    def __iter__(self) -> Iterator[str]:
        for line in iter(partial(self._text.readline, _LINE_MAX), ""):
            self.number += 1
            yield line if self.number > 1 else line.removeprefix(_BOM)

    def close(self) -> None:
        """As in a file."""
        self._text.close()


def _asc(path: Path, file: BinaryIO) -> Iterator[Recorded | str]:
    from can import ASCReader  # noqa: PLC0415 - other logs are read sooner without python-can

    text = _NumberedLines(file)
    try:
        for message in ASCReader(cast("TextIO", text)):
            yield _from(message)
    except (ValueError, IndexError, OverflowError) as error:
        raise UsageError(f"{path}, line {text.number}: not a frame in ASC format: {error}") from None


def _refuse(warning: "LogRecord") -> NoReturn:
    """Turns what python-can says of a damaged file into an error."""
    raise ValueError(warning.getMessage())


def _blf(path: Path, file: BinaryIO) -> Iterator[Recorded | str]:
    from can.io.blf import LOG, BLFParseError, BLFReader  # noqa: PLC0415 - as above

    LOG.addFilter(_refuse)
    try:
        for message in BLFReader(file):
            yield _from(message)
    except (BLFParseError, ValueError, struct.error) as error:
        raise UsageError(f"{path} is a damaged BLF file, or one cut short: {error}") from None
    finally:
        LOG.removeFilter(_refuse)


def _from(message: "Message") -> Recorded | str:
    if message.is_error_frame:
        return ERROR
    if message.is_fd:
        return FD
    if message.is_remote_frame:
        return REMOTE
    if message.is_extended_id:
        return EXTENDED
    return Recorded(round(message.timestamp * 1_000_000), Frame(message.arbitration_id, bytes(message.data)))
