"""Pages that talk to the robots of a live run."""

import pytest

from host_sim.live.feed import PageFeed
from host_sim.live.page_commands import Question, page_command_from
from host_sim.live.page_talk import PageTalk


def test_a_robot_that_has_not_begun_knows_nothing(live):
    assert PageTalk(live()).answer(Question("robot", "What have you learned?"))["said"]["mark"] == "words"


def test_each_robot_answers_for_itself(live):
    run = live(robots=2)
    for _ in range(20):
        run.simulation.step(1)
    talk = PageTalk(run)

    said = [talk.answer(Question("robot", "Where are you?", node)) for node in (1, 2, 31)]

    assert {it["said"]["mark"] for it in said} == {"log"}
    assert said[0]["said"]["text"] != said[1]["said"]["text"]
    assert said[0]["said"]["text"] == said[2]["said"]["text"]  # a robot that is not there: the first
    places = [[round(part, 1) for part in body.pose[:2]] for body in run.simulation.arena.bodies]
    assert [it["places"] for it in said[:2]] == [[places[0]], [places[1]]]


def test_an_answer_comes_with_the_next_message_and_only_once(live):
    run = live()
    run.simulation.step(1)
    feed = PageFeed(run)
    feed.ask(Question("eliza", "Hello"))

    assert feed.next().count('"answers"') == 1
    run.change += 1
    assert '"answers"' not in feed.next()


def test_a_question_in_a_message_is_checked():
    asked = page_command_from('{"do": "ask", "who": "robot-de", "text": "Wo bist du?", "node": 2}')

    assert asked == Question("robot-de", "Wo bist du?", 2)


@pytest.mark.parametrize(
    "fields", ['"who": "../robot", "text": ""', '"who": "robot"', '"who": ["robot"], "text": "x"']
)
def test_a_question_to_nobody_or_without_words_is_refused(fields):
    with pytest.raises(ValueError, match="who must be one of"):
        page_command_from(f'{{"do": "ask", {fields}}}')
