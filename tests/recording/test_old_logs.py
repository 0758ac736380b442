"""Logs of earlier versions are still good: `convert` writes every frame of wire 1 anew as frames of today's.

`data/version_1_0.log` is a run of 2 s in which the robot learned one cell; its HEARTBEATs carry the hash of the DBC
file of that time. The other logs are of the last version with wire 1.
"""

from collections import Counter
from pathlib import Path

import pytest

from host_sim.base.errors import OctetError
from host_sim.cli.main import main
from host_sim.protocol.codec import COUNTERS, Frame, Protocol, crc8
from host_sim.protocol.every_node import hear
from host_sim.protocol.generated import TICK_SPAN, Opcode, Reason
from host_sim.recording.log_reader import read_log
from host_sim.recording.log_text import Recorded
from host_sim.recording.replay import replay
from host_sim.recording.resimulation import resimulate
from host_sim.recording.wire_1 import OldLog, Transcoder
from host_sim.recording.world_file import world_path

OLD = Path(__file__).with_name("data") / "version_1_0.log"
DRIVES = 100


def transcoded(*lines: str, transcoder: Transcoder | None = None) -> list[tuple[str, dict[str, int]]]:
    """What frames of wire 1 say today. Their CRC is put right."""
    transcoder = transcoder or Transcoder()
    said = []
    for line in lines:
        identifier, _, digits = line.partition("#")
        frame = Frame(int(identifier, 16), bytes.fromhex(digits))
        crc = crc8(frame.id ^ 0xFF, frame.data) ^ 0xFF
        right = frame._replace(data=bytes([crc]) + frame.data[1:]) if frame.id < 0x141 else frame
        said += [hear(it.frame) for it in transcoder.transcode(Recorded(0, right))]
    assert all(it.node == 1 for it in said)
    return [(it.name, it.signals) for it in said]


@pytest.fixture
def convert(tmp_path):
    """Converts a log as a person does; returns the new one."""

    def converted(old: Path) -> Path:
        new = tmp_path / "new" / "run.log"
        new.parent.mkdir(exist_ok=True)
        assert main(["convert", str(old), str(new)]) == 0
        return new

    return converted


@pytest.mark.parametrize("name", ["version_1_0.log", "wire_1_three_robots.log", "wire_1_own_clock.log"])
@pytest.mark.parametrize("command", ["replay", "picture", "load", "export"])
def test_an_old_log_is_refused_with_the_command_that_converts_it(name, command, capsys, tmp_path):
    old = OLD.with_name(name)
    options = {"export": ["--csv", str(tmp_path / "a.csv")], "picture": ["--png", str(tmp_path / "a.png")]}

    assert main([command, str(old), *options.get(command, [])]) == 2
    assert f"octet: {old} was recorded with wire 1: convert it with tools/octet convert {old} NEW.log" in (
        capsys.readouterr().err
    )
    assert list(tmp_path.iterdir()) == []


def test_a_log_of_today_is_not_converted(kept, capsys, tmp_path):
    assert main(["convert", str(kept.log), str(tmp_path / "new.log")]) == 2

    assert "has no heartbeat of wire 1" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_an_old_log_is_not_written_over(capsys):
    before = OLD.read_bytes()

    assert main(["convert", str(OLD), str(OLD)]) == 2
    assert "is the input of convert: choose another file" in capsys.readouterr().err
    assert before == OLD.read_bytes()


def test_every_frame_of_an_old_log_is_a_whole_one_of_today(convert):
    log = read_log(convert(OLD))

    heard = [hear(line.frame) for line in log]

    assert log.note() is None
    assert all(it.signals is not None for it in heard)
    assert sum(it.name == "DRIVE" for it in heard) == sum(it.name == "SENSES" for it in heard) == DRIVES


@pytest.mark.parametrize("name", ["SENSES", "DRIVE", "COMMAND", "HEARTBEAT", "HEALTH"])
def test_counters_go_on(name):
    heard = (hear(line.frame) for line in OldLog(OLD))
    counters = [it.signals["counter"] for it in heard if it.name == name]

    assert len(counters) > 1
    assert counters == [(counters[0] + i) % COUNTERS for i in range(len(counters))]


def test_what_a_message_of_wire_1_said_is_said_today():
    (senses,) = transcoded("0C1#000401F27B321E2C")
    assert senses[0] == "SENSES"
    assert senses[1]["tick"] == 0x104 % TICK_SPAN
    assert senses[1].items() >= {"feel": 0, "bump": 1, "look": 0, "beacon": 0xF7E, "odometer_left": 0xE32}.items()

    (drive,) = transcoded("081#0000403600CEFF05")
    assert drive[1].items() >= {"reason": 4, "left": 0x36, "right": -0x320, "repeat_count": 255, "eat": 1}.items()

    (faults, more) = transcoded("1C1#0102030405060708")
    assert (faults[1]["silences"], faults[1]["unsent"], more[1]["refused"], more[1]["unsaved"]) == (1, 6, 7, 8)

    (lower, upper) = transcoded("141#0001020001020001")
    cells = lower[1] | upper[1]
    assert [cells[f"cell_{i}"] for i in range(8)] == [0, 1, 2, 0, 1, 2, 0, 1]
    assert lower[1]["counter"] == upper[1]["counter"]

    (crash,) = transcoded("241#030978563412")
    assert crash[1].items() >= {"cause": 3, "name": 9, "value": 0x12345678}.items()


