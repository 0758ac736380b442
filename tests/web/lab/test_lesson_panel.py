"""The panel of lessons in octet.html: its languages, how it looks, and what it prints."""

import re
from pathlib import Path

from playwright.sync_api import Page

from tests.web.lab.support import LESSONS, READY, SIZES, go, reached, settle
from tests.web.looks import PHONES, TOO_SMALL, check, out_of_view, resize, violations, violations_at
from tests.web.support import next_frame, wait_for

IN_VIEW = ("#floors", "#scrub", "#play", "#doing", "#what-if", "#tabs", "#lesson", "#begin-lesson", "#cells")


def test_language_is_the_browsers_until_another_is_chosen_and_kept(file, open_page):
    page = open_page(f"{file.as_uri()}?#program", ready=READY, locale="de-AT")
    assert page.inner_text("#begin-lesson") == "Lektion starten"
    assert page.get_attribute("html", "lang") == "de"

    page.select_option("#language", "en")
    assert page.inner_text("#begin-lesson") == "Start this lesson"
    page.reload()
    wait_for(page, READY)

    assert page.inner_text("#begin-lesson") == "Start this lesson"
    assert page.input_value("#lesson") == "program"


def test_lesson_name_in_the_address_scrolls_nothing(file, open_page):
    for name in LESSONS:
        page = open_page(f"{file.as_uri()}?#{name}", ready=READY, viewport={"width": 1366, "height": 657})
        next_frame(page)

        assert page.evaluate("[scrollY, document.querySelector('#panel-lessons').scrollTop]") == [0, 0], name
        assert page.evaluate("name => document.getElementById(name)", name) is None
        assert page.input_value("#lesson") == name
        page.context.close()


def test_unknown_language_falls_back_to_english(file, open_page):
    page = open_page(f"{file.as_uri()}?#watch", ready=READY, locale="fi-FI")

    assert page.inner_text("#begin-lesson") == "Start this lesson"


def test_goals_steps_and_the_lesson_survive_a_reload(page):
    def seen() -> tuple[str, list[bool], list[str]]:
        return page.input_value("#lesson"), reached(page), page.locator("#step .head button").all_inner_texts()

    page.click("#tab-lessons")
    page.select_option("#lesson", "plant")
    page.select_option("#lesson", "watch")
    page.click("#begin-lesson")
    settle(page)
    go(page, 500)
    before = seen()
    assert before[:2] == ("watch", [True, True, False])
    assert before[2] == ["1 ✓", "2 ✓", "3 ✓", "4"]

    page.reload()
    wait_for(page, READY)
    page.click("#tab-lessons")
    settle(page)

    assert seen() == before


def test_progress_made_in_another_tab_is_kept(file, page):
    other = page.context.new_page()
    other.goto(file.as_uri())
    wait_for(other, READY)
    page.evaluate("octet.course.choose('watch'), octet.course.tick(0)")
    other.evaluate("octet.course.choose('plant'), octet.course.tick(1)")
    wait_for(page, "localStorage.getItem('octet-lessons').includes('plant')")
    page.evaluate("octet.course.tick(1)")

    page.reload()
    wait_for(page, READY)

    steps = "Object.entries(octet.course.progress).map(([lesson, { steps }]) => [lesson, steps])"
    assert dict(page.evaluate(steps)) == {"watch": [0, 1], "plant": [1]}


def test_controls_are_in_view_at_every_size_while_a_lesson_is_open(lesson):
    page = lesson("program")
    for size in SIZES:
        resize(page, size)
        page.evaluate("scrollTo(0, 0)")
        assert out_of_view(page, IN_VIEW, size) == [], size
    for size in (*SIZES, *PHONES):
        resize(page, size)
        assert page.evaluate("document.documentElement.scrollWidth <= innerWidth"), size


def test_lessons_have_touch_targets_and_no_axe_violations(lesson):
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

    assert violations_at(page, (PHONES[0], SIZES[0], SIZES[-1])) == []


def test_lesson_screens_are_readable_and_fit_the_width(lesson):
    looks = (("program", "light", SIZES[2]), ("sensor", "dark", SIZES[0]), ("boredom", "dark", PHONES[0]))
    for name, scheme, size in looks:
        page = lesson(name)
        page.emulate_media(color_scheme=scheme)
        resize(page, size)
        check(page, f"lesson-{name}-{scheme}-{size[0]}")


def printed(page: Page, folder: Path) -> str:
    """What goes to the printer, as a text."""
    seen = page.evaluate_handle(
        "(() => { const seen = []; addEventListener('beforeprint', () => queueMicrotask(() =>"
        " seen.push(document.querySelector('#sheet').innerText)), { once: true }); return seen; })()"
    )
    page.pdf(path=folder / "sheet.pdf", format="A4")
    return seen.json_value()[-1]


def pages_printed(page: Page, landscape: bool) -> int:
    return len(re.findall(rb"/Type\s*/Page\b", page.pdf(format="A4", landscape=landscape)))


def test_printing_an_open_lesson_gives_its_worksheet(tmp_path, lesson):
    for name in LESSONS:
        page = lesson(name)
        words = page.evaluate("octet.course.texts.lessons[octet.course.plan.id]")

        text = printed(page, tmp_path)

        assert text.startswith(words["title"])
        assert [line for line in (*words["steps"], *words["goals"], *words["tasks"]) if line not in text] == []
        assert ("111" in text) == page.evaluate("octet.course.plan.id in octet.course.texts.tables")
        assert page.evaluate("document.querySelector('#sheet').childElementCount") == 0


def test_printing_another_tab_gives_the_page(tmp_path, lesson):
    page = lesson("watch")
    page.click("#tab-run")

    assert printed(page, tmp_path) == ""
    assert [pages_printed(page, landscape) for landscape in (False, True)] == [1, 2]

    page.click("#tab-lessons")


def test_buttons_print_the_worksheet_and_the_notes(lesson):
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
    assert [term for term, _ in words["glossary"] if term not in notes] == []
