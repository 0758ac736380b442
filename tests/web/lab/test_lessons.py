"""The lessons of octet.html: each is done with real input until the page finds its goals reached, and not before."""

import pytest
from playwright.sync_api import Page

from tests.web.lab.support import DONE, READY, go, go_on, go_to_step, go_to_the_end, reached, settle, ticked, write
from tests.web.support import wait_for, wait_for_text

SENSORS = ("left", "front-left", "front", "front-right", "right")


def play_to_the_end(page: Page) -> None:
    """Plays the last minute, a hundred times as fast as real time."""
    go(page, page.evaluate("octet.last") - 3000)
    page.select_option("#speed", "100")
    page.click("#play")
    wait_for(page, "octet.tick >= octet.last && !octet.playing")
    settle(page)


def test_watch_lesson_is_done_by_watching_the_robot_learn(lesson):
    page = lesson("watch")
    assert reached(page) == [False, False, False]

    go(page, 300)
    assert (reached(page), ticked(page)) == ([False, True, False], [1, 2, 3])
    go(page, 500)
    assert reached(page) == [True, True, False]
    go(page, 1300)

    assert reached(page) == [True, True, True]
    assert ticked(page) == [1, 2, 3, 4]
    wait_for_text(page, "#step #lesson-news.all", "Well done: all goals of this lesson are reached")


def test_watch_lesson_is_not_done_by_a_frozen_robot_with_written_cells(lesson):
    page = lesson("watch")
    page.click("#tab-run")
    page.click("#freeze")
    page.click("#tab-lessons")
    write(page, [1, 1, 1, 2, 1, 2, 1])

    go_to_the_end(page)

    assert reached(page) == [False, False, False]


def test_program_lesson_is_done_by_a_good_program(lesson):
    page = lesson("program")
    go_to_step(page, 2)
    for box, presses in enumerate([1, 1, 1, 2, 1, 2, 1], 1):
        for _ in range(presses):
            page.click(f"#step .boxes li:nth-child({box}) button")
            settle(page)
    assert (reached(page), ticked(page)) == ([True, False], [1, 2])

    go_to_step(page, 3)
    play_to_the_end(page)

    assert (reached(page), ticked(page)) == ([True, True], [1, 2, 3, 4])
    assert "learner: 0.196 s until its way is clear" in page.inner_text("#step .score")
    assert page.locator("figcaption").all_inner_texts() == ["learner: article, seed 48", "yours: article, seed 48"]


SENSIBLE = [[1, a, 1, 2, b, 2, c] for a in (1, 2) for b in (1, 2) for c in (1, 2)]


def test_sensible_programs_get_clear_sooner_and_finish_first(lesson):
    page = lesson("program")
    for program in SENSIBLE:
        page.evaluate(
            "program => { const { lane } = octet; lane.experiment = { ...lane.experiment, changes: program.map("
            "(side, i) => ({ do: 'write', robot: 0, cell: i + 1, side, tick: 0 })) }; octet.simulate(lane); }",
            program,
        )
        go_to_the_end(page)

        learner, yours = page.evaluate("octet.lanes.map((lane) => lane.last)")
        assert (yours < learner, reached(page)) == (True, [True, True]), program


@pytest.mark.parametrize("program", [[], [1, 1, 1, 1, 1, 2, 1]], ids=["nothing", "one wrong turn"])
def test_program_lesson_is_not_done_by_an_empty_or_wrong_program(lesson, program):
    page = lesson("program")
    write(page, program)

    go_to_the_end(page)

    assert reached(page) == [bool(program), False]


def set_patience(page: Page, turns: int) -> None:
    page.locator("#patience").fill(str(turns))
    page.locator("#patience").dispatch_event("change")
    settle(page)


def test_boredom_lesson_is_done_by_the_right_patience(lesson):
    page = lesson("boredom")
    go(page, 1000)
    assert reached(page) == [True, False, False]

    go(page, 0)
    go_to_step(page, 2)
    page.click("#step .held button")
    go_to_step(page, 3)
    set_patience(page, 10)
    go_to_the_end(page)

    assert (reached(page), ticked(page)) == ([True, True, True], [1, 2, 3, 4])


def test_boredom_lesson_is_not_done_by_a_robot_bored_never_or_too_soon(lesson):
    page = lesson("boredom")
    go_to_the_end(page)
    assert reached(page) == [True, False, False]

    go_to_step(page, 4)
    set_patience(page, 2)
    go_to_the_end(page)

    assert reached(page) == [True, True, False]


