"""A replay of what is no log, is cut off, or is of another protocol, says so."""

import pytest

from host_sim.protocol.codec import crc8
from tests.runs.support import octet

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
