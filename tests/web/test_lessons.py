"""The lessons of octet.html: each is done with real input until the page finds its goals reached, and not before."""

import itertools
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page

from tests.runs.support import octet
from tests.web.support import Faults, wait_for, wait_for_text
from tests.web.test_layout import TOO_SMALL, out_of_view, resize
from tests.web.test_octet_page import DONE, PHONES, READY, SIZES, simulated, violations
from tests.web.test_screens import check

REACHED = "[...document.querySelectorAll('#goals li')].map((goal) => goal.classList.contains('reached'))"
LESSONS = ("watch", "program", "boredom", "plant", "sensor", "share")
IN_VIEW = ("#floors", "#scrub", "#play", "#doing", "#what-if", "#tabs", "#lesson", "#begin-lesson", "#cells")
SENSORS = ("left", "front-left", "front", "front-right", "right")


@pytest.fixture(scope="module")
def file(tmp_path_factory) -> Path:
    path = tmp_path_factory.mktemp("page") / "octet.html"
    assert octet("page", path).returncode == 0
    return path


@pytest.fixture(scope="module")
def shared(file: Path, browser: Browser) -> Iterator[Page]:
    """One page for all tests that only do lessons in it."""
    page = browser.new_context().new_page()
    faults = Faults(file.as_uri())
    faults.listen(page)
    page.goto(f"{file.as_uri()}?#watch")
    wait_for(page, DONE)
    yield page
    page.context.close()
    assert faults.seen == []


@pytest.fixture
def lesson(shared: Page) -> Callable[[str], Page]:
    """Chooses a lesson, and begins it."""

    def begin(name: str) -> Page:
        resize(shared, SIZES[2])
        shared.emulate_media(color_scheme="light")
        shared.select_option("#lesson", name)
        shared.click("#begin-lesson")
        wait_for(shared, DONE)
        settle(shared)
        return shared

    return begin


def play_to_the_end(page: Page) -> None:
    """Plays a hundred times as fast as real time."""
    page.select_option("#speed", "100")
    page.click("#play")
    wait_for(page, "octet.tick >= octet.last && !octet.playing")
    settle(page)


def go(page: Page, tick: int) -> None:
    """Drags the strip below the arena, to its end at most."""
    page.locator("#scrub").fill(str(min(tick, page.evaluate("octet.last"))))
    settle(page)


def go_on(page: Page, ticks: int) -> None:
    go(page, page.evaluate("octet.tick") + ticks)


def settle(page: Page) -> None:
    """Waits until what changed is simulated and shown."""
    simulated(page)
    page.evaluate("new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)))")


def reached(page: Page) -> list[bool]:
    return page.evaluate(REACHED)


def write(page: Page, program: list[int]) -> None:
    """Presses each cell until it has its turn: 1 left, 2 right."""
    for cell, side in enumerate(program, 1):
        for _ in range(side):
            page.click(f"#cells li:nth-child({cell + 1}) button")
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

    go(page, page.evaluate("octet.last"))

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

    play_to_the_end(page)

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
    play_to_the_end(page)

    assert reached(page) == [True, True, True]


def test_boredom_is_not_done_by_a_patient_robot_or_by_one_that_is_bored_too_soon(lesson):
    page = lesson("boredom")
    play_to_the_end(page)
    assert reached(page) == [True, False, False]

    set_patience(page, 2)
    play_to_the_end(page)

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

    play_to_the_end(page)

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

    play_to_the_end(page)

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

    go(page, page.evaluate("octet.last"))

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

    go(page, page.evaluate("octet.last"))

    assert reached(page) == [False, False, False]


def test_the_language_is_the_browsers_until_another_is_chosen_which_stays(file, open_page):
    page = open_page(f"{file.as_uri()}?#program", ready=READY, locale="de-AT")
    assert page.inner_text("#begin-lesson") == "Lektion starten"
    assert page.get_attribute("#panel-lessons", "lang") == "de"

    page.select_option("#language", "en")
    assert page.inner_text("#begin-lesson") == "Start this lesson"
    page.reload()
    wait_for(page, READY)

    assert page.inner_text("#begin-lesson") == "Start this lesson"
    assert page.input_value("#lesson") == "program"


