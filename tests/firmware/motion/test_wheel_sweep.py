"""The page on bodies says what the sweep prints."""

from tests.firmware.motion.wheel_sweep import TOO_LATE_MS, lines, run
from tests.firmware.octet_c import ROOT

SEEDS_OF_THE_PAGE = 10


def test_bodies_page_has_the_lines_that_the_sweep_prints():
    page = (ROOT / "docs/bodies.md").read_text().splitlines()

    for line in lines(SEEDS_OF_THE_PAGE, (0, 60)):
        assert line in page


def test_wheel_sweep_detects_a_far_too_long_lag():
    figures = run(TOO_LATE_MS, 0)

    assert figures.stopped
    assert figures.denied > 0