def pass_a_plant(page: Page) -> None:
    """Puts a plant before the robot, and lets it get past."""
    page.locator("#step .held button").last.click()
    settle(page)
    go_on(page, 150)


def test_plant_lesson_is_done_by_passing_plants(lesson):
    page = lesson("plant")
    pass_a_plant(page)
    assert reached(page) == [True, False, False]
    while page.evaluate("octet.tick") < 1500 and not reached(page)[1]:
        go_on(page, 100)
        pass_a_plant(page)
    assert reached(page) == [True, True, False]

    go_to_step(page, 4)
    page.locator("#step .held button").first.click()
    settle(page)
    pass_a_plant(page)

    assert (reached(page), ticked(page)) == ([True, True, True], [1, 2, 3, 4])


def test_plant_lesson_is_not_done_without_a_plant(lesson):
    page = lesson("plant")
    page.click("#erase")

    go_to_the_end(page)

    assert reached(page) == [False, False, False]


def break_sensor(page: Page, name: str, state: str) -> None:
    page.locator(".sensors select").nth(SENSORS.index(name)).select_option(state)
    settle(page)


def distrust(page: Page) -> None:
    go_to_step(page, 3)
    page.check("#step .check input")
    settle(page)


def test_sensor_lesson_is_done_with_broken_sensors(lesson):
    page = lesson("sensor")
    go(page, 100)
    break_sensor(page, "front", "stuck-on")
    go_on(page, 600)
    assert reached(page) == [True, False, False]

    distrust(page)
    go(page, 4000)
    assert reached(page) == [True, True, False]
    go(page, 200)
    go_to_step(page, 4)
    for name in SENSORS[1:4]:
        break_sensor(page, name, "stuck-off")
    go(page, 3000)

    assert (reached(page), ticked(page)) == ([True, True, True], [1, 2, 3, 4])


def test_sensor_lesson_is_not_done_by_a_sound_robot(lesson):
    page = lesson("sensor")
    distrust(page)

    go_to_the_end(page)

    assert reached(page) == [False, False, False]


def test_sensor_lesson_is_not_done_by_a_repaired_robot(lesson):
    page = lesson("sensor")
    go(page, 100)
    for state in ("stuck-on", "stuck-off", "sound"):
        break_sensor(page, "front", state)
    distrust(page)

    go_to_the_end(page)

    assert reached(page) == [False, False, False]


def test_share_lesson_is_done_by_robots_that_talk(lesson):
    page = lesson("share")
    go_to_step(page, 2)
    page.click("#step .held button")
    go_to_step(page, 3)
    page.check("#step .check input")
    settle(page)
    assert (reached(page), ticked(page)) == ([True, False, False], [1, 2, 3])

    go(page, 200)
    assert reached(page) == [True, True, False]
    go(page, 500)

    assert reached(page) == [True, True, True]


def test_share_lesson_is_not_done_by_silent_robots_or_written_cells(lesson):
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


def test_talk_lesson_is_done_by_questions_and_a_taught_answer(lesson):
    page = lesson("talk")
    go_to_step(page, 2)
    go(page, 1500)
    say(page, "eliza", "Why did you turn left?")
    assert reached(page) == [False, False, False]
    say(page, "robot", "why did you turn left")
    assert reached(page) == [True, False, False]

    go_to_step(page, 4)
    page.fill("#teach-word", "cheese")
    page.fill("#teach-answer", "I like cheese")
    page.press("#teach-answer", "Enter")
    say(page, "robot", "Do you know cheese?")
    assert reached(page) == [True, True, False]

    go_to_step(page, 5)
    say(page, "robot", "What have you learned?")
    page.click("#step .boxes li:nth-child(2) button")
    settle(page)
    say(page, "robot", "What have you learned?")
    assert (reached(page), ticked(page)) == ([True, True, True], [1, 2, 3, 4, 5])


def test_talk_lesson_is_not_done_by_word_answers_or_passing_time(lesson):
    page = lesson("talk")
    go_to_step(page, 2)
    for tick in (0, 1500):
        go(page, tick)
        for who in ("robot", "eliza"):
            say(page, who, "What have you learned, and do you love me?" if who == "eliza" else "Do you love me?")
            say(page, "robot", "How sure are you?")

    assert reached(page) == [False, False, False]


