"""The report of a campaign: an offline page with a command for each cell."""

import re
from collections.abc import Iterable, Sequence
from html import escape

from host_sim.lab.campaign.cell import Outcome, unreached

_STYLE = """
:root { color-scheme: light dark; --bad: #ffd9d6; --bad-ink: #8c0b00; --told: #fff0c9; --well: #e2f3e2; }
@media (prefers-color-scheme: dark) {
  :root { --bad: #4a1512; --bad-ink: #ffb3ab; --told: #3f3210; --well: #16301a; }
}
body { font: 16px/1.45 system-ui, sans-serif; margin: 1.5rem auto; padding: 0 1rem; max-width: 100rem; }
table { border-collapse: collapse; }
th, td { border: 1px solid #8886; padding: .4rem .6rem; text-align: left; vertical-align: top; }
tbody th { font-weight: 500; min-width: 8rem; }
.wide th:first-child { position: sticky; left: 0; background: Canvas; }
thead th { white-space: nowrap; }
.wide { overflow-x: auto; }
.bad { background: var(--bad); }
.bad summary { color: var(--bad-ink); font-weight: 600; }
.told { background: var(--told); }
.well { background: var(--well); }
td p, th p { margin: .3rem 0; max-width: 32rem; }
summary { cursor: pointer; }
a { color: inherit; }
code { font-size: .85em; }
code span { display: inline-block; overflow-wrap: anywhere; max-width: 100%; white-space: pre-wrap; }
"""
_DOUBTS_MAX = 3

_HEAD = (
    '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
    "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'\">"
    '<meta name="viewport" content="width=device-width, initial-scale=1"><title>Octet: fault campaign</title>'
    f"<style>{_STYLE}</style></head><body><main>\n<h1>Fault campaign</h1>\n"
)
_EXPLAINED = (
    "<p>Each cell says how a run ended: <em>went on</em> to its end; <em>ended</em> before it, with a reason; "
    "<em>doubted</em>, where the run went on and says that its result is unreliable. It opens to what was "
    "noticed, whether the robot took part again, the longest time for which wheels turned without a new drive, what "
    "was learned wrong, and the command that repeats the run. A green cell went on as if nothing had happened, a "
    "yellow one says what is wrong, or that the fault did not reach its receiver, and a red one is not as it should "
    "be.</p>\n"
)


def page(outcomes: Sequence[Outcome]) -> str:
    """The whole page."""
    profiles = dict.fromkeys(outcome.cell.profile for outcome in outcomes)
    tables = "".join(_table(name, [each for each in outcomes if each.cell.profile == name]) for name in profiles)
    return (
        f"{_HEAD}<p>{escape(summary(outcomes))}</p>\n{_figures(outcomes)}{_EXPLAINED}{_bad(outcomes)}{_links(profiles)}"
        f"{tables}</main></body></html>\n"
    )


def summary(outcomes: Sequence[Outcome]) -> str:
    """The result in one sentence."""
    bad = sum(bool(outcome.problems) for outcome in outcomes)
    ended = sum(bool(outcome.end) for outcome in outcomes)
    doubted = sum(bool(outcome.doubts) for outcome in outcomes)
    wrong = sum(bool(outcome.wrong) for outcome in outcomes)
    return (
        f"{len(outcomes)} runs: {bad} not as they should be, {ended} ended before their time, {doubted} doubted, "
        f"{wrong} learned a wrong turn{_untested(outcomes)}"
    )


def _untested(outcomes: Sequence[Outcome]) -> str:
    faults = unreached(outcomes)
    return f"; of these faults none reached its receiver: {', '.join(faults)}" if faults else ""


def verdict(outcome: Outcome) -> str:
    """How a run ended, in a few words."""
    if outcome.problems:
        return ", ".join(outcome.problems).upper()
    words = ["ended" if outcome.end else "went on"]
    words += ["doubted"] * bool(outcome.doubts)
    if outcome.wrong:
        words.append("learned wrong turns for patterns " + " ".join(map(str, outcome.wrong)))
    return ", ".join(words)


def account(outcome: Outcome) -> str:
    """The outcome of one run, in lines of text."""
    return "\n".join((str(outcome.cell), verdict(outcome), *_lines(outcome)))


