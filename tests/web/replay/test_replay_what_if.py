"""What if? on the page of a recorded run: the firmware runs on from any tick with whatever is changed."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest
from playwright.sync_api import Frame, Page

from tests.runs.support import octet
from tests.web.fake_run import HOME
from tests.web.looks import TOO_SMALL, resize, violations_at
from tests.web.support import wait_for, wait_for_text

PHONES = [(390, 844), (844, 390)]
LABORATORY = re.compile(r'<script type="application/json" id="laboratory">.*?</script>', re.DOTALL)
REPEATED = "document.querySelector('#what-if-news').textContent.startsWith('A is')"
SAME = "A is the recorded run, tick for tick; B is yours to change."


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


def ask(page: Page, tick: int) -> Frame:
    """Opens the laboratory at a tick."""
    page.evaluate("tick => octet.go(tick)", tick)
    page.click("#what-if")
    wait_for(page, REPEATED)
    return page.frames[1]


def simulated(lab: Frame) -> None:
    wait_for(lab, "octet.simulator.running === undefined && octet.simulator.queued.size === 0")


def test_the_recorded_run_is_repeated_and_a_changed_cell_makes_another_future(plain, open_page):
    page = open_page(plain.as_uri())
    lab = ask(page, 800)
    assert page.inner_text("#what-if-news") == SAME
    assert lab.evaluate("[octet.tick, octet.lane.name, octet.lanes.length]") == [800, "copy", 2]

    lab.click("#cells li:nth-child(2) button")
    simulated(lab)

    wait_for_text(lab, "#parting", "They diverge at")
    tick = lab.evaluate("Number(/tick (\\d+)/.exec(document.querySelector('#parting').textContent)[1])")
    x = "octet.lanes.map((lane) => [...lane.data.robots[0].columns.x])"
    recorded, changed = lab.evaluate(x)
    assert tick > 800
    assert recorded == page.evaluate("[...octet.robot.columns.x]")
    assert recorded[:tick] == changed[:tick]
    assert recorded != changed


@pytest.mark.parametrize("change", ["behaviour", "parameter", "obstacle"])
def test_a_behaviour_a_parameter_or_an_obstacle_makes_another_future(plain, open_page, change):
    lab = ask(open_page(plain.as_uri()), 500)

    if change == "behaviour":
        lab.select_option("#behaviour", "searcher")
    elif change == "parameter":
        lab.click("#tab-parameters")
        lab.locator(".slider input").first.fill("90")
        lab.locator(".slider input").first.dispatch_event("change")
    else:
        lab.click("#add-bar")
    simulated(lab)

    wait_for_text(lab, "#parting", "They diverge at")


def test_a_future_goes_on_where_the_recorded_run_was_ended_early(page_of, open_page):
    page = open_page(page_of("--environments", "1", "--limit-s", "6").as_uri())
    lab = ask(page, 100)
    assert page.inner_text("#what-if-news") == SAME

    lab.select_option("#behaviour", "fixed")
    simulated(lab)

    assert lab.evaluate("octet.lanes[1].last") == page.evaluate("octet.data.last") == 299


def test_several_robots_and_their_memories_are_repeated(page_of, open_page, tmp_path):
    memory = tmp_path / "robot.mem"
    memory.write_bytes(bytes([0, 1, 0, 0, 2, 0, 0, 0]))
    words = ("--environments", "1", "--robots", "2", "--limit-s", "20", "--memory", memory)
    page = open_page(page_of(*words).as_uri())
    page.keyboard.press("2")

    lab = ask(page, 300)

    assert page.inner_text("#what-if-news") == SAME
    assert lab.evaluate("octet.scene.node") == 2


def test_a_run_that_it_repeats_otherwise_is_told(plain, page_of, open_page, tmp_path):
    other = LABORATORY.search(page_of("--environments", "1", "--seed", "4").read_text())[0]
    mixed = tmp_path / "mixed.html"
    mixed.write_text(LABORATORY.sub(lambda _: other, plain.read_text()))
    page = open_page(mixed.as_uri())

    ask(page, 10)

    assert page.inner_text("#what-if-news").startswith("A is not the recorded run: it differs from ")


def test_a_run_that_it_cannot_repeat_is_told_on_the_page(plain, open_page, tmp_path):
    broken = tmp_path / "broken.html"
    broken.write_text(re.sub(r'"world":".*?[^\\]"', '"world":"nothing"', plain.read_text()))
    page = open_page(broken.as_uri())

    page.click("#what-if")

    wait_for_text(page, "#no-what-if", "that is not a world file")
    assert not page.evaluate("document.querySelector('dialog').open")


def test_a_damaged_laboratory_is_told_on_the_page(plain, open_page, tmp_path):
    broken = tmp_path / "broken.html"
    broken.write_text(re.sub(r'{"page":"[^"]{1000}', '{"page":"', plain.read_text()))
    page = open_page(broken.as_uri())

    page.click("#what-if")

    wait_for(page, "document.querySelector('#no-what-if').textContent !== ''")
    assert not page.evaluate("document.querySelector('dialog').open")


def test_it_closes_and_the_recorded_run_is_where_it_was(plain, open_page):
    page = open_page(plain.as_uri())
    ask(page, 700)

    page.click("#back")

    wait_for(page, "document.querySelector('iframe') === null")
    assert page.evaluate("octet.tick") == 700
    page.keyboard.press("w")
    wait_for(page, REPEATED)
    page.keyboard.press("ArrowRight")
    assert page.evaluate("octet.tick") == 700


def test_keys_leave_the_recorded_run_where_it_is_while_the_laboratory_opens(plain, open_page):
    page = open_page(plain.as_uri())

    press = "document.body.dispatchEvent(new KeyboardEvent('keydown', { key, bubbles: true }))"
    page.evaluate(f"['w', 'ArrowRight'].forEach((key) => {press})")

    assert page.evaluate("[octet.tick, document.querySelector('dialog').open]") == [0, True]


def test_a_page_without_it_says_how_to_get_it(recorded, open_page):
    page = open_page(recorded.as_uri())

    page.click("#what-if")

    command = "tools/octet replay out/run.log --html out/replay.html --what-if"
    wait_for_text(page, "#no-what-if", f"This command writes one that does: {command}")


def test_axe_finds_nothing_and_fingers_hit_everything(plain, open_page):
    def serve(page: Page) -> None:
        page.route(HOME, lambda route: route.fulfill(body=plain.read_text(), content_type="text/html"))

    page = open_page(HOME, prepare=serve)  # axe-core cannot reach into a frame of a file
    ask(page, 400)

    assert violations_at(page) == []
    for size in PHONES:
        resize(page, size)
        assert page.evaluate(TOO_SMALL) == [], size
