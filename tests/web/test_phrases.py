"""The page says what the terminal says, whatever the numbers of reasons and sides are."""

import re
from collections.abc import Callable

import pytest
from playwright.sync_api import Page

from host_sim.base.paths import WEB
from host_sim.protocol.generated import Reason
from host_sim.report.drawing import MARKS
from host_sim.view import phrases
from tests.web.fake_run import HOME, FakeRun, robot_state

SAY = """async (lists) => {
  const { lessonSentence, sentence } = await import("/core/phrases.js");
  return [lists[0].map((state) => sentence(state, false)), lists[1].map(lessonSentence)];
}"""
LEFT, RIGHT = {"left": -9, "right": 9}, {"left": 9, "right": -9}
STATES = [
    robot_state(1, 0, 0, **fields)
    for reason in Reason
    for pattern in range(8)
    for fields in (
        {"reason": reason, "pattern": pattern, **LEFT, "repeat_count": 10},
        {"reason": reason, "pattern": pattern, **RIGHT, "beacon": 1250, "repeat_count": 3},
        {"reason": reason, "pattern": pattern, **RIGHT, "lifted": 1},
    )
]
LESSONS = [
    {"tick": 0, "cell": cell, "side": side, "by_hand": by_hand}
    for cell in range(1, 8)
    for side, by_hand in ((0, 0), (1, 0), (2, 0), (0, 1), (1, 1), (2, 1))
]
IN_TERMINAL = [[phrases.sentence(it) for it in STATES], [phrases.lesson_sentence(it) for it in LESSONS]]


def test_the_sentences_are_those_of_the_terminal(open_page):
    page = open_page(HOME, prepare=FakeRun([robot_state(1, 800, 700)]).serve)

    assert page.evaluate(SAY, [STATES, LESSONS]) == IN_TERMINAL


def renumbered() -> str:
    """generated.js with every reason one number up, and left and right swapped."""
    text = (WEB / "generated.js").read_text()
    text = re.sub(r"(?<=REASON = )\{[^}]*\}", lambda match: _rotated(match[0]), text)
    text = re.sub(r"(?<=SIDE = )\{[^}]*\}", "{ NOTHING: 0, LEFT: 2, RIGHT: 1 }", text)
    return re.sub(r"(?<=SIDES = )\[[^]]*\]", '["nothing", "right", "left"]', text)


def _rotated(table: str) -> str:
    numbers = [int(number) for number in re.findall(r": (\d+)", table)]
    rotated = iter(numbers[1:] + numbers[:1])
    return re.sub(r": \d+", lambda _: f": {next(rotated)}", table)


def words(open_page: Callable[..., Page], parts: dict[str, str]) -> list[list[str]]:
    """What a page with `renumbered` parts says, of states and lessons in its numbers."""
    page = open_page(HOME, prepare=FakeRun([robot_state(1, 800, 700)], parts).serve)
    states = [{**state, "reason": (state["reason"] + 1) % len(Reason)} for state in STATES]
    lessons = [{**lesson, "side": (0, 2, 1)[lesson["side"]]} for lesson in LESSONS]
    return page.evaluate(SAY, [states, lessons])


def test_other_numbers_change_no_word(open_page):
    assert words(open_page, {"generated.js": renumbered()}) == IN_TERMINAL


@pytest.mark.parametrize(("name", "number"), [("REASON.TRIAL", "5"), ("SIDE.LEFT", "1")])
def test_a_number_that_stands_by_hand_is_noticed(open_page, name, number):
    text = (WEB / "core/phrases.js").read_text()
    by_hand = text.replace(name, number)
    assert by_hand != text

    assert words(open_page, {"generated.js": renumbered(), "core/phrases.js": by_hand}) != IN_TERMINAL


def test_every_reason_has_its_colours_its_name_and_its_width(open_page):
    page = open_page(HOME, prepare=FakeRun([robot_state(1, 800, 700)]).serve)

    assert page.evaluate("octet.view.renderer.palette.reasons.every((colour) => /^#/.test(colour))")
    assert page.locator("#legend [data-reason]").count() == len(Reason) == len(MARKS)
    assert page.evaluate("import('/draw/trail_layer.js').then(({ WIDTH_MM }) => WIDTH_MM.size)") == len(Reason)
