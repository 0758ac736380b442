"""All that matters is in view at every size, fingers can hit it, and axe-core finds nothing wrong."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest
from playwright.sync_api import Page

from tests.web.fake_run import HOME, FakeRun, robot_state
from tests.web.looks import (
    ARENA,
    DESKTOPS,
    PHONES,
    THREE_SIZES,
    TOO_SMALL,
    out_of_view,
    resize,
    too_small,
    violations,
    violations_at,
)
from tests.web.sim.node import with_modules
from tests.web.support import next_frame, wait_for

SIZES = DESKTOPS + PHONES
LIVE = ("#floors", "#play", "#scrub", "#after", "#speed", "#doing", "#cells", "#erase", "#lift", "#add-bar")
REPLAY = ("#floors", "#play", "#scrub", "#doing", "#cells", "#pin", "#before", "#after")
# How far from the middle of each item, at right angles to a bar, a finger may be: px.
REACH = """(modules) => {
  const { itemAt } = modules["edit/items.ts"];
  const { scene, renderer } = octet.lane;
  const [, ax, ay, bx, by] = scene.environment.bars[0];
  const length = Math.hypot(bx - ax, by - ay);
  const [nx, ny] = [(ay - by) / length, (bx - ax) / length];
  const [fx, fy] = scene.environment.food[0];
  const middles = {
    robot: [scene.state.x, scene.state.y], food: [fx, fy], bar: [(ax + bx) / 2, (ay + by) / 2],
  };
  const slack = renderer.lengthOf(22);
  const off = renderer.lengthOf(21);
  return Object.entries(middles)
    .filter(([kind, [x, y]]) => itemAt(scene, { x: x + nx * off, y: y + ny * off }, slack)?.kind !== kind)
    .map(([kind]) => kind);
}"""

# Where the tabs are while the run is played: their distances from the top of the page, px.
TAB_PLACES = """() => [...new Set(Array.from({ length: Math.floor((octet.last - octet.first) / 30) }, (_, i) => {
  octet.seek(octet.first + 30 * i);
  octet.draw();
  return Math.round(document.querySelector("#tabs").getBoundingClientRect().top + scrollY);
}))]"""

# The same while one fault after the other is told, beside the verdict on a try.
TOLD_PLACES = """() => [...new Set(["", ...document.querySelector("#fault").options].map((fault) => {
  octet.scene.news = !fault ? [] : [[octet.scene.environment.first_tick, `${fault.text}.`]];
  octet.draw();
  return Math.round(document.querySelector("#tabs").getBoundingClientRect().top + scrollY);
}))]"""


def fill(run: FakeRun) -> None:
    """Long words in every place."""
    trial = {"tick": 1, "cell": 7, "side": 1, "helped": 1, "frozen": 0}
    run.states[0] |= {
        "reason": 5,
        "pattern": 6,
        "trial": trial,
        "tick": 5000,
        "memory": [0, 1, 2, 1, 2, 1, 2, 1],
        "learned": [-1, *[4000] * 7],
        "uses": [0, *[322] * 7],
    }
    lesson = {"node": 1, "tick": 5, "cell": 7, "side": 1, "by_hand": 0}
    run.send(lessons=[{**lesson, "tick": tick} for tick in range(30)])


NEAR_THE_TOP = """() => {
  scrollTo(0, 400);
  const { x, y, right } = document.querySelector("canvas").getBoundingClientRect();
  return scrollY > 300 && x === 0 && y <= 1 && right === innerWidth;
}"""


@pytest.fixture(scope="module")
def live(open_shared: Callable[..., Page]) -> Page:
    """A full page, for all tests of this module."""
    run = FakeRun([robot_state(1, 800, 700)])
    page = open_shared(HOME, prepare=run.serve)
    fill(run)
    wait_for(page, "document.querySelector('#lessons').children.length === 30")
    return page


def test_live_page_has_its_controls_in_view_at_every_size(live):
    for size in SIZES:
        resize(live, size)
        assert out_of_view(live, LIVE, size) == [], size
        assert live.evaluate("document.documentElement.scrollWidth <= innerWidth"), size
        arena = live.locator("#floors").bounding_box()
        assert arena["height"] >= min(size[1] * 0.5, size[0] * 0.7), size


def test_live_page_shows_a_large_arena_first(live):
    assert too_small(live, ARENA, ".lane canvas") == []
    assert live.evaluate(NEAR_THE_TOP)


def test_replay_shows_a_large_arena_first(recorded: Path, open_page):
    page = open_page(recorded.as_uri())

    assert too_small(page, ARENA, ".lane canvas") == []
    assert page.evaluate(NEAR_THE_TOP)


@pytest.mark.parametrize("language", ["en", "de"])
def test_tabs_stay_where_they_are_while_a_run_plays(recorded: Path, open_page, language):
    page = open_page(recorded.as_uri(), locale=language)

    for size in THREE_SIZES:
        resize(page, size)
        assert len(page.evaluate(TAB_PLACES)) == 1, size
        assert len(page.evaluate(TOLD_PLACES)) == 1, size


def test_small_or_covered_arena_is_found(recorded: Path, open_page):
    page = open_page(recorded.as_uri())
    page.evaluate("document.querySelector('#stage').append(document.querySelector('.viewport'))")
    page.evaluate("document.querySelector('.viewport').style = 'position: absolute; left: 12px; top: 60px'")

    assert len(too_small(page, {(1366, 657): (720, 540)}, ".lane canvas")) == 1
    page.evaluate("document.querySelector('.viewport').remove()")
    assert too_small(page, {(1366, 657): (720, 540)}, ".lane canvas") == []
    page.evaluate("document.querySelector('.lane canvas').style.width = '500px'")
    assert len(too_small(page, {(1366, 657): (720, 540)}, ".lane canvas")) == 1


def test_replay_has_its_controls_in_view_even_while_it_compares(recorded: Path, open_page):
    page = open_page(recorded.as_uri())
    page.click("#pin")
    page.evaluate("octet.go(octet.last)")
    wait_for(page, "document.querySelectorAll('.cell.changed').length > 0")
    for size in SIZES:
        resize(page, size)
        assert out_of_view(page, REPLAY, size) == [], size
        assert page.evaluate("document.documentElement.scrollWidth <= innerWidth"), size


def out_of_legend(page: Page) -> list[str]:
    """What is not in view after one press, by size."""
    found = []
    for size in ((1366, 657), *PHONES):
        resize(page, size)
        page.evaluate("scrollTo(0, 0)")
        page.click("#to-legend")
        found += [f"{size}: {it}" for it in out_of_view(page, ("#legend",), size)]
    page.evaluate("scrollTo(0, 0)")
    return found


def test_legend_is_one_press_away_on_the_live_page(live):
    assert out_of_legend(live) == []


def test_legend_is_one_press_away_on_a_replay(recorded: Path, open_page):
    assert out_of_legend(open_page(recorded.as_uri())) == []


def test_printed_replay_is_one_white_sheet(recorded: Path, open_page):
    page = open_page(recorded.as_uri())
    page.evaluate("octet.go(octet.last)")
    next_frame(page)

    sheet = page.pdf(format="A4", margin=dict.fromkeys(("top", "right", "bottom", "left"), "10mm"))

    assert len(re.findall(rb"/Type\s*/Page\b", sheet)) == 1
    page.emulate_media(media="print")
    assert page.evaluate("getComputedStyle(document.body).backgroundColor") == "rgba(0, 0, 0, 0)"


def test_controls_and_arena_items_are_large_enough_for_touch_on_a_phone(live):
    for size in PHONES:
        resize(live, size)
        assert live.evaluate(TOO_SMALL) == [], size
        wait_for(live, "octet.lane.renderer.size.width === octet.lane.renderer.canvas.clientWidth")
        assert live.evaluate(with_modules(REACH, "edit/items.ts")) == [], size


def test_arena_stays_in_view_when_an_obstacle_is_added_on_a_phone(live):
    for size in PHONES:
        resize(live, size)
        live.click("#add-bar")
        assert out_of_view(live, ("#floors",), size) == [], size


def test_axe_finds_nothing_on_the_live_page(live):
    live.keyboard.press(" ")

    assert violations_at(live) == []


def test_axe_finds_nothing_on_the_replay(recorded: Path, open_page):
    page = open_page(recorded.as_uri())

    assert violations_at(page) == []


def test_axe_finds_a_text_with_low_contrast(live):
    live.evaluate("document.querySelector('#legend').innerHTML += '<p id=\"grey\" style=\"color: #ccc\">grey</p>'")

    found = violations(live)

    live.evaluate("document.querySelector('#grey').remove()")
    assert found != []
