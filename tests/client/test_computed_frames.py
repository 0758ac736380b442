"""Commands that were computed to pass for those of the simulator, and a memory that was held up."""

from functools import reduce
from itertools import count
from zlib import crc32

import pytest

from host_sim.client.commands import stop
from host_sim.client.supervision import settle
from host_sim.protocol.codec import Frame, crc8
from host_sim.protocol.generated import Opcode
from tests.client.support import PROTOCOL, Listener, begun, run_for

AT, SECOND = 120, 50
PACES = pytest.mark.parametrize("lockstep", [True, False], ids=["lockstep", "real time"])


@pytest.fixture
def link() -> Listener:
    return Listener()


def with_last(command: Frame, last: int) -> Frame:
    data = command.data[:4] + last.to_bytes(4, "little")
    return Frame(command.id, bytes([crc8(command.id, data)]) + data[1:])


def fitting(command: Frame, before: int, wanted: int) -> Frame:
    """A command whose last four bytes make the CRC-32 over all that was told the wanted one."""

    def crc(last: int) -> int:
        return crc32(with_last(command, last).data[1:], before)

    rows: dict[int, tuple[int, int]] = {}
    for bit in range(32):
        change, last = crc(1 << bit) ^ crc(0), 1 << bit
        while change.bit_length() in rows:
            other, bits = rows[change.bit_length()]
            change, last = change ^ other, last ^ bits
        rows[change.bit_length()] = change, last
    left, last = wanted ^ crc(0), 0
    while left:
        change, bits = rows[left.bit_length()]
        left, last = left ^ change, last ^ bits
    return with_last(command, last)


def is_start(frame: Frame) -> bool:
    return frame.id == PROTOCOL.id_of("COMMAND") and frame.data[1] >> 4 == Opcode.START


def told_by(link: Listener) -> int:
    """The CRC-32 over what the robot was told since its first stop."""
    commands = [frame for frame in link.sent if frame.id == PROTOCOL.id_of("COMMAND")]
    return reduce(lambda before, frame: crc32(frame.data[1:], before), commands[1:], 0)


@PACES
def test_start_with_computed_crc_is_detected_at_the_end(link, lockstep):
    client = begun(link, lockstep=lockstep)
    run_for(client, link, range(AT))
    told = told_by(link)
    start_again = fitting(link.forged("start", lockstep=lockstep), told, told)

    link.put_unheard(start_again)
    run_for(client, link, range(AT, AT + SECOND + 1))
    before = list(client.incidents)
    stop(client)

    assert (before == []) is not lockstep  # in lockstep a start forgets the senses that were obeyed before it
    assert "does not hold what it was told here" in str(client.incidents)


def test_replaced_start_is_detected_at_the_end(link):
    def swap(frame: Frame) -> Frame:
        if not is_start(frame):
            return frame
        others = (with_last(frame, seed) for seed in count(2))
        return next(other for other in others if not (crc32(other.data[1:]) ^ crc32(frame.data[1:])) & 0xFFFF)

    link.swap = swap
    client = begun(link, lockstep=True)
    run_for(client, link, range(AT))
    stop(client)

    assert "does not hold what it was told here" in str(client.incidents)


@pytest.mark.parametrize(("how", "lockstep"), [({"profile": 1}, True), ({"lockstep": 1}, False)])
def test_start_with_other_settings_is_detected_by_the_heartbeat(link, how, lockstep):

    def swap(frame: Frame) -> Frame:
        if not is_start(frame):
            return frame
        signals = PROTOCOL.decode(frame).signals
        return fitting(PROTOCOL.encode("COMMAND", {**signals, **how}), 0, crc32(frame.data[1:]))

    link.swap = swap
    client = begun(link, lockstep=lockstep)
    run_for(client, link, range(AT))

    assert "does not hold what it was told here" in str(client.incidents)


@PACES
def test_delayed_memory_of_an_environment_is_detected_at_the_end(link, lockstep):
    client = begun(link, lockstep=lockstep)
    held_up: list[Frame] = []

    def hold_up(frame: Frame) -> list[Frame]:
        is_memory = frame.id == PROTOCOL.id_of("MEMORY")
        held_up.extend([frame] * is_memory)
        return [] if is_memory else link.obey(frame)

    link.change = hold_up
    tick = 0
    while [byte for frame in held_up[-2:] for byte in frame.data[2:]] in ([], list(client.memory)):
        link.waiting.extend(held_up)
        held_up.clear()
        run_for(client, link, range(tick, tick := tick + 1))
    settle(client)
    link.change = link.obey
    link.waiting.extend(held_up)
    stop(client)

    assert "its last memory may have been lost on the way" in str(client.incidents)