def test_a_language_that_is_not_there_is_english(file, open_page):
    page = open_page(f"{file.as_uri()}?#watch", ready=READY, locale="fi-FI")

    assert page.inner_text("#begin-lesson") == "Start this lesson"


def test_all_that_matters_is_in_view_while_a_lesson_is_open(lesson):
    page = lesson("program")
    for size in SIZES:
        resize(page, size)
        page.evaluate("scrollTo(0, 0)")
        page.wait_for_timeout(50)
        assert out_of_view(page, IN_VIEW, size) == [], size
    for size in (*SIZES, *PHONES):
        resize(page, size)
        assert page.evaluate("document.documentElement.scrollWidth <= innerWidth"), size


def test_each_lesson_can_be_used_by_fingers_and_by_screen_readers(lesson):
    page = lesson("watch")
    for name in LESSONS:
        page.select_option("#lesson", name)
        page.evaluate("document.querySelectorAll('#panel-lessons details').forEach((it) => { it.open = true; })")
        for size in PHONES:
            resize(page, size)
            assert page.evaluate(TOO_SMALL) == [], (name, size)
        resize(page, SIZES[0])
        assert violations(page) == [], name


def test_axe_finds_nothing_at_three_sizes_light_and_dark(lesson):
    page = lesson("sensor")
    go(page, 300)
    for scheme, size in itertools.product(("light", "dark"), (PHONES[0], SIZES[0], SIZES[-1])):
        page.emulate_media(color_scheme=scheme)
        resize(page, size)
        assert violations(page) == [], (scheme, size)


def test_screens(lesson):
    looks = (("program", "light", SIZES[2]), ("sensor", "dark", SIZES[0]), ("boredom", "dark", PHONES[0]))
    for name, scheme, size in looks:
        page = lesson(name)
        page.emulate_media(color_scheme=scheme)
        resize(page, size)
        page.wait_for_timeout(60)
        check(page, f"lesson-{name}-{scheme}-{size[0]}")


def printed(page: Page, folder: Path) -> str:
    """What goes to the printer, as a text."""
    seen = page.evaluate_handle(
        "(() => { const seen = []; addEventListener('beforeprint', () => queueMicrotask(() =>"
        " seen.push(document.querySelector('#sheet').innerText)), { once: true }); return seen; })()"
    )
    page.pdf(path=folder / "sheet.pdf", format="A4")
    return seen.json_value()[-1]


def test_who_prints_an_open_lesson_gets_its_worksheet(tmp_path, lesson):
    for name in LESSONS:
        page = lesson(name)
        words = page.evaluate("octet.course.texts.lessons[octet.course.plan.id]")

        text = printed(page, tmp_path)

        assert text.startswith(words["title"])
        assert [line for line in (*words["steps"], *words["goals"], *words["tasks"]) if line not in text] == []
        assert ("111" in text) == bool(words["table"])
        assert page.evaluate("document.querySelector('#sheet').childElementCount") == 0


def test_who_prints_another_tab_gets_the_page(tmp_path, lesson):
    page = lesson("watch")
    page.click("#tab-run")

    assert printed(page, tmp_path) == ""

    page.click("#tab-lessons")


def test_the_buttons_print_the_worksheet_and_the_notes(lesson):
    page = lesson("share")
    page.evaluate("window.print = () => { window.printed = document.querySelector('#sheet').innerText; }")

    page.click("text=Print the worksheet")
    sheet = page.evaluate("window.printed")
    page.click("text=Print the notes")
    notes = page.evaluate("window.printed")
    page.evaluate("dispatchEvent(new Event('afterprint'))")

    words = page.evaluate("octet.course.texts")
    answers = words["lessons"]["share"]["notes"]["answers"]
    assert [answer for answer in answers if answer in sheet or answer not in notes] == []
    assert [it["term"] for it in words["glossary"] if it["term"] not in notes] == []
