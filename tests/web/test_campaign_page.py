"""The report of a fault campaign, in a browser."""

import itertools

from host_sim.lab.campaign.html_report import page
from host_sim.lab.campaign.matrix import groups
from host_sim.lab.campaign.outcome import Outcome
from tests.web.looks import THREE_SIZES, resize, violations_at

ENDS = ("", "somebody else stopped node 1: it rests")


def test_axe_finds_nothing_on_the_report_of_a_campaign_and_it_fits(tmp_path, open_page):
    (cells, _) = groups(["article"], ["none", "fd"], ["lockstep"], lambda _: 8.0)
    outcomes = [
        Outcome(cell, seen="12 lost", end=end) for cell, end in zip(cells, itertools.cycle(ENDS), strict=False)
    ]
    outcomes[1].oldest = 9
    report = tmp_path / "campaign.html"
    report.write_text(page(outcomes))

    shown = open_page(report.as_uri(), ready="() => document.readyState === 'complete'")

    assert violations_at(shown) == []
    for size in THREE_SIZES:
        resize(shown, size)
        assert shown.evaluate("document.documentElement.scrollWidth") <= size[0]
