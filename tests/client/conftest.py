"""A robot that has learned something, its client, and somebody who meddles with what they say."""

import pytest

from host_sim.client.robot_client import RobotClient
from tests.client.support import MeddledLink, learned


@pytest.fixture
def link() -> MeddledLink:
    return MeddledLink()


@pytest.fixture
def client(link) -> RobotClient:
    """A client whose robot has been running for `LEARNED` ticks."""
    return learned(link)
