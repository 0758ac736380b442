"""An image on an emulated chip as the device of the pytest plug-in."""

from itertools import pairwise

import pytest

from host_sim.base.paths import image_path
from host_sim.protocol.codec import DBC
from tools.pytest_canbench.bench import Bench, Setup
from tools.pytest_canbench.devices import open_device
from tools.pytest_canbench.messages import Messages


@pytest.fixture
def bench(name):
    image = image_path(name, "bxcan")
    opened = Bench(Setup(Messages(DBC, "e2e1"), lambda: open_device(f"image:{name}:{image.name}", image.parent)))
    yield opened
    opened.close()


def test_an_image_speaks_in_simulated_time(bench):
    bench.run(ms=1000)

    silences = [at_ms for at_ms, reason in bench.history("DRIVE.reason") if reason == 8]
    gaps = {later - sooner for sooner, later in pairwise(silences[-8:])}
    assert gaps <= {99, 100, 101}
    assert bench.damaged == 0


def test_a_shorted_bus_drives_the_controller_off_it_and_it_comes_back(bench):
    bench.device.short_bus(True)
    for _ in range(300):
        bench.run(ms=1)
        if bench.device.is_bus_off:
            break
    assert bench.device.is_bus_off
    assert bench.device.error_counters[0] > 255

    bench.device.short_bus(False)
    before = len(bench.heard)
    bench.run(ms=1000)
    assert not bench.device.is_bus_off
    assert len(bench.heard) > before
