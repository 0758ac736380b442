"""octet.html on a school's screens: what matters is in view, nothing is cut, and no card is half empty."""

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, Playwright

from tests.web.browsers import BROWSERS, launch
from tests.web.lab.support import LESSONS, READY, go, settle
from tests.web.looks import DESKTOPS, out_of_view, resize
from tests.web.support import next_frame

SIZES = [(1366, 657), (1280, 720), (1024, 768)]
PHONE = (390, 844)
# What stands in a step and lies below something else, such as the arena.
COVERED = """() => [...document.querySelectorAll("#step .held *, #step .head *")].filter((e) => {
  const { left, top, width, height } = e.getBoundingClientRect();
  const over = document.elementFromPoint(left + width / 2, top + height / 2);
  const isSeen = width && height && !e.closest("svg, option") && e.checkVisibility();
  return isSeen && !document.querySelector("#step").contains(over);
}).map((e) => `${e.tagName} ${e.textContent.slice(0, 30)}`)"""
IN_VIEW = ("#floors", "#scrub", "#play", "#doing", "#step", "#cells", "#memory-title", "#begin-lesson")

# The height of the tabs with each of them chosen.
TAB_ROWS = """() => [...document.querySelectorAll("#tabs button")].map((tab) => {
  tab.click();
  return document.querySelector("#tabs").offsetHeight;
})"""

# Of all that has no scroll bar: what is wider or higher than its element, and what lies on its neighbour.
FAULTS = """() => {
  const name = (e) => e.id || `${e.tagName} ${e.className} ${e.textContent.slice(0, 30)}`;
  const isWhole = (e) => e.scrollWidth <= e.clientWidth + 1 && e.scrollHeight <= e.clientHeight + 3;
  const scrolls = (e) => getComputedStyle(e).overflowY === "auto" || e.matches("input, select, textarea");
  const cut = [...document.querySelectorAll("header *, main *")].filter((e) => e.checkVisibility() && e.clientWidth
    && !e.closest("svg, canvas, table, .editor, #listing") && !e.querySelector("[role=tabpanel]")
    && !scrolls(e) && !isWhole(e));
  const groups = "main > *, #panel > *, .bar > *, #desk > *, #stage > *, #step > *, .cell > span";
  const neighbours = [...document.querySelectorAll(groups)]
    .filter((e) => e.checkVisibility() && e.clientHeight).map((e) => [e, e.getBoundingClientRect()]);
  const over = neighbours.flatMap(([a, p], i) => neighbours.slice(i + 1)
    .filter(([b, q]) => a.parentElement === b.parentElement
      && Math.min(p.right, q.right) - Math.max(p.left, q.left) > 1
      && Math.min(p.bottom, q.bottom) - Math.max(p.top, q.top) > 1)
    .map(([b]) => `${name(a)} on ${name(b)}`));
  const size = (e) => `${e.scrollWidth}/${e.clientWidth} ${e.scrollHeight}/${e.clientHeight}`;
  return [...cut.map((e) => `cut: ${name(e)} ${size(e)}`), ...over];
}"""

# The cards whose contents leave more than a third of them free, below or beside.
EMPTY = """() => [...document.querySelectorAll("main > section, #panel > section:not(#desk)")].flatMap((card) => {
  const box = card.getBoundingClientRect();
  const seen = [...card.querySelectorAll("*")].filter((e) => e.checkVisibility());
  const inside = seen.map((e) => e.getBoundingClientRect());
  const below = (box.bottom - Math.max(...inside.map((it) => it.bottom))) / box.height;
  const beside = (box.right - Math.max(...inside.map((it) => it.right))) / box.width;
  return Math.max(below, beside) > 0.34 ? [`${card.id}: ${Math.max(below, beside).toFixed(2)} is empty`] : [];
})"""


@pytest.fixture(scope="module", params=BROWSERS)
def browser(request: pytest.FixtureRequest, playwright: Playwright) -> Iterator[Browser]:
    """In place of Chromium alone."""
    with launch(playwright, request.param) as browser:
        yield browser


