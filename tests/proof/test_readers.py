"""Whatever is in a file, an order of the page or a rule: it is read, or refused with an error that a user can read.

Each reader gets samples with random damage: bytes cut out, changed, or put in from a list of troublesome ones.
"""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import hypothesis
import pytest
from hypothesis import strategies as st

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
TROUBLE = st.sampled_from(
    [
        *(
            b"\x00",
            b"\xff",
            b"\xfe\xff",
            b"\r",
            b"\n\n",
            b"\t",
            b'"',
            b"'",
            b"\\",
            b"{",
            b"}",
            b"[[",
            b"]",
            b"#",
            b";",
            b"(",
        ),
        *(
            b"-1",
            b"1e999",
            b"NaN",
            b"null",
            b"true",
            b"0x",
            b"99999999999999999999",
            b"%s",
            b"../..",
            b"=",
            b":",
            b"@",
            b"%",
        ),
        *(b"\xe2\x80\xae", b"\xd9\xa3", "²".encode(), b"[" * 3000),
    ]
)
EDITS = st.lists(
    st.tuples(st.integers(0, 30000), st.integers(0, 20), st.one_of(TROUBLE, st.binary(max_size=8))),
    min_size=1,
    max_size=6,
)


def damaged(sample: bytes, edits: list[tuple[int, int, bytes]]) -> bytes:
    for where, length, instead in edits:
        at = where % (len(sample) + 1)
        sample = sample[:at] + instead + sample[at + length :]
    return sample


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


@dataclass(frozen=True)
class Reader:
    """What reads a sample, and how it refuses."""

    sample: bytes
    read: Callable[[bytes, Path], Any]
    refuses: type[Exception] = OctetError


WORLD = (ROOT / "docs/worlds/two_walls.toml").read_bytes()
STUDY = (ROOT / "studies/learned.toml").read_bytes()
ORDER = b'{"do": "write", "cell": 3, "side": 1, "node": 1}'
READERS = {
    "log": Reader(recorded("wire_1_three_robots.log"), in_file("run.log", lambda path: list(read_log(path)))),
    "log of asc": Reader(ASC, in_file("run.asc", lambda path: list(read_log(path)))),
    "memory": Reader(bytes([0, 1, 2, 1, 2, 1, 2, 1]), in_file("robot.mem", load_memory)),
    "record of worlds": Reader(recorded("wire_1_three_robots.world.json"), in_file("run.world.json", read_world)),
    "world": Reader(WORLD, in_file("my.toml", lambda path: world_of(str(path)))),
    "study": Reader(STUDY, in_file("study.toml", read_plan)),
    "order": Reader(ORDER, as_text(page_command_from), ValueError),
    "DBC": Reader(DBC.read_bytes(), in_file("my.dbc", lambda path: read_description(path, WORDS)), DescriptionError),
    "words": Reader(
        WORDS.read_bytes(), in_file("my_words.toml", lambda path: read_description(DBC, path)), DescriptionError
    ),
    "fault": Reader(b"corrupt:20%:3@5-90/to", as_text(Rule.parse)),
}


@pytest.mark.parametrize("name", READERS)
@hypothesis.settings(max_examples=100, derandomize=True, suppress_health_check=list(hypothesis.HealthCheck))
@hypothesis.given(edits=EDITS)
def test_what_is_damaged_is_read_or_refused_in_one_line(tmp_path_factory, name, edits):
    reader = READERS[name]
    words = "read"
    try:
        reader.read(damaged(reader.sample, edits), tmp_path_factory.getbasetemp())
    except reader.refuses as error:
        words = str(error).strip()

    assert words
    assert "\n" not in words


@pytest.mark.parametrize("name", READERS)
def test_the_samples_themselves_are_read(tmp_path, name):
    READERS[name].read(READERS[name].sample, tmp_path)
