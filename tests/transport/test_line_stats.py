"""What an error message says of a line."""

import pytest

from host_sim.transport.line_stats import LineStats


@pytest.mark.parametrize(
    ("stats", "told"),
    [
        (LineStats(), ""),
        (LineStats(outages=2, reason="no such device"), "; the line was gone 2 times, last: no such device"),
        (LineStats(unsent=3), "; 3 frames could not be sent"),
        (
            LineStats(outages=1, unsent=4, reason="x"),
            "; the line was gone 1 times, last: x; 4 frames could not be sent",
        ),
    ],
)
def test_only_what_happened_is_told(stats, told):
    assert stats.account() == told