@pytest.fixture(scope="module")
def page(file: Path, open_shared: Callable[..., Page]) -> Page:
    page = open_shared(file.as_uri(), ready=READY, locale="de", reduced_motion="reduce")
    settle(page)
    return page


def faults(page: Page) -> list[str]:
    next_frame(page)
    return [*page.evaluate(FAULTS), *page.evaluate(EMPTY)]


def shown_steps(page: Page) -> Iterator[int]:
    """Shows each step of the lesson, without a click, which may scroll the page."""
    for step in range(page.locator("#step .head button").count()):
        page.evaluate("i => document.querySelectorAll('#step .head button')[i].click()", step)
        next_frame(page)
        yield step


def test_lesson_steps_are_in_view_with_arena_and_memory(page):
    page.click("#tab-lessons")
    for lesson in LESSONS:
        page.select_option("#lesson", lesson)
        page.click("#begin-lesson")
        settle(page)
        go(page, 600)
        for size in SIZES:
            resize(page, size)
            for language in ("en", "de"):
                page.select_option("#language", language)
                for step in shown_steps(page):
                    page.evaluate("scrollTo(0, 0)")
                    assert out_of_view(page, IN_VIEW, size) == [], (lesson, size, language, step)
                    assert page.evaluate("document.querySelector('#panel-lessons').scrollTop") == 0
                assert faults(page) == [], (lesson, size, language)


def test_controls_of_a_step_are_in_view_on_a_phone_and_not_covered(page):
    page.click("#tab-lessons")
    needed = ("#floors", "#play", "#step .head", "#step .held")
    resize(page, PHONE)
    for lesson in LESSONS:
        page.select_option("#lesson", lesson)
        page.evaluate("document.querySelector('#begin-lesson').click()")
        settle(page)
        for language in ("en", "de"):
            page.select_option("#language", language)
            for step in shown_steps(page):
                assert out_of_view(page, needed, PHONE) == [], (lesson, language, step)
                assert page.evaluate(COVERED) == [], (lesson, language, step)


@pytest.mark.parametrize("tab", ["run", "parameters", "listing", "program", "curves", "files", "talk"])
def test_tabs_have_nothing_cut_and_no_card_half_empty(tab, page):
    page.evaluate("octet.begin({ ...octet.lane.experiment, changes: [] })")
    settle(page)
    page.click(f"#tab-{tab}")
    for lanes in (1, 2):
        if lanes == 2:
            page.click("#what-if")
            settle(page)
        go(page, 3000)
        for size in SIZES:
            resize(page, size)
            page.evaluate("scrollTo(0, 0)")
            assert out_of_view(page, ("#floors", "#play", "#doing", "#what-if", "#tabs", "#cells"), size) == [], size
            assert faults(page) == [], (lanes, size)


def test_tabs_have_as_many_rows_whichever_is_chosen(page):
    for size in DESKTOPS:
        resize(page, size)
        for language in ("en", "de"):
            page.select_option("#language", language)
            assert len(set(page.evaluate(TAB_ROWS))) == 1, (size, language)


def test_world_names_fit_when_chosen_in_bold(page):
    resize(page, SIZES[0])
    page.click("#tab-run")
    for language in ("en", "de"):
        page.select_option("#language", language)
        for world in (*page.locator("#worlds input").all(), page.locator("#worlds input").first):
            world.check()
            assert faults(page) == []


def test_layout_check_finds_cut_overlapping_and_empty_elements(page):
    page.evaluate(
        "document.body.insertAdjacentHTML('beforeend', '<style id=planted>#doing { width: 20px; white-space: pre; }"
        "#desk { margin-top: -20px; } #reference { padding-bottom: 400px; }</style>')"
    )
    found = "\n".join(faults(page))
    page.evaluate("document.querySelector('#planted').remove()")

    assert out_of_view(page, ("#floors", "#no-such-thing"), (100, 100))[1:] == ["#no-such-thing is not shown"]
    assert "cut: doing" in found
    assert "memory on desk" in found
    assert "reference: 0." in found
