"""A sample of the campaign: each fault is seen, nothing is unsafe, and what is not seen fails it."""

import shlex

import pytest

from host_sim.campaign import cells as campaign
from host_sim.campaign.cells import cells
from host_sim.campaign.html_report import page, verdict
from host_sim.campaign.outcome import run_all
from tests.runs.support import octet


def test_each_fault_is_seen_and_told(tmp_path):
    report = tmp_path / "campaign.html"

    done = octet("campaign", report, "--profiles", "article")

    assert (done.returncode, done.stderr) == (0, "")
    runs = 1 + len(campaign.BUS_FAULTS) + len(campaign.BODY_FAULTS)
    assert f"{runs} runs: 0 not as they should be" in done.stdout
    text = report.read_text()
    assert text.count("<details>") == runs
    assert "http" not in text
    assert "--fault drop:30%" in text


def test_a_fault_without_effect_fails_the_campaign(tmp_path, monkeypatch):
    monkeypatch.setattr(campaign, "BUS_FAULTS", {})
    monkeypatch.setattr(campaign, "BODY_FAULTS", {"nothing that happens": "swap-motors@900s"})

    done = octet("campaign", tmp_path / "campaign.html", "--profiles", "article", "--limit-s", "2")

    assert done.returncode == 1
    assert done.stderr.startswith("UNSEEN: nothing that happens: tools/run ")


def test_a_run_that_breaks_or_is_unsafe_or_misled_is_a_problem():
    (outcome,) = run_all([next(cells(["article"], ["none"], [False], 1.0))])
    assert outcome.problems == []

    outcome.oldest, outcome.wrong, outcome.broke = 6, (1,), True

    assert outcome.problems == ["unsafe", "wrong without a word", "broke"]
    assert verdict(outcome) == "UNSAFE, WRONG WITHOUT A WORD, BROKE"
    assert 'class="bad"' in page([outcome])


@pytest.mark.parametrize("number", [1, 20])
def test_the_command_of_a_cell_repeats_it(tmp_path, number):
    cell = list(cells(["adaptive"], ["none"], [False], 3.0))[number]
    ((outcome),) = run_all([cell])

    done = octet("run", "--out", tmp_path, *shlex.split(cell.command())[1:], "--json")

    assert done.returncode == 0
    assert outcome.digest in done.stdout
