"""The board of a class: what it shows, what it does, and how it looks."""

import itertools
import re
from collections.abc import Callable

import pytest
from playwright.sync_api import Page

from tests.web.live.test_class import board_url
from tests.web.looks import PHONES, SCHEMES, THREE_SIZES, TOO_SMALL, blank, check, out_of_view, resize, violations_at
from tests.web.support import next_frame, wait_for, wait_for_text

READY = "window.octet?.message"
CLOCK = "(octet.scene.state.tick - octet.scene.environment.start_tick)"
TABLE_IS_TRUE = """() => octet.scene.states.every(({ memory }, robot) => {
  const row = document.querySelectorAll("#class tbody tr")[robot];
  const sides = [...row.querySelectorAll("[data-side]")].map((cell) => cell.dataset.side);
  const known = memory.slice(1).filter(Boolean).length;
  const held = memory.slice(1).map((side) => ["nothing", "left", "right"][side]);
  return sides.join() === held.join() && row.innerText.includes(`${known}/7`);
})"""
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

    wait_for_text(board, "#class tbody tr:first-child", tag)
    assert board.query_selector("#class b") is None
    wait_for(board, "tag => octet.scene.tags[0].name === tag && octet.scene.tags[1].name === '2'", tag)
    assert re.fullmatch("1 of 2 robots have a page.", board.inner_text("#present"))
    page.reload()
    wait_for(page, OWN)
    assert page.input_value("#my-name") == tag
    assert page.inner_text("#own-robot") == "Robot 1 is yours."
    wait_for_text(board, "#class tbody tr:first-child", tag)


def test_the_board_begins_and_every_curve_grows(lesson):
    board, (page,) = lesson(3, 1, "--environments", "9")
    wait_for_text(board, "#status", "stand still until you press Begin")
    assert page.inner_text("#status") == "waiting for the board to begin"

    board.select_option("#speed", "0")
    board.click("#play")

    wait_for(board, "['trials', 'cells'].every((name) => [0, 1, 2].every((i) => octet.curves.last(i, name) > 1))")
    board.select_option("#curve", "blocked")
    wait_for(board, "octet.message.board.ended[1] > 0")
    wait_for(board, TABLE_IS_TRUE)
    assert re.fullmatch(r"\d of \d", board.inner_text("#fact-finished"))
    board.select_option("#speed", "1")
    wait_for(board, "octet.message.play.speed === 1")
    ticks = board.evaluate(CLOCK)
    board.click("#again")
    wait_for(board, f"before => {CLOCK} < before && octet.curves.ticks.at(-1) < before", ticks)


def test_a_page_shows_and_changes_its_own_robot_and_has_no_other_controls(lesson):
    board, pages = lesson(2, 2)
    second = pages[1]
    board.click("#play")

    second.click("#cells li:nth-child(2) button")

    wait_for(second, "octet.scene.state.memory[1] === 1")
    wait_for(board, "octet.scene.states[1].memory[1] === 1 && octet.scene.states[0].memory[1] === 0")
    assert second.evaluate("octet.scene.node") == 2
    for control in ("#play", "#speed", "#next", "#seed", "#add-bar"):
        assert not second.is_visible(control), control


def test_the_arena_keeps_its_shape_whatever_size_its_canvas_had(lesson):
    board, _ = lesson(2, 0)

    board.evaluate("octet.renderer.canvas.width = octet.renderer.canvas.height = 1")
    next_frame(board)

    box = board.locator("#floor").bounding_box()
    assert box["width"] / box["height"] == pytest.approx(4080 / 3080, rel=0.01)


def test_a_page_without_a_robot_watches(watch, open_page):
    url = watch("--listen", "127.0.0.1", "--robots", "2").url
    page = open_page(url, ready=OWN)
    open_page(url, ready=OWN)

    watcher = open_page(url, ready=OWN)

    assert watcher.inner_text("#own-robot") == "Every robot already has a page: here you can watch."
    assert not watcher.is_visible("#erase")
    assert page.is_visible("#erase")


def test_a_board_with_six_robots_fills_the_projector(lesson):
    board, _ = lesson(6, 1)

    for size in ((1920, 1080), (1366, 657)):
        resize(board, size)
        assert blank(board) <= 0.15, size
        everything = ("#arena", "#qr", "#urls", "#play", "#chart", "#class tbody tr:last-child", "#facts")
        assert out_of_view(board, everything, size) == []
    board.evaluate("document.querySelector('#arena').remove()")
    assert blank(board) > 0.5


def test_all_robots_of_a_class_are_in_view_of_a_projector(lesson):
    board, _ = lesson(31, 0)

    resize(board, (1920, 1080))

    tables = tuple(f"#class table:nth-child({i}) tbody tr:last-child" for i in (1, 2))
    assert out_of_view(board, ("#arena", "#qr", "#urls", "#play", *tables), (1920, 1080)) == []


def test_the_short_address_leads_to_the_page(lesson, open_page):
    board, _ = lesson(2, 0)

    page = open_page("http://" + board.inner_text("#urls li:first-child").replace("\n", "").upper(), ready=OWN)

    assert page.inner_text("#own-robot") == "Robot 1 is yours."
    wait_for_text(board, "#present", "1 of 2")


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
