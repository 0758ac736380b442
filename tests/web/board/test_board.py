"""The board of a class: what it shows, what it does, and how it looks."""

import itertools
import re
from collections.abc import Callable

import pytest
from playwright.sync_api import Page

from tests.web.live.test_class import board_url
from tests.web.looks import PHONES, SCHEMES, THREE_SIZES, TOO_SMALL, check, out_of_view, resize, violations_at
from tests.web.support import wait_for, wait_for_text

READY = "window.octet?.message"
HAS_A_LINE = "(path) => path.getAttribute('d').includes('L')"
NAME = re.compile(r"Robot \d\d+\.\d s")
KNOWS = re.compile(r"(knows \d of 7|✓ knows all 7 patterns), ate \d+")
OWN = "window.octet?.scene?.state && document.querySelector('#own-robot').textContent !== ''"


@pytest.fixture
def lesson(watch, open_page) -> Callable[..., tuple[Page, list[Page]]]:
    """Opens a board and then pages."""

    def begin(robots: int, pages: int, *words: str) -> tuple[Page, list[Page]]:
        watched = watch("--listen", "127.0.0.1", "--robots", str(robots), *words)
        board = open_page(board_url(watched), ready=READY)
        return board, [open_page(watched.url, ready=OWN) for _ in range(pages)]

    return begin


def test_a_name_tag_is_shown_as_it_was_typed_and_stays_after_a_reload(lesson):
    board, (page,) = lesson(2, 1)
    tag = "<b>Ada</b> & Ben"
    page.fill("#my-name", tag)
    page.click("#name-form button")

    wait_for_text(board, "#robots li:first-child", tag)
    assert board.query_selector("#robots b") is None
    assert re.fullmatch("1 of 2 robots have a page.", board.inner_text("#present"))
    page.reload()
    wait_for(page, OWN)
    assert page.input_value("#my-name") == tag
    assert page.inner_text("#own-robot") == "Robot 1 is yours."
    wait_for_text(board, "#robots li:first-child", tag)


def test_the_board_begins_and_every_curve_grows(lesson):
    board, (page,) = lesson(3, 1, "--environments", "9")
    wait_for_text(board, "#status", "stand still until you press Begin")
    assert page.inner_text("#status") == "waiting for the board to begin"

    board.select_option("#speed", "0")
    board.click("#play")

    wait_for(board, "octet.curves.most('trials') > 3 && octet.curves.most('cells') > 1")
    assert board.evaluate(f"[...document.querySelectorAll('#robots path')].every({HAS_A_LINE})")
    board.select_option("#curve", "blocked")
    wait_for(board, "octet.message.ended[1] > 0")
    for form, words in ((NAME, ".name"), (KNOWS, ".knows")):
        assert [text for text in board.locator(words).all_text_contents() if not form.fullmatch(text)] == []
    assert board.inner_text("#result") != ""
    board.select_option("#speed", "1")
    wait_for(board, "octet.message.play.speed === 1")
    clock_ms = board.evaluate("octet.message.clock_ms")
    board.click("#again")
    wait_for(
        board,
        "before => octet.message.clock_ms < before && octet.curves.ticks.at(-1) * octet.message.tick_ms < before",
        clock_ms,
    )


def test_a_page_shows_and_changes_its_own_robot_and_has_no_other_controls(lesson):
    board, pages = lesson(2, 2)
    second = pages[1]
    board.click("#play")

    second.click("#cells li:nth-child(2) button")

    wait_for(second, "octet.scene.state.memory[1] === 1")
    wait_for(board, "octet.message.robots[1].sides[1] === 1 && octet.message.robots[0].sides[1] === 0")
    assert second.evaluate("octet.scene.node") == 2
    for control in ("#play", "#speed", "#next", "#seed", "#add-bar"):
        assert not second.is_visible(control), control


def test_a_page_without_a_robot_watches(watch, open_page):
    url = watch("--listen", "127.0.0.1", "--robots", "2").url
    page = open_page(url, ready=OWN)
    open_page(url, ready=OWN)

    watcher = open_page(url, ready=OWN)

    assert watcher.inner_text("#own-robot") == "Every robot has a page already: here you can watch."
    assert not watcher.is_visible("#erase")
    assert page.is_visible("#erase")


def test_all_robots_of_a_class_are_in_view_of_a_projector(lesson):
    board, _ = lesson(31, 0)

    resize(board, (1920, 1080))

    last = "#robots li:nth-child(31)"
    assert out_of_view(board, ("#qr", "#urls", "#play", "#robots li:first-child", last), (1920, 1080)) == []


def test_axe_finds_nothing_fingers_hit_everything_and_texts_can_be_read(lesson):
    board, (page,) = lesson(8, 1)
    board.click("#play")
    wait_for(board, "octet.runs")
    board.click("#play")
    wait_for(board, "!octet.message.play.playing")
    for view in (board, page):
        view.emulate_media(reduced_motion="reduce")
        assert violations_at(view) == []
    for view, (scheme, size) in itertools.product((board, page), itertools.product(SCHEMES, THREE_SIZES)):
        view.emulate_media(color_scheme=scheme)
        resize(view, size)
        check(view, f"{'board' if view is board else 'pupil'}-{scheme}-{size[0]}")
    for view, size in itertools.product((board, page), PHONES):
        resize(view, size)
        assert view.evaluate(TOO_SMALL) == [], size
