"""The report of a campaign: a page that needs no network, with a command for each cell."""

from collections.abc import Sequence
from html import escape

from host_sim.campaign.outcome import Outcome

_STYLE = """
:root { color-scheme: light dark; }
body { font: 16px/1.4 system-ui, sans-serif; margin: 2rem; }
table { border-collapse: collapse; }
th, td { border: 1px solid #8888; padding: .4rem .6rem; text-align: left; vertical-align: top; }
thead th { position: sticky; top: 0; background: Canvas; }
.bad { background: #c003; }
.ended { background: #c903; }
td summary { cursor: pointer; }
code { overflow-wrap: anywhere; }
"""


def page(outcomes: Sequence[Outcome]) -> str:
    """The whole page."""
    faults = list(dict.fromkeys(outcome.cell.fault for outcome in outcomes))
    configurations = list(dict.fromkeys(outcome.cell.configuration for outcome in outcomes))
    found = {(outcome.cell.fault, outcome.cell.configuration): outcome for outcome in outcomes}
    head = "".join(f'<th scope="col">{escape(name)}</th>' for name in configurations)
    rows = "".join(
        f'<tr><th scope="row">{escape(fault or "no fault")}</th>'
        + "".join(_cell(found.get((fault, configuration))) for configuration in configurations)
        + "</tr>\n"
        for fault in faults
    )
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8"><title>Octet: fault campaign</title>'
        f"<style>{_STYLE}</style></head><body>\n<h1>Fault campaign</h1>\n<p>{escape(summary(outcomes))}</p>\n"
        "<p>Each cell says how the run ended. It opens to what was noticed, the longest time for which wheels turned "
        "without a new drive, and the command that repeats the run.</p>\n"
        f'<table><thead><tr><th scope="col">fault</th>{head}</tr></thead>\n<tbody>\n{rows}</tbody></table>\n'
        "</body></html>\n"
    )


def summary(outcomes: Sequence[Outcome]) -> str:
    """The result in one sentence."""
    bad = sum(bool(outcome.problems) for outcome in outcomes)
    ended = sum(bool(outcome.end) for outcome in outcomes)
    doubted = sum(bool(outcome.doubts) for outcome in outcomes)
    wrong = sum(bool(outcome.wrong) for outcome in outcomes)
    return (
        f"{len(outcomes)} runs: {bad} not as they should be, {ended} ended before their time, {doubted} doubted, "
        f"{wrong} learned a wrong turn"
    )


def verdict(outcome: Outcome) -> str:
    """How a run ended, in a few words."""
    if outcome.problems:
        return ", ".join(outcome.problems).upper()
    words = ["ended" if outcome.end else "went on"]
    words += ["doubted"] * bool(outcome.doubts)
    if outcome.wrong:
        words.append("learned wrong turns for patterns " + " ".join(map(str, outcome.wrong)))
    return ", ".join(words)


def _cell(outcome: Outcome | None) -> str:
    if outcome is None:
        return "<td></td>"
    kind = "bad" if outcome.problems else "ended" if outcome.end or outcome.doubts or outcome.wrong else ""
    lines = [outcome.end, *outcome.doubts, f"seen: {outcome.seen or 'nothing'}", f"to rest: {outcome.rest_ms} ms"]
    told = "".join(f"<p>{escape(line)}</p>" for line in lines if line)
    return (
        f'<td class="{kind}"><details><summary>{escape(verdict(outcome))}</summary>{told}'
        f"<code>{escape(outcome.cell.command())}</code></details></td>"
    )
