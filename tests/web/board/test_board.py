"""The board of a class, and what a pupil's page tells it."""

import itertools
import json

import pytest

from host_sim.live.class_roster import code_of, lesson_goals
from tests.web.looks import PHONES, SCHEMES, THREE_SIZES, TOO_SMALL, check, out_of_view, resize, violations_at
from tests.web.sim.page_runs import page_file
from tests.web.support import READY as PAGE_READY
from tests.web.support import wait_for, wait_for_text

READY = "window.octet?.class"
IN_VIEW = ("#qr", "#urls", "#code-form", "#class tbody tr:last-child")


@pytest.fixture
def one_pupil(hold_class, open_page):
    """The board and a pupil's page, and the page's address."""
    page, board = hold_class()
    return open_page(board, ready=READY), open_page(page, ready=PAGE_READY), page


def test_pupil_on_the_board_keeps_goals_after_reload_and_links_to_the_run(one_pupil):
    board, page, _ = one_pupil
    assert "token" not in board.url + page.url
    name = "<b>Ada</b> & Ben"
    page.fill("#my-name", name[:20])
    page.click("#tab-lessons")
    page.click("#begin-lesson")
    wait_for(page, "octet.scene && !octet.lane.isRunning")
    page.evaluate("octet.seek(octet.last)")

    wait_for(board, "octet.class.pupils[0]?.goals.watch?.length > 0 && document.querySelector('#class tbody th')")
    assert board.inner_text("#class tbody th") == name[:20]
    assert board.query_selector("#class b") is None
    page.reload()
    wait_for(page, PAGE_READY)
    assert page.input_value("#my-name") == name[:20]
    wait_for_text(page, "#class-news", "goals are on the board")
    wait_for(board, "octet.class.pupils.length === 1 && octet.class.pupils[0]?.goals.watch?.length > 0")
    with board.context.expect_page() as opened:
        board.click("#class a")
    wait_for(opened.value, PAGE_READY)
    seed = opened.value.evaluate("octet.lane.experiment.seed")
    assert f"&seed={seed}&" in opened.value.url  # the link that was there when it was pressed: the pupil goes on


def test_code_of_an_offline_page_brings_its_goals_to_the_board(one_pupil, tmp_path, open_page):
    board, _, _ = one_pupil
    page = open_page(page_file(tmp_path).as_uri(), ready=PAGE_READY)
    page.click("#tab-lessons")
    page.fill("#my-name", "Zo\u00eb")
    page.evaluate("octet.course.note([1, 2], [])")
    page.click("#class-name button")
    code = page.inner_text("#class-news").split()[-1]
    assert code == code_of("Zo\u00eb", {"watch": [1, 2]})

    board.fill("#code-name", "Zo\u00eb")
    board.fill("#code", code.lower())
    board.click("#code-form button")

    wait_for(board, "octet.class.pupils[0]?.goals.watch?.join() === '1,2'")
    board.fill("#code-name", "Ben")
    board.fill("#code", code)
    board.click("#code-form button")
    wait_for_text(board, "#code-news", "do not fit")
    board.click("#class button")
    wait_for(board, "octet.class.pupils.length === 0")


def test_board_with_thirty_pupils_fits_a_projector_and_is_accessible(hold_class, open_page):
    page, board_url = hold_class()
    pupil = open_page(page, ready=PAGE_READY)
    goals = {lesson: list(range(count))[: i % 4] for i, (lesson, count) in enumerate(lesson_goals().items())}
    report = {
        "lesson": "boredom",
        "step": 1,
        "goals": goals,
        "memory": [0, 1, 2, 0, 1, 2, 0, 1],
        "link": "#v=1&seed=7&end",
    }
    for i in range(30):
        said = json.dumps({**report, "key": f"{i:032x}", "name": f"Pupil number {i}"})
        assert pupil.evaluate("async (body) => (await fetch('report', { method: 'POST', body })).status", said) == 204

    board = open_page(board_url, ready=READY)
    wait_for(board, "document.querySelectorAll('#class tbody tr').length === 30")
    resize(board, (1920, 1080))
    assert out_of_view(board, IN_VIEW, (1920, 1080)) == []
    assert violations_at(board) == []
    for scheme, size in itertools.product(SCHEMES, THREE_SIZES):
        board.emulate_media(color_scheme=scheme)
        resize(board, size)
        check(board, f"board-{scheme}-{size[0]}")
    for size in PHONES:
        resize(board, size)
        assert board.evaluate(TOO_SMALL) == [], size


def test_page_says_when_the_board_does_not_answer_and_tries_again(one_pupil):
    _, page, _ = one_pupil
    page.fill("#my-name", "Ada")
    page.press("#my-name", "Tab")
    wait_for_text(page, "#class-news", "0 goals are on the board")

    page.context.set_offline(True)
    page.evaluate("octet.course.note([0], [])")

    wait_for_text(page, "#class-news", "tries again")
    page.context.set_offline(False)
    wait_for_text(page, "#class-news", "1 goals are on the board")


def test_short_address_opens_the_page(one_pupil, open_page):
    board, _, _ = one_pupil

    page = open_page("http://" + board.inner_text("#urls li:first-child").replace("\n", "").upper(), ready=PAGE_READY)

    assert page.input_value("#my-name") == ""