def test_unlearn_lesson_is_done_with_swapped_motors(lesson):
    page = lesson("unlearn")
    go(page, 499)
    go_to_step(page, 2)
    page.click("#step .held button")
    settle(page)
    assert (
        page.evaluate("octet.lanes.map((lane) => lane.experiment.changes)")
        == [[{"do": "body", "what": "swap-motors", "robot": 0, "seed": 0, "tick": 500}]] * 2
    )
    assert (reached(page), ticked(page)) == ([False, False, False], [1, 2])

    go(page, 605)
    assert reached(page) == [True, False, False]
    go(page, 1890)
    assert (reached(page), ticked(page)) == ([True, True, False], [1, 2, 3])
    go_to_step(page, 4)
    go_to_the_end(page)

    assert (reached(page), ticked(page)) == ([True, True, True], [1, 2, 3, 4])
    assert page.inner_text("#step .score").startswith("article: 21.097 s")
    assert page.evaluate("octet.lanes.map((lane) => Math.round(lane.last * 0.02))") == [999, 245]


def test_unlearn_lesson_is_not_done_with_sound_motors(lesson):
    page = lesson("unlearn")

    go_to_the_end(page)

    assert (reached(page), ticked(page)) == ([False, False, False], [1, 4])


def run_samples(page: Page, count: int) -> str:
    page.click(f"#step .counts button:text-is('{count}')")
    wait_for(page, f"octet.course.samples.count === {count}")
    settle(page)
    return page.inner_text("#step .samples p")


def test_chance_lesson_is_done_by_samples_of_many_runs(lesson):
    page = lesson("chance")
    go_to_the_end(page)
    assert page.evaluate("octet.lanes.map((lane) => Math.round(lane.last * 0.02))") == [59, 74]
    assert (reached(page), ticked(page)) == ([True, False, False], [1])

    go_to_step(page, 2)
    assert run_samples(page, 1) == "article: one run, 59 s\nsearcher: one run, 74 s"
    assert run_samples(page, 10) == (
        "article: 10 runs, mean 120 s, probably 76 to 165 s\nsearcher: 10 runs, mean 60 s, probably 19 to 101 s"
    )
    assert (reached(page), ticked(page)) == ([True, True, False], [1, 2])
    assert run_samples(page, 100) == (
        "article: 100 runs, mean 164 s, probably 147 to 181 s\nsearcher: 100 runs, mean 59 s, probably 48 to 69 s"
    )
    assert (reached(page), ticked(page)) == ([True, True, True], [1, 2, 3])
    assert page.locator("#step .samples circle:not(.mean)").count() == 200

    go_to_step(page, 4)
    page.locator("#step .samples select").last.select_option("never")
    run_samples(page, 10)
    assert ticked(page) == [1, 2, 3, 4]


def test_matchboxes_lesson_is_done_by_learning_and_swapped_motors(lesson):
    page = lesson("matchboxes")
    assert (reached(page), ticked(page)) == ([False, False, False], [])
    for _ in range(3):
        page.click("#step-done")
    go(page, 1070)
    assert (reached(page), ticked(page)) == ([True, False, False], [1, 2, 3, 4])
    assert "●●●" in page.inner_text("#step .boxes")

    go(page, 2999)
    go_to_step(page, 5)
    page.click("#step .held > button")
    settle(page)
    go(page, 3710)
    assert reached(page) == [True, True, False]
    go(page, 4060)

    assert (reached(page), ticked(page)) == ([True, True, True], [1, 2, 3, 4, 5])


def test_lesson_step_keeps_the_focus_when_it_is_ticked(lesson):
    page = lesson("program")
    go_to_step(page, 2)
    for box, presses in enumerate([1, 1, 1, 2, 1, 2, 1], 1):
        button = page.locator(f"#step .boxes li:nth-child({box}) button")
        button.focus()
        for _ in range(presses):
            page.keyboard.press("Enter")
            settle(page)

    assert ticked(page) == [1, 2]
    assert page.evaluate("document.activeElement.closest('.boxes') !== null")
    assert page.locator("#step .foot").inner_text().startswith("✓ The page has seen it: done.")


def test_restarted_lesson_has_no_goal_reached(lesson):
    page = lesson("watch")
    go(page, 500)
    assert any(reached(page))

    page.click("#begin-lesson")
    wait_for(page, DONE)
    settle(page)

    assert reached(page) == [False, False, False]


def test_goals_are_not_reached_before_a_lesson_is_started(file, open_page):
    page = open_page(f"{file.as_uri()}?#watch", ready=READY)
    wait_for(page, DONE)

    go_to_the_end(page)

    assert reached(page) == [False, False, False]
