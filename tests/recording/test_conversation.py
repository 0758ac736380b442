"""A log of any firmware is checked for the protocol alone."""

import pytest

from host_sim.protocol.codec import Protocol, crc8
from host_sim.recording.conversation import check_conversation
from host_sim.recording.log_reader import read_log
from tests.runs.support import octet

PROTOCOL = Protocol()


def edited(log, name: str, nth: int, edit) -> None:
    """Gives the n-th frame of a message other bytes, or takes it away where there are none."""
    lines = log.read_text().splitlines(keepends=True)
    at = [i for i, line in enumerate(lines) if f" {PROTOCOL.id_of(name):03X}#" in line][nth]
    head, data = lines[at].rstrip().split("#")
    changed = edit(bytearray.fromhex(data))
    lines[at] = f"{head}#{changed.hex().upper()}\n" if changed else ""
    log.write_text("".join(lines))


def with_crc(name: str, data: bytearray) -> bytearray:
    data[0] = crc8(PROTOCOL.id_of(name), bytes(data))
    return data


def faster(data: bytearray) -> bytearray:
    data[3] ^= 1
    return with_crc("DRIVE", data)


def of_another_tick(data: bytearray) -> bytearray:
    data[2] ^= 1
    return with_crc("DRIVE", data)


def with_other_orders(data: bytearray) -> bytearray:
    data[6] ^= 1
    return with_crc("HEALTH", data)


def test_a_run_keeps_to_the_protocol(short):
    found = check_conversation(read_log(short.log), PROTOCOL)

    assert found.problems == []
    assert (found.commands, found.drives > 50) == (3, True)


def test_what_the_robot_does_is_its_own_affair(short):
    edited(short.log, "DRIVE", 20, faster)

    assert octet("replay", short.log).returncode == 1
    assert octet("replay", short.log, "--protocol").returncode == 0


@pytest.mark.parametrize(
    ("name", "edit", "problem"),
    [
        ("DRIVE", lambda _: None, "senses were not answered"),
        ("DRIVE", of_another_tick, "a drive has another tick"),
        ("DRIVE", lambda data: data[:-1], "damaged or of a wrong length"),
        ("ANSWER", lambda _: None, "a command was not answered"),
        ("HEALTH", with_other_orders, "HEALTH holds something else"),
    ],
)
def test_what_is_against_it_is_said_with_its_time(short, name, edit, problem):
    edited(short.log, name, 1, edit)

    done = octet("replay", short.log, "--protocol")

    assert done.returncode == 1
    assert problem in done.stdout
    assert " s " in done.stdout
