"""Files: read up to a maximum size, written whole or not at all, compressed, and locked against other runs."""

import csv
import io
import os
import stat
import zlib
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO, TypeVar

from host_sim.base.errors import OctetError, UsageError
from host_sim.base.system import NO_WAIT, give_mode, lock_at_once, open_to_lock, sync_folder

Word = TypeVar("Word")

_WORD_MAX = 200
"""No longer word has a meaning, and no error quotes one."""


def open_bytes(path: Path, limit: int) -> BinaryIO:
    """Opens a regular file for reading.

    Args:
        path: The file. A pipe or a device is refused before a byte of it is read: some never end.
        limit: The greatest size accepted, bytes.

    Raises:
        FileNotFoundError: There is no such file.
        UsageError: It cannot be opened, is not a regular file, or is larger than the limit.
    """
    try:
        file = open(path, "rb", opener=_open_without_waiting)  # noqa: SIM115 - the caller closes it
    except FileNotFoundError:
        raise
    except IsADirectoryError:
        raise UsageError(f"cannot read {path}: it is a folder, not a file") from None
    except OSError as error:
        raise UsageError(f"cannot read {path}: {error.strerror}") from None
    status = os.fstat(file.fileno())
    if stat.S_ISREG(status.st_mode) and status.st_size <= limit:
        return file
    file.close()
    if not stat.S_ISREG(status.st_mode):
        raise UsageError(f"cannot read {path}: it is not a regular file")
    raise UsageError(f"cannot read {path}: it has {status.st_size} bytes, and at most {limit} are accepted")


def read_bytes(path: Path, limit: int) -> bytes:
    """The content of a regular file; otherwise as `open_bytes`."""
    with open_bytes(path, limit) as file:
        try:
            return file.read(os.fstat(file.fileno()).st_size)
        except OSError as error:
            raise UsageError(f"cannot read {path}: {error.strerror}") from None


def read_text(path: Path, limit: int) -> str:
    """The text of a regular file in UTF-8, with or without a byte order mark; otherwise as `open_bytes`.

    Raises:
        UnicodeDecodeError: It is not text.
    """
    return read_bytes(path, limit).decode("utf-8-sig")


def read_words(path: Path, limit: int, parse: Callable[[str], Word]) -> list[Word]:
    """The words in a file with one word on each line; # begins a comment.

    Args:
        path: The file.
        limit: The greatest size accepted, bytes.
        parse: Converts a word, or raises UsageError.

    Raises:
        UsageError: The file cannot be read, is not text, or has a wrong word; the message names the line.
    """
    try:
        lines = read_text(path, limit).splitlines()
    except FileNotFoundError:
        raise UsageError(f"cannot read {path}: there is no such file") from None
    except UnicodeDecodeError:
        raise UsageError(f"{path} is not text") from None
    words = []
    for number, line in enumerate(lines, 1):
        if word := line.partition("#")[0].strip():
            try:
                if len(word) > _WORD_MAX:
                    raise UsageError(f"{word[:20]!r} goes on for {len(word)} characters: there is no such word")
                words.append(parse(word))
            except UsageError as error:
                raise UsageError(f"{path}:{number}: {error}") from None
    return words


def _open_without_waiting(path: str, flags: int) -> int:
    return os.open(path, flags | NO_WAIT)


def write_bytes(path: Path, content: bytes) -> None:
    """Writes a file as `replacing` does.

    Raises:
        OctetError: As in `replacing`.
    """
    with replacing(path) as part:
        part.write_bytes(content)


def csv_text(rows: Iterable[Iterable[object]]) -> str:
    """Rows as comma-separated values, a line each."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows)
    return text.getvalue()


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Replaces a file atomically: an existing file stays as it is until the new one is complete and on the disk.

    A link stays a link: the file that it names is written. An existing file keeps its mode and its owner.

    Yields:
        The path for the new content: an empty file in the same folder. An exception leaves the old file as it is.

    Raises:
        OctetError: The file cannot be written, or is not a regular file, such as a device.
    """
    import tempfile  # noqa: PLC0415 - a run begins sooner, for it ends with this

    try:
        target = Path(os.path.realpath(path))
        before = target.stat() if target.exists() else None
        if before is not None and not stat.S_ISREG(before.st_mode):
            raise OctetError(f"cannot write {path}: it is not a regular file")
        descriptor, name = tempfile.mkstemp(prefix=f".{target.name}.", dir=target.parent)
        os.close(descriptor)
        try:
            yield Path(name)
            _finish(name, before)
            Path(name).replace(target)
        except BaseException:
            Path(name).unlink(missing_ok=True)
            raise
        sync_folder(target.parent)
    except OSError as error:
        raise OctetError(f"cannot write {path}: {error.strerror or error}") from error


