"""What the models stand on, and the boards that are emulated."""

import pytest

from host_sim.backends.images import BOARDS
from host_sim.emulator.clock import Clock
from tests.image.update_rig import RIGS, Rig


@pytest.fixture
def clock():
    return Clock(8_000_000)


@pytest.fixture(params=BOARDS)
def name(request: pytest.FixtureRequest) -> str:
    """A board's."""
    return request.param


@pytest.fixture(params=RIGS, ids=lambda rig: rig.board)
def rig(request: pytest.FixtureRequest) -> Rig:
    """A board with a boot loader."""
    return request.param
