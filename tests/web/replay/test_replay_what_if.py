"""A recorded run is changed on its page: the firmware runs on, in a copy, from any tick with whatever is changed."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest
from playwright.sync_api import Page

from tests.runs.support import octet, unpacked
from tests.web.fake_run import HOME
from tests.web.looks import TOO_SMALL, resize, violations_at
from tests.web.support import wait_for, wait_for_text

PHONES = [(390, 844), (844, 390)]
RECORDED = re.compile(r'"recorded":\{.*?\}')
COPIED = "octet.lanes.length === 2 && octet.lane.data && !octet.lane.isRunning"
SAME = "They do the same until the end."


@pytest.fixture(scope="module")
def page_of(tmp_path_factory) -> Callable[..., Path]:
    """Makes a run, and writes its page with all that What if? needs."""

    def make(*words: str | Path) -> Path:
        out = tmp_path_factory.mktemp("what_if")
        assert octet("run", "--bus", "none", "--quiet", "--out", out, *words).returncode in (0, 1)
        assert octet("replay", out / "run.log", "--html", out / "page.html", "--what-if").returncode == 0
        return out / "page.html"

    return make


@pytest.fixture(scope="module")
def plain(page_of) -> Path:
    return page_of("--environments", "1", "--seed", "3", "--profile", "adaptive", "--set", "turn_deg=15")


def ask(page: Page, tick: int) -> None:
    """Lays a copy beside the run at a tick."""
    page.evaluate("tick => octet.go(tick)", tick)
    page.click("#what-if")
    simulated(page)


def simulated(page: Page) -> None:
    wait_for(page, COPIED)


def test_copy_repeats_the_run_until_a_changed_cell_makes_another_future(plain, open_page):
    page = open_page(plain.as_uri())
    ask(page, 800)
    wait_for_text(page, "#parting", SAME)
    assert page.evaluate("[octet.tick, octet.lane.name, octet.lanes.length]") == [800, "copy", 2]

    page.click("#cells li:nth-child(2) button")
    simulated(page)

    wait_for_text(page, "#parting", "They diverge at")
    tick = page.evaluate("Number(/tick (\\d+)/.exec(document.querySelector('#parting').textContent)[1])")
    recorded, changed = page.evaluate("octet.lanes.map((lane) => [...lane.data.robots[0].columns.x])")
    assert tick > 800
    assert recorded[:tick] == changed[:tick]
    assert recorded != changed


@pytest.mark.parametrize("change", ["cell", "behaviour", "parameter", "from the start", "obstacle"])
def test_change_of_the_recorded_run_is_made_in_a_copy(plain, open_page, change):
    page = open_page(plain.as_uri())
    page.evaluate("octet.go(500)")

    if change == "cell":
        page.click("#cells li:nth-child(2) button")
    elif change == "obstacle":
        page.click("#add-bar")
    elif change == "parameter":
        page.click("#tab-parameters")
        page.locator(".slider input").first.fill("90")
        page.locator(".slider input").first.dispatch_event("change")
    else:
        page.select_option("#when", "now" if change == "behaviour" else "start")
        page.select_option("#behaviour", "searcher")
    simulated(page)

    wait_for_text(page, "#parting", "They diverge at")
    assert page.evaluate("octet.lanes.map(({ isRecorded }) => isRecorded)") == [True, False]


def test_copy_of_a_run_with_a_time_limit_ends_at_the_same_tick(page_of, open_page):
    page = open_page(page_of("--environments", "1", "--limit-s", "6").as_uri())
    ask(page, 100)
    wait_for_text(page, "#parting", SAME)

    page.select_option("#behaviour", "fixed")
    simulated(page)

    assert page.evaluate("octet.lanes.map(({ last }) => last)") == [299, 299]


def test_several_robots_and_their_memories_are_repeated(page_of, open_page, tmp_path):
    memory = tmp_path / "robot.mem"
    memory.write_bytes(bytes([0, 1, 0, 0, 2, 0, 0, 0]))
    words = ("--environments", "1", "--robots", "2", "--limit-s", "20", "--memory", memory)
    page = open_page(page_of(*words).as_uri())
    page.keyboard.press("2")

    ask(page, 300)

    wait_for_text(page, "#parting", SAME)
    assert page.evaluate("octet.scene.node") == 2


def test_copy_that_differs_from_the_recorded_run_is_reported(plain, page_of, open_page, tmp_path):
    other = RECORDED.search(unpacked(page_of("--environments", "1", "--seed", "4").read_text()))[0]
    mixed = tmp_path / "mixed.html"
    mixed.write_text(RECORDED.sub(lambda _: other, unpacked(plain.read_text())))
    page = open_page(mixed.as_uri())

    ask(page, 10)

    wait_for_text(page, "#parting", "The copy is not the recorded run: it differs from ")


@pytest.mark.parametrize(
    ("damage", "why"),
    [((r'"world":".*?[^\\]"', '"world":"nothing"'), "not a world file"), ((r'"wasm":"[^"]{1000}', '"wasm":"'), "")],
)
def test_damaged_page_says_why_its_run_cannot_be_repeated(plain, open_page, tmp_path, damage, why):
    broken = tmp_path / "broken.html"
    broken.write_text(re.sub(*damage, unpacked(plain.read_text())))
    page = open_page(broken.as_uri())

    page.click("#what-if")

    wait_for(page, "why => document.querySelector('#note').textContent.includes(why || ' ')", why)
    assert page.evaluate("octet.lanes.length") == 1


def test_new_run_replaces_the_recorded_one_until_the_back_button(plain, open_page):
    page = open_page(plain.as_uri())
    assert not page.is_visible("#back")

    page.click("#new-run button")
    wait_for(page, "octet.lane.data && !octet.lane.isRunning")
    assert page.evaluate("octet.lane.isRecorded") is False
    page.click("#back")

    wait_for(page, "window.octet?.lane.isRecorded")


def test_page_without_the_firmware_says_how_to_add_it(recorded, open_page):
    page = open_page(recorded.as_uri())
    command = "tools/octet replay out/run.log --html out/replay.html --what-if"

    for button in ("#what-if", "#add-bar", "#tab-lessons", "#cells li:nth-child(2) button"):
        page.evaluate("document.querySelector('#note').textContent = ''")
        page.click(button, force=True)  # it is marked as disabled
        wait_for_text(page, "#note", f"to add it: {command}")

    assert page.get_attribute("#behaviour", "title").endswith(command)
    assert page.evaluate("octet.lanes.length") == 1


def test_axe_finds_nothing_and_controls_are_large_enough_for_touch(plain, open_page):
    def serve(page: Page) -> None:
        page.route(HOME, lambda route: route.fulfill(body=plain.read_text(), content_type="text/html"))

    page = open_page(HOME, prepare=serve)  # as a live run's page is
    ask(page, 400)

    assert violations_at(page) == []
    for size in PHONES:
        resize(page, size)
        assert page.evaluate(TOO_SMALL) == [], size
