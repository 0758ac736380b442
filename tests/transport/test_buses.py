"""Opening buses of python-can."""

import can
import pytest

from host_sim.transport.buses import open_bus


@pytest.fixture
def opened(monkeypatch) -> list[dict]:
    """What python-can was asked to open."""
    calls: list[dict] = []
    monkeypatch.setattr(can, "Bus", lambda **options: calls.append(options))
    return calls


def test_an_adapter_is_set_up_with_the_bit_rate(opened):
    open_bus("pcan:PCAN_USBBUS1", bitrate=125_000)

    assert opened[0]["bitrate"] == 125_000


def test_the_kernel_has_set_the_bit_rate_of_its_own_interfaces(opened):
    open_bus("socketcan:can0", bitrate=125_000)

    assert "bitrate" not in opened[0]
