"""slcan text as it comes over a real line: in pieces, with acknowledgements, and with noise."""

import os
import socket
from collections.abc import Iterator
from contextlib import suppress
from random import Random

import pytest

from host_sim.base.errors import LinkDownError
from host_sim.protocol.codec import Frame
from host_sim.transport import slcan_link
from host_sim.transport.link import LineStats
from host_sim.transport.slcan_link import SlcanLink, encode

FRAME = Frame(0x123, b"\x01\x02\x03")
NO_FRAME = Frame(-1, b"")


@pytest.fixture
def pair() -> Iterator[tuple[socket.socket, socket.socket]]:
    near, far = socket.socketpair()
    with near, far:
        yield near, far


@pytest.fixture
def far(pair) -> socket.socket:
    return pair[1]


@pytest.fixture
def stats() -> LineStats:
    return LineStats()


@pytest.fixture
def link(pair, stats) -> SlcanLink:
    return SlcanLink(pair[0], stats)


def test_frame_received_in_pieces_is_decoded(link, far):
    text = encode(FRAME)

    far.send(text[:4])
    assert link.receive(0.0) is None
    far.send(text[4:])

    assert link.receive(0.5) == FRAME


def test_adapter_acknowledgements_are_skipped(link, far):
    far.send(b"\r\rz\rZ\r\a" + encode(FRAME))

    assert link.receive(0.5) == FRAME


@pytest.mark.parametrize("stamp", [b"", b"7A3F", b"0012D687"])
@pytest.mark.parametrize("end", [b"\r", b"\r\n", b"\n"])
def test_any_line_end_and_timestamp_is_accepted(link, far, stamp, end):
    far.send((encode(FRAME)[:-1] + stamp + end) * 2)

    assert [link.receive(0.5), link.receive(0.5), link.receive(0.0)] == [FRAME, FRAME, None]


def test_echoed_frames_are_skipped(link, far):
    other = Frame(0x321, b"")

    link.send(FRAME)
    far.send(encode(FRAME) + encode(other) + encode(FRAME._replace(data=b"others")))

    assert [link.receive(0.5), link.receive(0.5)] == [other, FRAME._replace(data=b"others")]


def test_opening_commands_repeat_until_a_frame_arrives(pair, monkeypatch):
    near, far = pair
    monkeypatch.setattr(slcan_link, "_REOPEN_S", 0.05)
    link = SlcanLink(near, opening=b"C\rS6\rO\r")
    assert link.receive(0.2) is None
    assert far.recv(4096).count(b"C\rS6\rO\r") >= 2

    far.send(encode(FRAME))
    assert link.receive(0.5) == FRAME
    far.setblocking(False)
    with suppress(BlockingIOError):
        far.recv(4096)  # what it sent before that frame came
    assert link.receive(0.2) is None

    with pytest.raises(BlockingIOError):
        far.recv(4096)


def test_line_stats_count_frames_errors_and_garbled_lines(link, far, stats):
    far.send(b"\a\a+Board: \xff\r" + encode(FRAME))
    while link.receive(0.5) != FRAME:
        pass

    assert (stats.frames, stats.errors, stats.garbled, stats.strange) == (1, 2, 1, "'+Board: \\xff'")
    assert stats.heard == 11 + 1 + len(encode(FRAME))


@pytest.mark.parametrize("noise", [b"\xff\xfe\r", b"t12\r", b"t1239\r", b"t1233010\r", b"T00000123301\r", b"tXYZ0\r"])
def test_malformed_line_does_not_lose_the_next_frame(link, far, noise):
    far.send(noise + encode(FRAME))

    assert [link.receive(0.5), link.receive(0.5)] == [NO_FRAME, FRAME]


def test_extended_and_remote_frames_are_not_garbled(link, far, stats):
    far.send(b"\xff\xfe\rt12\rT000001230\rr1230\rR000001230\r" + encode(FRAME))
    while link.receive(0.5) != FRAME:
        pass

    assert stats.garbled == 2


def test_noisy_line_gets_repeated_copies_of_a_frame(link, far, stats):
    stats.insist()
    stats.insist()
    link.send(FRAME)

    assert far.recv(4096) == 4 * encode(FRAME)


def test_frames_with_other_identifiers_are_skipped(pair):
    near, far = pair
    link = SlcanLink(near, ids=[0x123])

    far.send(encode(Frame(0x124, b"")) * 5 + encode(FRAME))

    assert link.receive(0.5) == FRAME


def test_random_bytes_do_not_stop_the_link(link, far):
    far.setblocking(False)
    dice = Random(1)

    for _ in range(200):
        far.send(dice.randbytes(200))
        while link.receive(0.0) is not None:
            pass
    far.send(b"\r" + encode(FRAME))

    heard = [link.receive(0.0) for _ in range(3)]
    assert FRAME in heard


def test_receive_times_out_during_a_stream_of_noise(link, far):
    far.setblocking(False)
    far.send(b"x" * 60_000)

    assert link.receive(0.05) is None


def test_closed_far_end_raises_link_down(link, far):
    far.close()

    with pytest.raises(LinkDownError, match="its end of the line is closed"):
        link.receive(0.5)


def test_frame_without_room_is_dropped_and_counted():
    read_end, write_end = os.pipe()
    os.set_blocking(write_end, False)
    with os.fdopen(read_end, "rb"), os.fdopen(write_end, "wb", buffering=0) as stream:
        stats = LineStats()
        link = SlcanLink(stream, stats)
        for _ in range(8000):
            if stats.unsent:
                break
            link.send(FRAME)

        assert stats.unsent == 1


def test_failing_line_raises_link_down(link, far, monkeypatch):
    far.close()

    with pytest.raises(LinkDownError, match="cannot send to the robot"):
        link.send(FRAME)

    monkeypatch.setattr(os, "read", lambda *_: (_ for _ in ()).throw(OSError("it is on fire")))
    with pytest.raises(LinkDownError, match="cannot hear the robot: it is on fire"):
        link.receive(0.5)


def test_receive_continues_after_a_spurious_wakeup(link, far, monkeypatch):
    far.send(encode(FRAME))
    read, reads = os.read, iter([BlockingIOError()])

    def read_or_fail(*arguments: int) -> bytes:
        for error in reads:
            raise error
        return read(*arguments)

    monkeypatch.setattr(os, "read", read_or_fail)

    assert link.receive(0.5) == FRAME


def test_send_retries_when_the_line_is_full_again(link, far, monkeypatch):
    full, write = [BlockingIOError()], os.write

    def write_or_fail(fd: int, text: bytes) -> int:
        if full:
            raise full.pop()
        return write(fd, text)

    monkeypatch.setattr(os, "write", write_or_fail)

    link.send(FRAME)

    assert far.recv(100) == encode(FRAME)


def test_close_closes_the_stream(link, far):
    link.close()

    assert far.recv(1) == b""