def _finish(name: str, before: os.stat_result | None) -> None:
    """Gives the new file the mode and owner of the old one, or of a new file, and syncs it to the disk."""
    descriptor = os.open(name, os.O_RDWR)
    try:
        give_mode(descriptor, before)
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


_LOCKS = Path("/proc/locks")


def lock(descriptor: int, name: str, instead: str) -> None:
    """Locks an open file or folder until it is closed.

    Args:
        descriptor: Descriptor of the open file or folder.
        name: Name of the protected object, for the message.
        instead: Advice if it is locked already, for the message.

    Raises:
        UsageError: It cannot be locked, or another run has locked it.
    """
    try:
        lock_at_once(descriptor)
    except BlockingIOError:
        raise UsageError(f"{name} is in use by another run{_owner(descriptor)}; {instead}") from None
    except OSError as error:
        raise UsageError(f"cannot lock {name}: {error.strerror}; {instead}") from None


def _owner(descriptor: int) -> str:
    """The process that holds the lock, for a message; empty where the kernel does not say."""
    inode = f":{os.fstat(descriptor).st_ino}"
    for line in _LOCKS.read_text(encoding="ascii").splitlines() if _LOCKS.exists() else ():
        words = line.split()
        if "FLOCK" in words and any(word.endswith(inode) for word in words):
            return f" (process {words[words.index('WRITE') + 1]})" if "WRITE" in words else ""
    return ""


@contextmanager
def run_folder(path: Path) -> Iterator[None]:
    """Creates the folder of a run's files if it does not exist, and keeps other runs out of it.

    Raises:
        UsageError: The folder cannot be created or locked, or another run is using it.
    """
    try:
        path.mkdir(parents=True, exist_ok=True)
        descriptor = open_to_lock(path)
    except OSError as error:
        raise UsageError(f"cannot make the folder {path}: {error.strerror}; choose another with --out") from None
    try:
        lock(descriptor, f"the folder {path}", "choose another with --out")
        yield
    finally:
        os.close(descriptor)


COMPRESSED = ".gz"
"""File name suffix of a compressed log."""

_CHUNK_BYTES = 1 << 16
_LEVEL = 1  # compresses a log to a quarter; the default level takes three times as long for a fifth
_GZIP = 16 + zlib.MAX_WBITS


class CompressedFile:
    """Writes a gzip file. If it is cut off anywhere, all but the last 64 kB written before can be read.

    Equal content gives equal bytes, however it is split into writes.
    """

    def __init__(self, file: BinaryIO) -> None:
        """Takes a file that is open for writing; `close` closes it."""
        self._file, self._waiting = file, bytearray()
        self._compressor = zlib.compressobj(_LEVEL, zlib.DEFLATED, _GZIP)
        self._is_empty = True

    @property
    def closed(self) -> bool:
        """Whether it is closed."""
        return self._file.closed

    def write(self, content: bytes) -> None:
        """Appends content; its last part is buffered in memory.

        Raises:
            OSError: It cannot be written.
        """
        self._waiting += content
        while len(self._waiting) >= _CHUNK_BYTES:
            chunk = self._waiting[:_CHUNK_BYTES]
            del self._waiting[:_CHUNK_BYTES]
            self._put(chunk, zlib.Z_SYNC_FLUSH)

    def flush(self) -> None:
        """Writes everything that is buffered.

        Raises:
            OSError: It cannot be written.
        """
        chunk, self._waiting = self._waiting, bytearray()
        self._put(chunk, zlib.Z_SYNC_FLUSH)

    def close(self) -> None:
        """Writes the rest and closes the file. A file to which nothing was written stays empty.

        Raises:
            OSError: It cannot be written; it is closed all the same.
        """
        try:
            if self._waiting or not self._is_empty:
                self._put(self._waiting, zlib.Z_FINISH)
        finally:
            self._file.close()

    def _put(self, chunk: bytearray, mode: int) -> None:
        self._is_empty = self._is_empty and not chunk
        self._file.write(self._compressor.compress(chunk) + self._compressor.flush(mode))
        self._file.flush()
