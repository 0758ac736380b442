"""The page says what the terminal says."""

from host_sim.protocol.generated import Reason
from host_sim.report.drawing import MARKS
from host_sim.view import phrases
from tests.web.fake_run import HOME, FakeRun, robot_state

SAY = """async (lists) => {
  const { lessonSentence, sentence } = await import("/core/phrases.js");
  return [lists[0].map((state) => sentence(state, false)), lists[1].map((lesson) => lessonSentence(lesson))];
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


def test_every_reason_has_its_colours_its_name_and_its_width(open_page):
    page = open_page(HOME, prepare=FakeRun([robot_state(1, 800, 700)]).serve)

    assert page.evaluate("octet.view.renderer.palette.reasons.every((colour) => /^#/.test(colour))")
    assert page.locator("#legend [data-reason]").count() == len(Reason) == len(MARKS)
    assert page.evaluate("import('/draw/trail_layer.js').then(({ WIDTH_MM }) => WIDTH_MM.size)") == len(Reason)
