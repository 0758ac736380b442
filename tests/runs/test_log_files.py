"""Logs that are compressed, cut off, of another protocol, or none."""

import gzip
import json
from pathlib import Path

import pytest

from host_sim.client.frame_log import FrameLog
from host_sim.protocol.codec import crc8
from host_sim.recording.log_reader import read_log
from host_sim.recording.resimulation import resimulate
from tests.runs.endurance.interrupted_runs import Witness, run_interrupted, with_full_disk
from tests.runs.support import octet, start_octet, wait_until

SHORT = ("--environments", "1", "--limit-s", "20", "--bus", "none", "--quiet")
FILES = {"run.world.json", "summary.json", "arena.png", "replay.html"}
KEPT_BACK = 1 << 16


@pytest.fixture(scope="module")
def plain(tmp_path_factory) -> Path:
    out = tmp_path_factory.mktemp("plain")
    assert octet("run", *SHORT, "--out", out).returncode == 0
    return out


def test_it_has_the_same_lines_and_the_same_digest(plain, tmp_path):
    assert octet("run", *SHORT, "--compress-log", "--out", tmp_path).returncode == 0

    digests = {json.loads((out / "summary.json").read_text())["log_sha256"] for out in (plain, tmp_path)}
    assert {path.name for path in tmp_path.iterdir()} == {"run.log.gz", *FILES}
    assert gzip.decompress((tmp_path / "run.log.gz").read_bytes()) == (plain / "run.log").read_bytes()
    assert len(digests) == 1
    assert octet("replay", tmp_path / "run.log.gz").returncode == 0


def test_it_replaces_a_plain_one_and_the_other_way_round(tmp_path):
    for words, name in (((), "run.log"), (("--compress-log",), "run.log.gz"), ((), "run.log")):
        done = octet("run", *SHORT[:-1], *words, "--out", tmp_path)

        assert {path.name for path in tmp_path.iterdir()} == {name, *FILES}
        assert f"{tmp_path / name}\n" in done.stdout
    assert f"replaced  the run in {tmp_path} (seed 1), which" in done.stdout


def test_wherever_it_is_cut_off_what_is_there_is_read(plain, tmp_path):
    text, cut = (plain / "run.log").read_bytes(), tmp_path / "run.log.gz"
    log = FrameLog(cut)
    for line in text.splitlines(keepends=True):
        log.add_block(line)
    log.close()
    whole, frames = cut.read_bytes(), list(read_log(plain / "run.log"))
    for size in range(200, len(whole), len(whole) // 25):
        cut.write_bytes(whole[:size])

        read = list(read_log(cut))

        assert frames[: len(read)] == read
        assert len(read) > 0


def test_of_a_run_that_was_killed_all_but_the_last_64_kb_are_there(tmp_path):
    part = tmp_path / "run.log.gz.part"
    long = ("--environments", "30", "--bus", "fd", "--quiet")
    process = start_octet("run", *long, "--compress-log", "--out", tmp_path)
    wait_until(lambda: part.exists() and part.stat().st_size > KEPT_BACK, f"64 kB in {part}")

    process.kill()
    process.communicate()

    replayed = octet("replay", part)
    assert replayed.returncode == 0, replayed.stderr
    assert "; the log ends before the run does" in replayed.stdout
    assert resimulate(part, ignore_world=True).trajectory.ticks > 1000


@pytest.mark.parametrize("size", [3000, 30_000])
def test_on_a_full_disk_the_run_ends_in_order_and_what_fitted_can_be_read(tmp_path, size):
    witness = Witness()

    outcome = run_interrupted(tmp_path, with_full_disk(size), witness, "--compress-log")

    part = tmp_path / "out/run.log.gz.part"
    assert (outcome.status, outcome.is_orderly) == (1, True), outcome.errors
    assert part.stat().st_size == size
    assert sum(1 for _ in read_log(part)) > size // 40


NO_LOGS = {
    "missing": None,
    "empty": b"",
    "binary": bytes(range(256)),
    "something else": b"hello\n",
    "without a heartbeat": b"(0000000000.000000) octet 0C1#9100000000000000\n",
}


@pytest.mark.parametrize("content", NO_LOGS.values(), ids=NO_LOGS.keys())
def test_a_replay_of_no_log_says_so_in_one_line(tmp_path, content):
    log = tmp_path / "run.log"
    if content is not None:
        log.write_bytes(content)

    done = octet("replay", log)

    assert done.returncode == 2
    assert done.stderr.startswith("octet: ")
    assert done.stderr.count("\n") == 1
    assert str(log) in done.stderr


def test_the_replay_of_several_robots_names_each(run):
    done = run("--environments", "1", "--bus", "none", "--limit-s", "2", "--robots", "2", "--node", "3")

    replayed = octet("replay", done.out / "run.log", "--node", "3")

    log = done.out / "run.log"
    assert replayed.stdout == "".join(f"{log}, node {node}: 100 drives, no difference\n" for node in (3, 4))


@pytest.mark.parametrize("cut_off", [1, 7, 30, 50, 70, 90, 110])
def test_a_log_cut_anywhere_is_compared_as_far_as_it_goes(run, tmp_path, cut_off):
    done = run("--environments", "1", "--bus", "none", "--limit-s", "2")
    cut = tmp_path / "cut.log"
    cut.write_bytes(done.log[: len(done.log) // 2 - cut_off])

    replayed = octet("replay", cut)

    assert (replayed.returncode, replayed.stderr) == (0, "")
    assert "no difference; the log ends before the run does" in replayed.stdout
    page = octet("replay", cut, "--html", tmp_path / "cut.html")
    assert page.returncode == 0
    assert page.stderr == f"octet: {cut} ends before the run does; showing what it has\n"


def with_another_layout(line: str) -> str:
    """A heartbeat of a robot whose messages lie elsewhere."""
    head, data = line.rstrip("\n").split("#")
    frame_id, content = int(head[-3:], 16), bytes.fromhex(data)[:-2] + bytes(2)
    return f"{head}#{crc8(frame_id, content):02X}{content[1:].hex().upper()}\n"


def test_a_log_of_another_protocol_is_refused(run, tmp_path):
    done = run("--environments", "1", "--bus", "none", "--limit-s", "2")
    other = tmp_path / "other.log"
    lines = done.log.decode().splitlines(keepends=True)
    other.write_text("".join(with_another_layout(line) if " 6A1#" in line else line for line in lines))

    replayed = octet("replay", other)

    assert replayed.returncode == 2
    assert "another octet.dbc" in replayed.stderr
