"""Fuzzes a reader in Python: damages its samples at random, and goes on from what took new ways.

libFuzzer's own bridge to Python, atheris, comes as wheels for some versions of Python only.
"""

import hashlib
import random
import re
import signal
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import CodeType, FrameType
from typing import Any, NamedTuple

from tests.proof.readers import ROOT, Reader

TIMEOUT_S = 10
CUT_MAX = 20
EDITS = (1, 1, 1, 2, 3, 6)
SIZE_MAX = 64_000
TROUBLE = [
    *(b"\x00", b"\xff", b"\xfe\xff", b"\r", b"\n\n", b"\t", b'"', b"'", b"\\", b"%s", b"../.."),
    *(b"{", b"}", b"[[", b"]", b"[" * 3000, b"#", b";", b"(", b"=", b":", b"@", b"%"),
    *(b"-1", b"1e999", b"NaN", b"null", b"true", b"0x", b"[]", b"{}", b"99999999999999999999", b"9" * 5000),
    *("\u202e".encode(), "\u0663".encode(), "²".encode()),
]
"""What readers stumble over."""

_WORD = re.compile(rb"[A-Za-z_]+|-?[0-9.]+|\"[^\"]*\"")
_OURS = (f"{ROOT}/host_sim/", f"{ROOT}/tools/")

Step = tuple[CodeType, int, int]
"""From a line to the next one that runs, in the function of the latter."""


class HangError(BaseException):
    """A reader took too long. No reader can take it for one of its own errors."""


class Outcome(NamedTuple):
    """What fuzzing came to.

    Attributes:
        tried: Inputs.
        steps: Steps from line to line of the project that they reached.
        corpus: Inputs that were kept.
        find: The input that did harm; None if none did.
        words: What it did.
    """

    tried: int
    steps: int
    corpus: int
    find: Path | None
    words: str


class ReaderFuzzer:
    """Fuzzes one reader.

    Args:
        reader: The reader.
        folder: Has the folders "corpus" and "finds", or will have them.
        seed: For the same inputs again, if the corpus is the same.
    """

    def __init__(self, reader: Reader, folder: Path, seed: int) -> None:
        """Reads the corpus."""
        self._reader = reader
        self._random = random.Random(seed)
        self._corpus_folder, self._finds = folder / "corpus", folder / "finds"
        for path in (self._corpus_folder, self._finds):
            path.mkdir(parents=True, exist_ok=True)
        self._corpus: list[bytes] = []
        self._seen: set[Step] = set()
        self._tried = 0

    def run(self, goes_on: Callable[[int], bool]) -> Outcome:
        """Goes on until it is told not to, or until an input does harm.

        Args:
            goes_on: Whether to; it is given the number of inputs so far.
        """
        with tempfile.TemporaryDirectory() as folder:
            for data in self._inputs(goes_on):
                if words := self._try(data, Path(folder)):
                    return self._outcome(_kept(self._finds, data), words)
        return self._outcome(None, "")

    def _inputs(self, goes_on: Callable[[int], bool]) -> Iterator[bytes]:
        yield from self._reader.samples
        for path in sorted(self._corpus_folder.iterdir()):
            yield path.read_bytes()
        while goes_on(self._tried):
            yield self._damaged(self._random.choice(self._corpus or self._reader.samples))

    def _try(self, data: bytes, folder: Path) -> str:
        reached: set[Step] = set()
        words = harm(self._reader, data, folder, reached)
        self._tried += 1
        if not reached <= self._seen and not words:
            self._corpus.append(data)
            _kept(self._corpus_folder, data)
        self._seen |= reached
        return words

    def _outcome(self, find: Path | None, words: str) -> Outcome:
        return Outcome(self._tried, len(self._seen), len(self._corpus), find, words)

    def _damaged(self, data: bytes) -> bytes:
        for _ in range(self._random.choice(EDITS)):
            data = self._edited(data)
        return data[:SIZE_MAX]

    def _edited(self, data: bytes) -> bytes:
        at = self._random.randint(0, len(data))
        if self._random.random() < 0.5 and (words := list(_WORD.finditer(data))):
            start, end = self._random.choice(words).span()
        else:
            start, end = at, at + self._random.choice((0, 1, self._random.randint(0, CUT_MAX)))
        return data[:start] + self._instead() + data[end:]

    def _instead(self) -> bytes:
        """What to put in the place of something else: trouble, chance, nothing, a word or a part of a sample."""
        other = self._random.choice(self._corpus or self._reader.samples)
        at = self._random.randint(0, len(other))
        kind = self._random.randrange(5)
        if kind == 0:
            return self._random.choice(TROUBLE)
        if kind == 1:
            return self._random.randbytes(self._random.randint(1, 8))
        if kind == 2 and (words := _WORD.findall(other[at : at + 200])):
            return bytes(self._random.choice(words))
        return other[at : at + self._random.randint(1, 200)] if kind == 3 else b""


def harm(reader: Reader, data: bytes, folder: Path, reached: set[Step] | None = None) -> str:
    """What an input does that it must not: in words; empty if it is read, or refused in one line.

    Args:
        reader: The reader.
        data: The input.
        folder: For a file.
        reached: Is given the steps of the project's code that are run.
    """
    try:
        with _tracing(reached), _time_limit():
            reader.read(data, folder)
    except reader.refuses as error:
        words = str(error).strip()
        return "" if words and "\n" not in words else f"refused in words that are not one line: {words!r}"
    except (Exception, HangError) as error:
        return f"{type(error).__name__}: {error}"
    return ""


def lasting(seconds: float) -> Callable[[int], bool]:
    """Goes on for so long."""
    end = time.monotonic() + seconds
    return lambda _: time.monotonic() < end


def _kept(folder: Path, data: bytes) -> Path:
    path = folder / hashlib.sha256(data).hexdigest()[:16]
    path.write_bytes(data)
    return path


@contextmanager
def _tracing(reached: set[Step] | None) -> Iterator[None]:
    if reached is None:
        yield
        return

    last = 0

    def line(frame: FrameType, _event: str, _argument: Any) -> Any:
        nonlocal last
        reached.add((frame.f_code, last, frame.f_lineno))
        last = frame.f_lineno
        return line

    def call(frame: FrameType, event: str, argument: Any) -> Any:
        return line(frame, event, argument) if frame.f_code.co_filename.startswith(_OURS) else None

    before = sys.gettrace()
    sys.settrace(call)
    try:
        yield
    finally:
        sys.settrace(before)


@contextmanager
def _time_limit() -> Iterator[None]:
    def hang(_number: int, _frame: FrameType | None) -> None:
        raise HangError(f"no end within {TIMEOUT_S} s")

    before = signal.signal(signal.SIGALRM, hang)
    signal.setitimer(signal.ITIMER_REAL, TIMEOUT_S)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
