"""A robot in this process answers at once."""

from pathlib import Path

import pytest

from host_sim.backends.in_process_link import InProcessLink
from host_sim.backends.relay import Relay
from host_sim.base.errors import OctetError
from host_sim.protocol.codec import Frame, Protocol
from host_sim.protocol.generated import Senses

KNOWS = (0, 1, 0, 0, 2, 0, 0, 0)


def names(protocol: Protocol, frames: list[Frame]) -> list[str]:
    return [decoded.name for frame in frames if (decoded := protocol.decode(frame))]


def stop(link: InProcessLink, protocol: Protocol) -> None:
    """Has the robot report all that there is to be known of it."""
    link.send(protocol.encode("COMMAND", {"counter": 1, "opcode": 1, "owner": 1}))


def test_a_drive_answers_the_senses_and_nothing_else_is_to_come():
    link, protocol = InProcessLink(), Protocol()

    link.send(protocol.encode_senses(Senses(0, 0, False, False, 0, 0, 0), 0))

    frame = link.receive(0.0)
    assert frame is not None
    assert protocol.decode_drive(frame) is not None
    assert link.receive(0.0) is None


def test_what_was_taken_can_be_put_back_before_what_c_code_has_got():
    link, protocol = InProcessLink(memory=KNOWS), Protocol()
    stop(link, protocol)
    said = link.taken()

    link.put_back(said[:1], len(said))

    assert link.taken() == [said[0], *said]
    assert names(protocol, said)[:3] == ["ANSWER", "HEARTBEAT", "BOOT"]
    assert link.taken() == []


def test_a_robot_that_was_closed_says_nothing_more():
    link, protocol = InProcessLink(), Protocol()
    stop(link, protocol)

    link.close()

    assert link.receive(0.0) is None


def test_robots_hear_the_memories_of_each_other():
    relay = Relay([1, 2])
    links = {node: InProcessLink(node, KNOWS, relay=relay) for node in (1, 2)}
    stop(links[1], Protocol(1))
    others = [frame for frame in links[1].taken() if frame.id == Protocol(1).id_of("MEMORY")]
    assert len(others) == 2

    links[2].hear_others()

    assert relay.take(2) == []


def test_c_code_reaches_each_robot_by_pointers_of_its_own():
    links = InProcessLink(1), InProcessLink(2)

    first, second = (link.pointers for link in links)

    assert all(first)
    assert first.octet != second.octet
    assert first[1:] == second[1:]


def test_a_robot_that_is_alone_hears_nobody():
    link = InProcessLink()

    link.hear_others()

    assert link.taken() == []


def test_a_library_that_is_not_there_is_named_with_what_builds_it():
    with pytest.raises(OctetError, match=r"cannot load the firmware: .*/nowhere\.so.*tools/setup"):
        InProcessLink(library=Path("/nowhere.so"))
