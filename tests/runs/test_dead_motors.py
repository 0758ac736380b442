"""A motor that dies is noticed however late the wheels answer, and sound wheels that answer late are believed."""

import pytest

from tests.runs.dead_motors import DELAYS_TICKS, LAGS_MS, SEEDS, figures, lines
from tests.runs.support import ROOT


@pytest.mark.parametrize("delay_ticks", DELAYS_TICKS)
@pytest.mark.parametrize("lag_ms", LAGS_MS)
def test_a_dead_motor_is_noticed_within_three_seconds_and_no_sound_one_is_denied(lag_ms, delay_ticks):
    of = figures(lag_ms, delay_ticks, 3)

    assert (of.unnoticed, of.denied) == (0, 0)


def test_the_page_has_what_the_table_prints():
    page = (ROOT / "docs/faults.md").read_text().splitlines()

    for line in lines(SEEDS, LAGS_MS[:2]):
        assert line in page
