"""A live run is looked back at, forked, and once it has ended its page is that of the recorded run."""

import time
from collections.abc import Callable

import pytest
from playwright.sync_api import Page

from host_sim.live.server import HAND_OVER_S
from host_sim.protocol.generated import Opcode
from tests.runs.support import octet
from tests.web.live.test_server import ask
from tests.web.replay.test_replay_what_if import COPIED
from tests.web.support import Watched, pause, run_in, wait_for, wait_for_text

SAME = "They do the same until one of them ends, at "


@pytest.fixture
def watched(watch) -> Watched:
    return watch("--seed", "2")


@pytest.fixture
def page(watched: Watched, open_page: Callable[..., Page]) -> Page:
    page = open_page(watched.url)
    wait_for(page, "octet.scene.state.tick > 100")
    return page


def look_back(page: Page, tick: int) -> None:
    """Drags the slider back."""
    page.locator("#scrub").fill(str(tick))
    recorded(page)


def recorded(page: Page) -> None:
    """Waits until the page shows the recording."""
    wait_for(page, "!octet.live")


def test_slider_goes_back_to_any_tick_and_a_button_to_the_present(page):
    look_back(page, 60)

    assert page.evaluate("octet.tick") == 60
    page.keyboard.press("ArrowRight")
    assert page.evaluate("octet.scene.state.tick") == 61
    last = page.evaluate("octet.last")
    assert last > 100
    wait_for_text(page, "#status", "The run so far")
    page.keyboard.press("End")
    page.click("#back")
    wait_for(page, "last => octet.scene?.state.tick > last && octet.play?.playing", last)
    assert not page.is_visible("#back")


def test_slider_follows_the_run_until_it_is_dragged(page):
    wait_for(page, "document.querySelector('#scrub').max > 100")
    pause(page)
    assert page.evaluate("(({ value, max }) => value === max)(document.querySelector('#scrub'))")

    page.evaluate(
        "(scrub) => { scrub.value = 50; scrub.dispatchEvent(new Event('input')); octet.draw() }",
        page.locator("#scrub").element_handle(),
    )

    assert page.input_value("#scrub") == "50"
    recorded(page)
    wait_for_text(page, "#clock", "0:01.0")


def test_selected_robot_stays_when_looking_back_and_returning(watch, open_page):
    page = open_page(watch("--robots", "2").url)
    wait_for(page, "octet.scene.state.tick > 50")
    page.keyboard.press("2")

    look_back(page, 20)
    assert page.evaluate("octet.scene.node") == 2
    page.click("#back")
    wait_for(page, "octet.live")

    assert page.evaluate("octet.scene.node") == 2


def test_parameter_is_set_in_a_copy_and_not_in_the_live_run(watched, page):
    page.click("#tab-parameters")
    page.locator("#panel-parameters input").first.fill("90")
    page.locator("#panel-parameters input").first.dispatch_event("change")
    wait_for(page, COPIED)
    wait_for(page, "octet.lanes[1].experiment.changes.some((it) => it.do === 'set')")

    assert watched.end() == 0
    assert [it for it in watched.commands() if it["opcode"] == Opcode.SET] == []


def test_key_w_lays_a_copy_of_the_run_so_far_beside_it(page):
    pause(page)
    tick = page.evaluate("octet.scene.state.tick")
    page.keyboard.press("w")
    recorded(page)
    wait_for(page, COPIED)

    wait_for_text(page, "#parting", SAME)
    assert page.evaluate("[octet.tick, octet.lanes[0].last, octet.lanes[1].last > octet.tick]") == [tick, tick, True]


def test_page_of_an_ended_run_is_its_recording_with_working_buttons(watched, page):
    assert watched.end() == 0

    recorded(page)
    wait_for_text(page, "#status", "The run has ended. This is its recording")
    assert not page.is_visible("#back")
    assert page.evaluate("octet.tick === octet.last && octet.last > 100")
    page.select_option("#kind", "environment")
    page.click("#before")
    assert page.evaluate("octet.tick < octet.last")
    page.keyboard.press("w")
    wait_for(page, COPIED)
    wait_for_text(page, "#parting", SAME)


def test_end_of_the_run_is_reported_beside_its_copy(watched, page):
    page.keyboard.press("w")
    wait_for(page, COPIED)
    before = page.evaluate("[octet.tick, octet.lanes[0].last]")

    assert watched.end() == 0

    wait_for_text(page, "#status", "the live run has ended")
    page.select_option("#language", "de")
    wait_for_text(page, "#status", "der Live-Lauf ist zu Ende")
    wait_for(page, "last => octet.lanes[0].last > last", before[1])
    assert page.evaluate("octet.tick") == before[0]
    page.set_viewport_size({"width": 400, "height": 800})
    assert page.is_visible("#status")


def test_end_of_the_run_is_reported_in_another_run_with_a_back_button(watched, page):
    page.evaluate("octet.begin({ ...octet.lane.experiment, seed: 9 })")
    wait_for(page, "!octet.live && octet.lane.data && !octet.lane.isRunning")

    assert watched.end() == 0

    wait_for_text(page, "#status", "the live run has ended")
    page.click("#back")
    wait_for_text(page, "#status", "This is its recording")
    page.keyboard.press("w")
    wait_for(page, COPIED)
    wait_for_text(page, "#parting", SAME)


def test_recording_shown_after_the_run_is_that_made_of_its_log(watched, page):
    assert watched.end() == 0
    recorded(page)
    again = watched.out / "again.html"

    assert octet("replay", watched.out / "run.log", "--html", again).returncode == 0

    shown = page.evaluate("({ ...octet.recorded.run, title: null })")
    assert shown == run_in(again)


def test_page_that_fetches_no_recording_delays_the_end_not_the_run_time(watch, open_page):
    began = time.monotonic()
    watched = watch("--seed", "2")
    page = open_page(watched.url)
    wait_for(page, "octet.scene.state.tick > 10")
    page.evaluate("void (window.fetch = () => Promise.reject(new Error('no network')))")
    passed_s = time.monotonic() - began

    assert watched.end() == 0

    assert time.monotonic() - began > passed_s + HAND_OVER_S
    assert watched.summary()["wall_s"] < passed_s + HAND_OVER_S / 2


def test_recording_is_refused_without_the_token(watched):
    host, port = watched.url.split("/")[2].split(":")
    address = (host, int(port), "")

    assert ask(address, "/recorded").status == 403
    assert ask(address, f"/recorded?{watched.url.partition('?')[2]}").status == 404  # nobody watches: no tick yet
