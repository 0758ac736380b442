"""Logs and world files that are none get one clear line that says what to do.

Large logs: how far it is with one is shown, what one unpacks to is limited, and no more than a line is kept.
"""

import gzip
import json
import lzma
import re
import tracemalloc
from pathlib import Path

import pytest

from host_sim.base.errors import UsageError
from host_sim.base.terminal import SOON_S, ProgressLine
from host_sim.cli.main import main
from host_sim.client.frame_log import line_of
from host_sim.protocol.codec import Protocol, crc8
from host_sim.recording import log_files
from host_sim.recording.log_reader import read_log
from host_sim.recording.world_file import world_path


def make_folder(path: Path) -> None:
    path.unlink()
    path.mkdir()


def make_other_protocol(log: Path) -> None:
    """As one that was recorded with another octet.dbc."""
    heartbeat = Protocol().id_of("HEARTBEAT")
    lines = []
    for time_us, recorded in read_log(log):
        frame = recorded
        if frame.id == heartbeat:
            other = frame.data[:-2] + bytes(byte ^ 0xFF for byte in frame.data[-2:])
            frame = frame._replace(data=bytes((crc8(frame.id, other),)) + other[1:])
        lines.append(line_of(time_us, frame))
    log.write_text("".join(f"{line}\n" for line in lines))


def change_world(log: Path, **fields: object) -> None:
    path = world_path(log)
    path.write_text(json.dumps({**json.loads(path.read_text()), **fields}))


def take_the_world_of_another_seed(log: Path) -> None:
    change_world(log, environments=[{"seed": 5, "number": 1, "first_tick": 0}])


BAD = {
    "cut inside its first line": (lambda log: log.write_bytes(log.read_bytes()[:20]), 2, "no whole line"),
    "cut before the first tick": (lambda log: log.write_text(re.match(".*\n" * 7, log.read_text())[0]), 2, "no tick"),
    "binary": (lambda log: log.write_bytes(bytes(range(256)) * 8), 2, "it is not text"),
    "text": (lambda log: log.write_text("Dear robot,\nhow are you?\n"), 2, "line 1"),
    "empty": (lambda log: log.write_bytes(b""), 2, "empty"),
    "removed": (Path.unlink, 2, "there is no file"),
    "folder": (make_folder, 2, "it is a folder"),
    "other protocol": (make_other_protocol, 2, "another octet.dbc"),
    "world of another seed": (take_the_world_of_another_seed, 1, "not recorded in the world of"),
    "world that begins later": (
        lambda log: change_world(log, environments=[{"seed": 333, "number": 1, "first_tick": 9}]),
        1,
        "begins later",
    ),
    "edit that cannot be": (
        lambda log: change_world(log, edits=[{"tick": 50, "do": "remove_bar", "id": 77}]),
        1,
        "there is no such number",
    ),
    "world no JSON": (lambda log: world_path(log).write_text("{"), 2, "not a world file"),
    "world folder": (lambda log: make_folder(world_path(log)), 2, "it is a folder"),
}


@pytest.mark.parametrize("command", [["replay", "--html"], ["picture", "--png"]], ids=["page", "picture"])
@pytest.mark.parametrize("bad", BAD)
def test_log_without_a_run_is_refused_in_one_line(short, tmp_path, capsys, bad, command):
    spoil, code, named = BAD[bad]
    spoil(short.log)
    made = tmp_path / "made"

    assert main([command[0], str(short.log), command[1], str(made)]) == code

    message = capsys.readouterr().err
    assert re.fullmatch(r"octet: .*\n", message)
    assert named in message
    assert not made.exists()


def test_log_in_a_wrong_world_can_be_drawn_without_the_world(short, tmp_path):
    take_the_world_of_another_seed(short.log)

    assert main(["replay", str(short.log), "--no-world", "--html", str(tmp_path / "page.html")]) == 0


@pytest.mark.parametrize("pack", [bytes, gzip.compress, lzma.compress])
def test_reading_a_long_log_shows_progress(tmp_path, monkeypatch, pack):
    shown: list[tuple[str, int, int]] = []

    class Line(ProgressLine):
        def __init__(self, total: int, after_s: float) -> None:
            super().__init__(shown=False)
            self.total = total
            assert after_s == SOON_S

        def is_due(self) -> bool:
            return True

        def show(self, text: str, done: int = 0) -> None:
            shown.append((text, done, self.total))

    monkeypatch.setattr(log_files, "ProgressLine", Line)
    path = tmp_path / "a.log"
    path.write_bytes(pack(b"".join(b"(%d.000000) can0 123#%04X\n" % (i, i % 65536) for i in range(20_000))))

    assert sum(1 for _ in log_files.frames_in(path)) == 20_000
    assert {(text, total) for text, _, total in shown} == {(f"reading {path}", path.stat().st_size)}
    assert shown[-1][1] == path.stat().st_size
    assert len(shown) > 1


def test_log_that_is_too_large_when_unpacked_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(log_files, "_SIZE_MAX", 1_000_000)
    path = tmp_path / "a.log.gz"
    path.write_bytes(gzip.compress(b"(1.000000) can0 123#00\n" * 60_000))

    with pytest.raises(UsageError, match=r"a.log.gz: it is larger than 1,000,000 bytes when it is unpacked$"):
        sum(1 for _ in log_files.frames_in(path))


@pytest.mark.parametrize("name", ["big.log", "big.log.gz"])
def test_log_is_read_line_by_line(tmp_path, name):
    path = tmp_path / name
    text = b"(1795285590.648617) can0 682#C311000000000000\n" * 60_000
    path.write_bytes(gzip.compress(text, 1) if name.endswith(".gz") else text)
    assert len(text) > 2_500_000

    tracemalloc.start()
    count = sum(1 for _ in read_log(path))
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()

    assert count == 60_000
    assert peak < 500_000
