"""Every profile is in the flash image, and does there what it does on the host."""

import pytest

from host_sim.lab.bench.equality import IMAGES, REFERENCE, first_difference, record
from host_sim.protocol.generated import PROFILES

TICKS = 150
QEMU, BOARD = IMAGES[:2]
# One of each kind of memory, since an emulated board is slow.
CASES = [
    *((QEMU, profile) for profile in PROFILES),
    *((BOARD, profile) for profile in ("article", "searcher", "five")),
]


@pytest.mark.parametrize(("image", "profile"), CASES)
def test_the_image_does_what_the_host_build_does_with_each_profile(image, profile, tmp_path):
    logs = {where: tmp_path / f"{where}.log" for where in (REFERENCE, image)}
    for where, log in logs.items():
        record(where, 2, TICKS, log, profile)

    assert first_difference(*logs.values()) is None
