"""The lessons of octet.html: each is done with real input until the page finds its goals reached, and not before."""

import pytest
from playwright.sync_api import Page

from tests.web.lab.support import DONE, READY, go, go_on, go_to_the_end, reached, settle, write
from tests.web.support import wait_for, wait_for_text

SENSORS = ("left", "front-left", "front", "front-right", "right")


def play_to_the_end(page: Page) -> None:
    """Plays the last minute, a hundred times as fast as real time."""
    go(page, page.evaluate("octet.last") - 3000)
    page.select_option("#speed", "100")
    page.click("#play")
    wait_for(page, "octet.tick >= octet.last && !octet.playing")
    settle(page)


def test_watch(lesson):
    page = lesson("watch")
    assert reached(page) == [False, False, False]

    go(page, 300)
    assert reached(page) == [False, True, False]
    go(page, 500)
    assert reached(page) == [True, True, False]
    go(page, 1300)

    assert reached(page) == [True, True, True]
    wait_for_text(page, "#lesson-news", "all goals of this lesson are reached")


def test_watch_is_not_done_by_a_robot_that_is_frozen_and_told(lesson):
    page = lesson("watch")
    page.click("#tab-run")
    page.click("#freeze")
    page.click("#tab-lessons")
    write(page, [1, 1, 1, 2, 1, 2, 1])

    go_to_the_end(page)

    assert reached(page) == [False, False, False]


def test_program(lesson):
    page = lesson("program")
    write(page, [1, 1, 1, 2, 1, 2, 1])
    assert reached(page) == [True, False]

    play_to_the_end(page)

    assert reached(page) == [True, True]
    assert "0.145 s until its way is clear" in page.inner_text(".score")


@pytest.mark.parametrize("program", [[], [1, 1, 1, 1, 1, 2, 1]], ids=["nothing", "one wrong turn"])
def test_program_is_not_done_by_less_than_a_good_one(lesson, program):
    page = lesson("program")
    write(page, program)

    go_to_the_end(page)

    assert reached(page) == [bool(program), False]


def set_patience(page: Page, turns: int) -> None:
    page.locator("#patience").fill(str(turns))
    page.locator("#patience").dispatch_event("change")
    settle(page)


def test_boredom(lesson):
    page = lesson("boredom")
    go(page, 1000)
    assert reached(page) == [True, False, False]

    go(page, 0)
    page.click("#what-if")
    set_patience(page, 10)
    go_to_the_end(page)

    assert reached(page) == [True, True, True]


def test_boredom_is_not_done_by_a_patient_robot_or_by_one_that_is_bored_too_soon(lesson):
    page = lesson("boredom")
    go_to_the_end(page)
    assert reached(page) == [True, False, False]

    set_patience(page, 2)
    go_to_the_end(page)

    assert reached(page) == [True, True, False]


def pass_a_plant(page: Page) -> None:
    """Puts a plant before the robot, and lets it get past."""
    page.click("#add-plant")
    settle(page)
    go_on(page, 150)


def test_plant(lesson):
    page = lesson("plant")
    pass_a_plant(page)
    assert reached(page) == [True, False, False]
    while page.evaluate("octet.tick") < 1500 and not reached(page)[1]:
        go_on(page, 100)
        pass_a_plant(page)
    assert reached(page) == [True, True, False]

    page.click("#erase")
    settle(page)
    pass_a_plant(page)

    assert reached(page) == [True, True, True]


def test_plant_is_not_done_without_a_plant(lesson):
    page = lesson("plant")
    page.click("#erase")

    go_to_the_end(page)

    assert reached(page) == [False, False, False]


def break_sensor(page: Page, name: str, state: str) -> None:
    page.locator(".sensors select").nth(SENSORS.index(name)).select_option(state)
    settle(page)


def test_sensor(lesson):
    page = lesson("sensor")
    go(page, 100)
    break_sensor(page, "front", "stuck-on")
    go_on(page, 600)
    assert reached(page) == [True, False, False]

    page.check(".sensors input")
    settle(page)
    go(page, 4000)
    assert reached(page) == [True, True, False]
    go(page, 200)
    for name in SENSORS[1:4]:
        break_sensor(page, name, "stuck-off")
    go(page, 3000)

    assert reached(page) == [True, True, True]


def test_sensor_is_not_done_by_a_sound_robot(lesson):
    page = lesson("sensor")
    page.check(".sensors input")
    settle(page)

    go_to_the_end(page)

    assert reached(page) == [False, False, False]


def test_sensor_is_not_done_by_one_that_was_repaired(lesson):
    page = lesson("sensor")
    go(page, 100)
    for state in ("stuck-on", "stuck-off", "sound"):
        break_sensor(page, "front", state)
    page.check(".sensors input")
    settle(page)

    go_to_the_end(page)

    assert reached(page) == [False, False, False]


def test_share(lesson):
    page = lesson("share")
    page.click("#what-if")
    page.check("#panel-lessons .check input")
    settle(page)
    assert reached(page) == [True, False, False]

    go(page, 200)
    assert reached(page) == [True, True, False]
    go(page, 500)

    assert reached(page) == [True, True, True]


def test_share_is_not_done_by_robots_that_do_not_talk_nor_by_a_person_who_does(lesson):
    page = lesson("share")
    page.click("#what-if")
    write(page, [1, 0, 0, 2])

    go_to_the_end(page)

    assert reached(page) == [False, False, False]


def say(page: Page, who: str, sentence: str) -> None:
    page.select_option("#talk-who", who)
    page.fill("#talk-line", sentence)
    page.press("#talk-line", "Enter")
    settle(page)


def test_talk(lesson):
    page = lesson("talk")
    go(page, 1500)
    say(page, "eliza", "Why did you turn left?")
    assert reached(page) == [False, False, False]
    say(page, "robot", "why did you turn left")
    assert reached(page) == [True, False, False]

    page.fill("#teach-word", "cheese")
    page.fill("#teach-answer", "I like cheese")
    page.press("#teach-answer", "Enter")
    say(page, "robot", "Do you know cheese?")
    assert reached(page) == [True, True, False]

    say(page, "robot", "What have you learned?")
    page.click("#cells li:nth-child(3) button")
    settle(page)
    say(page, "robot", "What have you learned?")
    assert reached(page) == [True, True, True]


def test_talk_is_not_done_by_words_nor_by_a_log_that_only_goes_on(lesson):
    page = lesson("talk")
    for tick in (0, 1500):
        go(page, tick)
        for who in ("robot", "eliza"):
            say(page, who, "What have you learned, and do you love me?" if who == "eliza" else "Do you love me?")
            say(page, "robot", "How sure are you?")

    assert reached(page) == [False, False, False]


def test_a_lesson_that_is_started_again_has_no_goal_reached(lesson):
    page = lesson("watch")
    go(page, 500)
    assert any(reached(page))

    page.click("#begin-lesson")
    wait_for(page, DONE)
    settle(page)

    assert reached(page) == [False, False, False]


def test_nothing_is_reached_before_a_lesson_is_started(file, open_page):
    page = open_page(f"{file.as_uri()}?#watch", ready=READY)
    wait_for(page, DONE)

    go_to_the_end(page)

    assert reached(page) == [False, False, False]
