"""Reads regular files up to a maximum size."""

import os
import stat
from collections.abc import Callable
from pathlib import Path
from typing import BinaryIO, TypeVar

from host_sim.base.errors import UsageError
from host_sim.base.system import NO_WAIT

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
