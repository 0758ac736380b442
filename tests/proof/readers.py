"""The readers of files, orders and rules that are fuzzed in Python: samples for each, and how it refuses."""

import gzip
import io
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import can

from host_sim.base.errors import OctetError
from host_sim.lab.campaign.cell import Cell
from host_sim.lab.study import used_seeds
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
        contents({*(ROOT / "studies").glob("*.toml")} - {ROOT / "studies/used_seeds.toml"}),
        in_file("study.toml", read_plan),
    ),
    "used_seeds": Reader([used_seeds.FILE.read_bytes()], in_file("used.toml", used_seeds.read_used)),
    "order": Reader(ORDERS, as_text(page_command_from), ValueError),
    "changes": Reader(CHANGES, in_list(read_changes)),
    "fault": Reader(FAULTS, as_text(Rule.parse)),
    "faults": Reader([b"\n".join(FAULTS)], in_list(read_rules)),
    "campaign": Reader(CELLS, as_text(Cell.parse)),
    "dbc": Reader([DBC.read_bytes()], in_file("my.dbc", lambda it: read_description(it, WORDS)), DescriptionError),
    "words": Reader([WORDS.read_bytes()], in_file("my.toml", lambda it: read_description(DBC, it)), DescriptionError),
}
