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


def cut_inside_its_first_line(log: Path) -> None:
    log.write_bytes(log.read_bytes()[:20])


def cut_before_the_first_tick(log: Path) -> None:
    log.write_text("".join(log.read_text().splitlines(keepends=True)[:7]))


def make_binary(log: Path) -> None:
    log.write_bytes(bytes(range(256)) * 8)


def make_text(log: Path) -> None:
    log.write_text("Dear robot,\nhow are you?\n")


def make_empty(log: Path) -> None:
    log.write_bytes(b"")


def remove(log: Path) -> None:
    log.unlink()


def make_folder(log: Path) -> None:
    log.unlink()
    log.mkdir()


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


def let_the_world_begin_later(log: Path) -> None:
    change_world(log, environments=[{"seed": 333, "number": 1, "first_tick": 9}])


def edit_what_cannot_be(log: Path) -> None:
    change_world(log, edits=[{"tick": 50, "do": "remove_bar", "id": 77}])


def make_world_no_json(log: Path) -> None:
    world_path(log).write_text("{")


def make_world_folder(log: Path) -> None:
    world_path(log).unlink()
    world_path(log).mkdir()


BAD = {
    cut_inside_its_first_line: (2, "no whole line"),
    cut_before_the_first_tick: (2, "no tick"),
    make_binary: (2, "it is not text"),
    make_text: (2, "line 1"),
    make_empty: (2, "empty"),
    remove: (2, "there is no file"),
    make_folder: (2, "it is a folder"),
    make_other_protocol: (2, "another octet.dbc"),
    take_the_world_of_another_seed: (1, "not recorded in the world of"),
    let_the_world_begin_later: (1, "begins later"),
    edit_what_cannot_be: (1, "there is no such number"),
    make_world_no_json: (2, "not a world file"),
    make_world_folder: (2, "it is a folder"),
}


@pytest.mark.parametrize("command", [["replay", "--html"], ["picture", "--png"]], ids=["page", "picture"])
@pytest.mark.parametrize("spoil", BAD, ids=lambda spoil: spoil.__name__)
def test_log_without_a_run_is_refused_in_one_line(short, tmp_path, capsys, spoil, command):
    code, named = BAD[spoil]
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
