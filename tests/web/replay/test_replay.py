"""The page that a run leaves: one file, opened without a server."""

from collections.abc import Callable
from pathlib import Path

import pytest
from playwright.sync_api import Page

from tests.web.support import next_frame, wait_for


@pytest.fixture
def page(recorded: Path, open_page: Callable[..., Page]) -> Page:
    return open_page(recorded.as_uri())


def tick(page: Page) -> int:
    return page.evaluate("octet.tick")


def test_it_plays_and_pauses(page):
    page.select_option("#speed", "16")
    page.click("#play")
    wait_for(page, "octet.tick > 100")
    page.click("#play")
    now = tick(page)
    next_frame(page)
    assert tick(page) == now


def test_scrubbing_shows_any_tick_and_the_way_there(page):
    middle = page.evaluate("Math.floor(octet.data.last / 2)")
    page.locator("#scrub").fill(str(middle))
    assert tick(page) == middle
    scrubbed = page.evaluate("[octet.scene.state, octet.scene.trail.length]")
    page.evaluate("octet.go(0)")
    page.evaluate("tick => { for (let t = 0; t <= tick; t += 7) octet.go(t); octet.go(tick) }", middle)
    assert page.evaluate("octet.scene.state") == scrubbed[0]


@pytest.mark.parametrize("kind", ["trial", "lesson", "eat", "environment"])
def test_it_jumps_to_the_next_event_and_back(page, kind):
    page.select_option("#kind", kind)
    page.evaluate("octet.go(10)")
    page.click("#after")
    at = tick(page)
    assert [at, kind] in page.evaluate("octet.robot.run.events")
    assert at > 10
    page.evaluate("tick => octet.go(tick + 1)", at)
    page.click("#before")
    assert tick(page) == at


def test_it_compares_the_memory_at_two_times(page):
    page.click("#pin")
    page.evaluate("octet.go(octet.data.last)")
    wait_for(page, "document.querySelectorAll('.cell.changed').length > 0")
    assert "then: empty" in page.inner_text("#cells .changed >> nth=0")
    page.click("#pin")
    wait_for(page, "document.querySelectorAll('.cell.changed').length === 0")


def test_keyboard_alone(page):
    page.keyboard.press("ArrowRight")
    page.keyboard.press("Shift+ArrowRight")
    assert tick(page) == 51
    page.keyboard.press("End")
    assert tick(page) == page.evaluate("octet.data.last")
    page.keyboard.press("Home")
    page.keyboard.press("n")
    assert page.evaluate("octet.scene.state.reason") == 5
    page.keyboard.press("Space")
    wait_for(page, "octet.playing")
