"""Logs of earlier versions, whose messages were laid out as today's, are still good.

`data/version_1_0.log` is a run of 5 s in which the robot learned one cell; its HEARTBEATs carry the hash of the DBC
file of that time.
"""

from pathlib import Path

import pytest

from host_sim.errors import OctetError
from host_sim.protocol.codec import Protocol
from host_sim.protocol.generated import LAYOUT_HASH
from host_sim.recording.log_reader import read_log
from host_sim.recording.replay import replay
from host_sim.recording.resimulation import resimulate

OLD = Path(__file__).with_name("data") / "version_1_0.log"
HASH = 0x7827
DRIVES = 250


def test_the_old_log_has_a_hash_of_its_own_time():
    messages = [Protocol().decode(line.frame) for line in read_log(OLD)]

    assert {message.signals["dbc_hash"] for message in messages if message.name == "HEARTBEAT"} == {HASH}
    assert HASH != LAYOUT_HASH


def test_an_old_log_replays_without_a_difference():
    outcome = replay(OLD, list(read_log(OLD)), Protocol())

    assert (outcome.drives, outcome.difference) == (DRIVES, None)


def test_an_old_log_is_found_again_in_its_world():
    result = resimulate(OLD)

    assert (result.seed, result.stopped) == (21, True)


def test_an_old_log_with_two_drives_exchanged_differs(tmp_path):
    changed = tmp_path / "changed.log"
    lines = OLD.read_text().splitlines(keepends=True)
    drives = [i for i, line in enumerate(lines) if " 081#" in line]
    lines[drives[100]], lines[drives[101]] = lines[drives[101]], lines[drives[100]]
    changed.write_text("".join(lines))

    assert replay(changed, list(read_log(changed)), Protocol()).difference is not None


def test_a_log_with_a_hash_of_no_layout_known_is_refused(tmp_path):
    other = tmp_path / "other.log"
    other.write_text(OLD.read_text().replace("2778\n", "2779\n"))

    with pytest.raises(OctetError, match=r"another octet\.dbc"):
        replay(other, list(read_log(other)), Protocol())
