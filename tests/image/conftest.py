"""What the models stand on, and the boards that are emulated."""

import pytest

from host_sim.emulator.clock import Clock
from host_sim.sim.access import BOARDS
from tests.image.support import Talk, talk_to


@pytest.fixture
def clock():
    return Clock(8_000_000)


@pytest.fixture(params=BOARDS)
def name(request: pytest.FixtureRequest) -> str:
    """A board's."""
    return request.param


@pytest.fixture
def talk(name: str) -> Talk:
    """With a board that has power, and waits for a start."""
    return talk_to(name)


@pytest.fixture
def driving(talk: Talk) -> Talk:
    """With a board that was started and has driven for a while."""
    talk.start()
    talk.live(5)
    return talk
