"""What the models stand on, and the boards that are emulated."""

import pytest

from host_sim.emulator.clock import Clock
from host_sim.sim.access import BOARDS


@pytest.fixture
def clock():
    return Clock(8_000_000)


@pytest.fixture(params=BOARDS)
def name(request: pytest.FixtureRequest) -> str:
    """A board's."""
    return request.param