def test_commands_of_wire_1_are_given_today():
    said = transcoded("041#0021010015000000", "041#00420006FF000000", "041#00530093A9AA0000", "041#0074000100000000")

    (start, setting, lower, upper, freeze) = [signals for name, signals in said if name == "COMMAND"]
    assert start.items() >= {"opcode": Opcode.START, "lockstep": 1, "profile": 0, "seed": 0x15}.items()
    assert setting.items() >= {"opcode": Opcode.SET, "parameter": 6, "value": 255}.items()
    assert lower.items() >= {"half": 0, "mask": 3, "byte_0": 1, "byte_1": 2, "byte_2": 2}.items()
    assert upper.items() >= {"half": 1, "mask": 9, "byte_0": 2, "byte_3": 2}.items()
    assert freeze.items() >= {"opcode": Opcode.FREEZE, "freeze": 1}.items()


def test_a_rest_in_silence_has_its_own_reason_today():
    rest = "081#0010000000000000"
    running, stop = "041#0021000015000000", "041#0012000000000000"

    (_, silent, _, stopped) = transcoded(running, rest, stop, rest)

    assert (silent[1]["reason"], stopped[1]["reason"]) == (Reason.SILENCE, Reason.STOP)


def test_a_damaged_frame_of_an_old_log_is_counted(tmp_path):
    lines = OLD.read_text().splitlines(keepends=True)
    lines[150] = lines[150].rstrip()[:-1] + ("0" if lines[150].rstrip()[-1] != "0" else "1") + "\n"
    (tmp_path / "a.log").write_text("".join(lines))
    log = OldLog(tmp_path / "a.log")

    list(log)

    assert log.skipped == {"damaged": 1}


def test_an_old_log_replays_without_a_difference(convert, capsys):
    assert main(["replay", str(convert(OLD))]) == 0

    assert f"{DRIVES} drives, no difference\n" in capsys.readouterr().out


def test_each_robot_of_an_old_log_is_compared(convert, capsys):
    assert main(["replay", str(convert(OLD.with_name("wire_1_three_robots.log")))]) == 0

    assert capsys.readouterr().out.count(": 50 drives, no difference") == 3


def test_an_old_log_of_real_time_is_read_whole(convert):
    log, protocol = read_log(convert(OLD.with_name("wire_1_own_clock.log"))), Protocol()

    names = Counter(message.name for line in log if (message := protocol.decode(line.frame)) is not None)

    assert (names["DRIVE"], names["SENSES"], log.skipped) == (99, 100, {})


@pytest.mark.parametrize("name", ["wire_1_three_robots.log", "wire_1_own_clock.log"])
def test_old_logs_are_found_again_in_their_worlds(convert, name):
    new = convert(OLD.with_name(name))

    assert world_path(new).read_bytes() == world_path(OLD.with_name(name)).read_bytes()
    assert resimulate(new).stopped


def test_an_old_log_is_found_again_in_its_world(convert):
    result = resimulate(convert(OLD))

    assert (result.seed, result.stopped) == (21, True)


def test_an_old_log_with_two_drives_exchanged_differs(convert, tmp_path):
    changed = tmp_path / "changed.log"
    lines = OLD.read_text().splitlines(keepends=True)
    drives = [i for i, line in enumerate(lines) if " 081#" in line]
    lines[drives[40]], lines[drives[41]] = lines[drives[41]], lines[drives[40]]
    changed.write_text("".join(lines))

    assert replay(read_log(convert(changed)), Protocol()).difference is not None


def test_an_old_log_with_another_memory_differs(convert, tmp_path):
    changed = tmp_path / "changed.log"
    text = OLD.read_text()
    last = [line for line in text.splitlines() if " 141#" in line][-1]
    changed.write_text(text.replace(last, last[:-2] + ("02" if last.endswith("01") else "01")))

    difference = replay(read_log(convert(changed)), Protocol()).difference

    assert difference is not None
    assert hear(difference.recorded).name == "MEMORY"


def test_a_log_with_a_hash_of_no_layout_known_is_refused(tmp_path):
    other = tmp_path / "other.log"
    other.write_text(OLD.read_text().replace("2778\n", "2779\n"))

    with pytest.raises(OctetError, match="no heartbeat of wire 1"):
        list(OldLog(other))
    with pytest.raises(OctetError, match="no heartbeat of node 1"):
        replay(read_log(other), Protocol())
