"""The readers of files, orders and rules that are fuzzed in Python: samples for each, and how it refuses."""

import gzip
import hashlib
import io
import random
import re
import signal
import sys
import tempfile
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from types import CodeType, FrameType
from typing import Any, NamedTuple

import can

from host_sim.base.errors import OctetError
from host_sim.lab.campaign.cell import Cell
from host_sim.lab.study.folder import USED_SEEDS, read_used
from host_sim.lab.study.plan import read_plan
from host_sim.live.page_commands import page_command_from
from host_sim.recording.log_reader import read_log
from host_sim.recording.memory_file import load_memory
from host_sim.recording.world_file import read_world
from host_sim.transport.rule import Rule, read_rules
from host_sim.world.changes import read_changes
from host_sim.world.worlds import world_of
from tools.robot_words.description import DescriptionError
from tools.robot_words.model import read as read_description

ROOT = Path(__file__).resolve().parents[2]
DATA = ROOT / "tests/recording/data"
WORLDS = ROOT / "docs/worlds"
DBC, WORDS = ROOT / "hal/protocol/octet.dbc", ROOT / "hal/protocol/robot.toml"
ASC = b"""\
date Sat Nov 21 10:00:00.000 am 2026
base hex  timestamps absolute
   0.000000 1  100             Rx   d 8 8A 10 00 00 00 00 F0 00
   0.020000 1  040             Rx   d 8 C2 11 64 00 64 00 D0 00
"""


@dataclass(frozen=True)
class Reader:
    """What reads samples, and how it refuses."""

    samples: Sequence[bytes]
    read: Callable[[bytes, Path], Any]
    refuses: type[Exception] = OctetError


def in_file(name: str, read: Callable[[Path], Any]) -> Callable[[bytes, Path], Any]:
    def read_from(data: bytes, folder: Path) -> Any:
        path = folder / name
        path.write_bytes(data)
        return read(path)

    return read_from


def as_text(read: Callable[[str], Any]) -> Callable[[bytes, Path], Any]:
    return lambda data, _folder: read(data.decode("utf-8", "replace"))


def recorded(name: str) -> bytes:
    return (DATA / name).read_bytes()[:4000]


class _Kept(io.BytesIO):
    """What is written can be had when the writer has closed it."""

    def close(self) -> None:
        pass


def as_blf(frames: int = 20) -> bytes:
    file = _Kept()
    writer = can.BLFWriter(file)
    for number in range(frames):
        sent = can.Message(timestamp=number / 50, arbitration_id=257, data=bytes(8), is_extended_id=False)
        writer.on_message_received(sent)
    writer.stop()
    return file.getvalue()


def log(name: str) -> Callable[[bytes, Path], Any]:
    return in_file(name, lambda path: list(read_log(path)))


def contents(*places: Iterable[Path]) -> list[bytes]:
    return [path.read_bytes() for paths in places for path in sorted(paths)]


def in_list(read: Callable[[str], Any]) -> Callable[[bytes, Path], Any]:
    return in_file("list.txt", lambda path: read(f"@{path}"))


LOG = b"".join(recorded("a_gap.log").splitlines(keepends=True)[:40])
WORLD = b"""\
{"format": 1, "seed": 1, "of": 1, "limit_ticks": 150, "robots": 1, "front_extra_mm": 0.5,
 "environments": [{"seed": 1, "number": 1, "first_tick": 0}],
 "edits": [{"tick": 50, "do": "plant", "at": [2761, 2403], "radius": 80}]}
"""
MEMORIES = [
    bytes(cells) for cells in ((0, 1, 2, 1, 2, 1, 2, 1), (0, 5, 6, 9, 10, 13, 14, 0), (15, 0, 36, 0, 0, 0, 0, 0))
]
ORDERS = b"""\
{"do": "write", "cell": 3, "side": 1, "node": 1}
{"do": "speed", "factor": 0.5}
{"do": "seed", "seed": 7, "keep": 1}
{"do": "freeze", "on": 1}
{"do": "erase"}
{"do": "next"}
{"do": "decision"}
{"do": "pause"}
{"do": "lift", "robot": 1}
{"do": "put", "at": [500, 600], "heading": -1571}
{"do": "add_bar", "a": [500, 600], "b": [700, 800]}
{"do": "move_bar", "id": 1, "a": [500, 600], "b": [700, 800]}
{"do": "move_food", "id": 2, "at": [500, 600]}
{"do": "plant", "at": [500, 600], "radius": 100}
{"do": "grow_plant", "id": 0, "radius": 120}
{"do": "remove_plant", "id": 0}
{"do": "body", "what": "swap-motors", "seed": 3}
""".splitlines()
FAULTS = b"""\
corrupt:20%:3@5-90/to
drop:5%
delay:2@300/from
forge:stop@300/to
""".splitlines()
CELLS = [b"article fd lockstep seed=12 limit=4 fault=drop:10% change=swap-motors@2s event=hang:300@100"]
CHANGES = [(ROOT / "docs/worlds/day.txt").read_bytes(), b"swap-motors@env2+3.5s\nrepair@40s\n"]
READERS = {
    "log": Reader([LOG], log("run.log")),
    "log_gz": Reader([gzip.compress(LOG, mtime=0)], log("run.log.gz")),
    "log_asc": Reader([ASC], log("run.asc")),
    "log_blf": Reader([as_blf()], log("run.blf")),
    "memory": Reader(MEMORIES, in_file("robot.mem", load_memory)),
    "world_file": Reader([WORLD], in_file("run.world.json", read_world)),
    "world": Reader(contents(WORLDS.glob("*.toml")), in_file("my.toml", lambda path: world_of(str(path)))),
    "study": Reader(
        contents({*(ROOT / "studies").glob("*.toml")} - {USED_SEEDS}),
        in_file("study.toml", read_plan),
    ),
    "used_seeds": Reader([USED_SEEDS.read_bytes()], in_file("used.toml", read_used)),
    "order": Reader(ORDERS, as_text(page_command_from), ValueError),
    "changes": Reader(CHANGES, in_list(read_changes)),
    "fault": Reader(FAULTS, as_text(Rule.parse)),
    "faults": Reader([b"\n".join(FAULTS)], in_list(read_rules)),
    "campaign": Reader(CELLS, as_text(Cell.parse)),
    "dbc": Reader([DBC.read_bytes()], in_file("my.dbc", lambda it: read_description(it, WORDS)), DescriptionError),
    "words": Reader([WORDS.read_bytes()], in_file("my.toml", lambda it: read_description(DBC, it)), DescriptionError),
}


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
"""Texts that often cause trouble for readers."""

_WORD = re.compile(rb"[A-Za-z_]+|-?[0-9.]+|\"[^\"]*\"")
_OURS = (f"{ROOT}/host_sim/", f"{ROOT}/tools/")

Step = tuple[CodeType, int, int]
"""From a line to the next one that runs, in the function of the latter."""


class HangError(BaseException):
    """A reader took too long. No reader mistakes it for one of its own errors."""


class Outcome(NamedTuple):
    """The result of fuzzing.

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
        """Continues until told to stop, or until an input does harm.

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
