"""The readers of files, orders and rules that are fuzzed in Python: samples for each, and how it refuses."""

import gzip
import io
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import can

from host_sim.errors import OctetError
from host_sim.faults.rule import Rule
from host_sim.live.page_commands import page_command_from
from host_sim.recording.log_reader import read_log
from host_sim.recording.memory_file import load_memory
from host_sim.recording.world_file import read_world
from host_sim.study.plan_file import read_plan
from host_sim.world.worlds import world_of
from tools.robot_words.model import DescriptionError
from tools.robot_words.model import read as read_description

ROOT = Path(__file__).resolve().parents[2]
DATA = ROOT / "tests/recording/data"
DBC, WORDS = ROOT / "hal/protocol/octet.dbc", ROOT / "hal/protocol/robot.toml"
ASC = b"""\
date Sat Nov 21 10:00:00.000 am 2026
base hex  timestamps absolute
   0.000000 1  100             Rx   d 8 8A 10 00 00 00 00 F0 00
   0.020000 1  040             Rx   d 8 C2 11 64 00 64 00 D0 00
"""


@dataclass(frozen=True)
class Reader:
    """What reads a sample, and how it refuses."""

    sample: bytes
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


WORLD = (ROOT / "docs/worlds/two_walls.toml").read_bytes()
LOG = recorded("wire_1_three_robots.log")
ORDER = b'{"do": "write", "cell": 3, "side": 1, "node": 1}'
READERS = {
    "log": Reader(LOG, log("run.log")),
    "log_gz": Reader(gzip.compress(LOG, mtime=0), log("run.log.gz")),
    "log_asc": Reader(ASC, log("run.asc")),
    "log_blf": Reader(as_blf(), log("run.blf")),
    "memory": Reader(bytes([0, 1, 2, 1, 2, 1, 2, 1]), in_file("robot.mem", load_memory)),
    "world_file": Reader(recorded("wire_1_three_robots.world.json"), in_file("run.world.json", read_world)),
    "world": Reader(WORLD, in_file("my.toml", lambda path: world_of(str(path)))),
    "study": Reader((ROOT / "studies/learned.toml").read_bytes(), in_file("study.toml", read_plan)),
    "order": Reader(ORDER, as_text(page_command_from), ValueError),
    "dbc": Reader(DBC.read_bytes(), in_file("my.dbc", lambda path: read_description(path, WORDS)), DescriptionError),
    "words": Reader(
        WORDS.read_bytes(), in_file("my.toml", lambda path: read_description(DBC, path)), DescriptionError
    ),
    "fault": Reader(b"corrupt:20%:3@5-90/to", as_text(Rule.parse)),
}
