"""What the models stand on."""

import pytest

from host_sim.emulator.clock import Clock


@pytest.fixture
def clock():
    return Clock(8_000_000)
