"""Senses that somebody else sends, who counts as the simulator does: the result is doubtful within a second."""

import pytest

from host_sim.client.robot_client import RobotClient
from host_sim.protocol.codec import Frame
from tests.client.support import PROTOCOL, senses
from tests.client.test_forged_commands import AT, SECOND, Listener, begun, run_for

PACES = pytest.mark.parametrize("lockstep", [True, False], ids=["lockstep", "real time"])


def forged(link: Listener, tick: int, counter: int) -> Frame:
    return PROTOCOL.encode_senses(senses(tick, link.odometer)._replace(feel=21), counter % 15)


def running(link: Listener, *, lockstep: bool) -> RobotClient:
    client = begun(link, lockstep=lockstep)
    run_for(client, link, range(AT))
    return client


def assert_doubtful(client: RobotClient, link: Listener) -> None:
    run_for(client, link, range(AT, AT + SECOND + 1))
    assert "somebody else commands" in str(client.incidents)
    assert client.incidents[0].tick <= AT + SECOND


@PACES
@pytest.mark.parametrize("ahead", [1, 2, 14])
def test_a_single_one_that_is_heard_is_noticed(lockstep, ahead):
    link = Listener()
    client = running(link, lockstep=lockstep)

    link.waiting.append(forged(link, AT - 1 + ahead, AT + ahead))

    assert_doubtful(client, link)
    assert client.incidents[0].tick < AT + 2


def test_distances_as_well():
    link = Listener()
    client = running(link, lockstep=True)

    link.waiting.append(PROTOCOL.encode_ranges(client.ranges, AT % 256, (AT + 1) % 15))

    assert_doubtful(client, link)


@PACES
def test_one_that_only_the_robot_hears_is_noticed_by_what_it_holds(lockstep):
    link = Listener()
    client = running(link, lockstep=lockstep)

    link.put_unheard(forged(link, AT, AT + 1))

    assert_doubtful(client, link)


@PACES
@pytest.mark.parametrize(("tick", "counter"), [(AT, AT), (AT - 2, AT - 1), (AT + 100, AT + 101)])
def test_one_that_the_robot_refuses_may_be_noise(lockstep, tick, counter):
    link = Listener()
    client = running(link, lockstep=lockstep)

    link.waiting.append(forged(link, tick, counter))
    run_for(client, link, range(AT, AT + SECOND + 1))

    assert client.incidents == []