def _lines(outcome: Outcome) -> list[str]:
    more = len(outcome.doubts) - _DOUBTS_MAX
    lines = (
        outcome.end,
        *outcome.doubts[:_DOUBTS_MAX],
        f"and {more} more like these" if more > 0 else "",
        "" if outcome.seen == outcome.end != "" else f"seen: {outcome.seen or 'nothing'}",
        f"fault: {outcome.reach}" if outcome.reach else "",
        f"recovered: {'yes' if outcome.recovered else 'no'}",
        f"wheels turned without a new drive for {outcome.rest_ms} ms at most",
    )
    return [line for line in lines if line]


def _row(fault: str, cells: Iterable[str], more: str = "") -> str:
    return f'<tr><th scope="row">{escape(fault or "no fault")}{more}</th>{"".join(cells)}</tr>\n'


def _bad(outcomes: Sequence[Outcome]) -> str:
    """The failed runs, which need attention first."""
    bad = [each for each in outcomes if each.problems]
    rows = "".join(_row(it.cell.fault, [_cell(it)], f"<p>{escape(it.cell.configuration)}</p>") for it in bad)
    return f"<h2>Not as they should be</h2>\n<table><tbody>\n{rows}</tbody></table>\n" if rows else ""


def _links(profiles: Iterable[str]) -> str:
    """Links to the tables."""
    links = (f'<a href="#{escape(name)}">{escape(name)}</a>' for name in profiles)
    return f"<nav><p>Behaviours: {', '.join(links)}</p></nav>\n"


def _command(text: str) -> str:
    """A command, with line breaks only before its options."""
    first, *others = re.split(r" (?=--)", text)
    words = (first, *(f" {other}" for other in others))
    return f"<code>{''.join(f'<span>{escape(word)}</span>' for word in words)}</code>"


def _figures(outcomes: Sequence[Outcome]) -> str:
    """The campaign's figures: the number of runs with a fault that meet each requirement."""
    faulty = [outcome for outcome in outcomes if outcome.cell.fault]
    counts = {
        "safe: no wheel turned for more than 100 ms without a new drive": _without("unsafe", faulty),
        "seen: counted, told, or without any effect": _without("unseen", faulty),
        "recovered: the robot took part again to the end": sum(outcome.recovered for outcome in faulty),
        "learned nothing wrong": sum(not outcome.wrong for outcome in faulty),
        "learned nothing wrong without a warning": _without("wrong without a warning", faulty),
    }
    rows = "".join(_row(name, [f"<td>{count} of {len(faulty)}</td>"]) for name, count in counts.items())
    slowest = max((outcome.rest_ms for outcome in outcomes), default=0)
    rows += _row("longest time to rest", [f"<td>{slowest} ms</td>"])
    head = '<thead><tr><th scope="col">runs with a fault</th><th scope="col">how many</th></tr></thead>'
    return f"<table>{head}<tbody>{rows}</tbody></table>\n"


def _without(problem: str, outcomes: Sequence[Outcome]) -> int:
    return sum(problem not in outcome.problems for outcome in outcomes)


def _table(profile: str, outcomes: Sequence[Outcome]) -> str:
    faults = dict.fromkeys(outcome.cell.fault for outcome in outcomes)
    columns = dict.fromkeys((outcome.cell.link, outcome.cell.pace) for outcome in outcomes)
    found = {(each.cell.fault, (each.cell.link, each.cell.pace)): each for each in outcomes}
    head = "".join(f'<th scope="col">{escape(f"{link}, {pace}")}</th>' for link, pace in columns)
    rows = "".join(_row(fault, [_cell(found.get((fault, column))) for column in columns]) for fault in faults)
    return (
        f'<h2 id="{escape(profile)}">{escape(profile)}</h2>\n'
        f'<div class="wide" role="region" tabindex="0" aria-label="{escape(profile)}"><table><thead><tr>'
        f'<th scope="col">fault</th>{head}</tr></thead>\n<tbody>\n{rows}</tbody></table></div>\n'
    )


def _cell(outcome: Outcome | None) -> str:
    if outcome is None:
        return "<td></td>"
    is_told = outcome.end or outcome.doubts or outcome.wrong or outcome.reach in ("refused", "never came")
    kind = "bad" if outcome.problems else "told" if is_told else "well"
    told = "".join(f"<p>{escape(line)}</p>" for line in _lines(outcome))
    return (
        f'<td class="{kind}"><details><summary>{escape(verdict(outcome))}</summary>{told}'
        f"{_command(outcome.cell.command())}</details></td>"
    )
