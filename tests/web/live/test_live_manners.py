"""How the live page treats people: what it says, where it says it, and what cannot go wrong by a slip of the hand."""

import re
import time
from collections.abc import Callable
from itertools import pairwise

import pytest
from playwright.sync_api import Page

from host_sim.recording import phrases
from tests.web.fake_run import ENVIRONMENT, HOME, MEASURES, PAUSED, FakeRun, robot_state
from tests.web.looks import resize
from tests.web.sim.node import with_modules
from tests.web.support import DEADLINE_S, drag, place_on_page, wait_for, wait_for_text

PLAY = {**PAUSED, "playing": True}
ENDED = {
    "number": 1,
    "finished": True,
    "eaten": 3,
    "food": 3,
    "robot_s": 83.4,
    "environments": 1,
    "environments_finished": 1,
    "environments_robot_s": 83.4,
}
BODY_COLOUR = """() => {
  const { renderer, scene } = octet.lane;
  const at = scene.state;
  const place = (mm) => Math.round((mm + 40) * renderer.scale);
  return [...renderer.context.getImageData(place(at.x - 50), place(at.y), 1, 1).data].join();
}"""


@pytest.fixture
def run() -> FakeRun:
    return FakeRun([robot_state(1, 800, 700)])


@pytest.fixture
def page(open_page: Callable[..., Page], run: FakeRun) -> Page:
    return open_page(HOME, prepare=run.serve, viewport={"width": 1440, "height": 900})


def box(page: Page, selector: str) -> dict[str, float]:
    found = page.locator(selector).bounding_box()
    assert found is not None
    return found


def commands(page: Page, run: FakeRun, count: int) -> list[dict]:
    """The last commands, when so many have come."""
    give_up = time.monotonic() + DEADLINE_S
    while len(run.commands) < count:
        assert time.monotonic() < give_up, f"{len(run.commands)} of {count} commands"
        page.wait_for_timeout(10)
    return run.commands


def test_robot_cannot_be_dragged_through_a_wall(page, run):
    for end in ((-400, 700), (4300, 2900), (2000, 3300)):
        run.commands.clear()
        drag(page, (800, 700), end)

        put = commands(page, run, 2)[-1]
        assert put["do"] == "put"
        assert 100 < put["at"][0] < 3900
        assert 100 < put["at"][1] < 2900
        run.send(notes=["there is no room for the robot"])
        wait_for(page, "octet.scene.ghosts.size === 0")


def test_lifted_robot_cannot_be_moved_through_a_wall_by_keys(page, run):
    page.locator(".lane canvas").focus()
    page.keyboard.press("p")
    run.states[0]["lifted"] = 1
    run.send()
    for _ in range(30):
        page.keyboard.press("ArrowLeft")

    assert 100 < page.evaluate("octet.scene.ghosts.get(1).x") < 110


def test_robot_that_could_not_be_lifted_is_drawn_where_it_is(page, run):
    drag(page, (800, 700), (2000, 1500))
    run.send(notes=["the run is over: start over to see more"])

    wait_for(page, "octet.scene.ghosts.size === 0")


def test_refusal_is_shown_beside_the_pressed_button(page, run):
    for button in ("#add-bar", "#lift", "#erase"):
        page.click(button)
        run.send(notes=[f"there is no room for the robot, says {button}"])
        wait_for_text(page, "#note", f"says {button}")

        note, pressed = box(page, "#note"), box(page, button)
        assert abs(note["y"] - pressed["y"]) < 120
        assert abs(note["x"] - pressed["x"]) < 400
        assert note["y"] + note["height"] <= 900


def test_refusal_is_shown_where_an_item_was_dropped(page, run):
    drag(page, (500, 2500), (3900, 2900))
    run.send(notes=["that is outside of the arena"])
    wait_for_text(page, "#note", "that is outside of the arena")

    note, dropped = box(page, "#note"), place_on_page(page, 3900, 2900)
    assert abs(note["y"] - dropped[1]) < 120
    assert abs(note["x"] - dropped[0]) < 400


def test_refusal_is_shown_beside_the_focused_control(page, run):
    page.locator("#erase").focus()
    page.keyboard.press("Enter")
    run.send(notes=["the robot refused a command"])
    wait_for_text(page, "#note", "the robot refused a command")

    assert abs(box(page, "#note")["y"] - box(page, "#erase")["y"]) < 120


def colours(page: Page, run: FakeRun, reasons: list[int]) -> list[str]:
    """The colour of the body after each of these states."""
    seen = []
    for tick, reason in enumerate(reasons, start=10):
        run.states[0] |= {"tick": tick, "reason": reason}
        run.send(play=PLAY)
        wait_for(page, "tick => octet.scene.states[0].tick === tick && !octet.stale", tick)
        seen.append(page.evaluate(BODY_COLOUR))
    return seen


def test_body_colour_does_not_flicker_while_the_robot_wanders(page, run):
    assert len(set(colours(page, run, [1, 3] * 20))) == 1


def test_body_colour_does_not_flicker_between_turns_and_steps(page, run):
    seen = colours(page, run, [4, 1] * 10)

    assert sum(a != b for a, b in pairwise(seen)) <= 2


def test_more_important_reason_changes_the_body_colour_at_once(page, run):
    seen = colours(page, run, [1, 5])

    assert seen[0] != seen[1]


def test_banner_reports_the_end_of_an_environment_in_large_letters(page, run):
    run.states[0]["eaten"] = [1, 1, 1]
    run.send(play=PLAY | {"ended": ENDED})
    wait_for_text(page, "#banner", "All food eaten")

    assert "1:23.4" in page.inner_text("#banner")
    assert page.inner_text("#fact-food") == "0 of 3"
    assert (
        page.evaluate("parseFloat(getComputedStyle(document.querySelector('#banner'), '::first-line').fontSize)") > 24
    )
    run.send(play=PLAY)
    wait_for(page, "document.querySelector('#banner').textContent === ''")


def test_banner_says_all_done_at_the_end_of_the_run(page, run):
    run.send(play=PLAY | {"done": True, "ended": ENDED | {"environments": 5, "environments_finished": 4}})

    wait_for_text(page, "#banner", "ALL DONE")
    assert "4 of 5 environments finished" in page.inner_text("#banner")


def test_buttons_without_effect_are_disabled_after_the_end(page, run):
    run.send(play=PLAY | {"done": True, "ended": ENDED})
    wait_for_text(page, "#banner", "ALL DONE")

    for button in ("#play", "#lift", "#add-bar", "#break"):
        assert page.locator(button).is_disabled(), button
    page.click("#after")
    wait_for_text(page, "#note", "There is no later decision")
    assert run.commands == []
    assert page.get_by_role("button", name="Start over").is_enabled()


def test_starting_over_is_reported_and_resets_clock_and_lessons(page, run):
    lesson = {"node": 1, "tick": 5, "cell": 2, "side": 1, "by_hand": 0}
    run.send(lessons=[lesson])
    wait_for_text(page, "#lessons", "Learned")
    run.states[0] |= {"tick": 1050}
    run.send(environment={**ENVIRONMENT, "seed": 8, "first_tick": 1000, "start_tick": 1000}, play=PLAY)

    wait_for_text(page, "#note", "Started over with seed 8: empty memory, learning is on.")
    wait_for(page, "document.querySelector('#lessons').textContent === 'Nothing yet.'")
    assert page.inner_text("#fact-time") == "0:01.0"


def test_starting_over_keeps_the_memory_only_if_asked_to(page, run):
    page.fill("#seed", "5")
    page.click("text=Start over")
    page.check("#keep")
    page.fill("#seed", "6")
    page.click("text=Start over")

    assert commands(page, run, 2) == [{"do": "seed", "seed": 5, "keep": 0}, {"do": "seed", "seed": 6, "keep": 1}]


def test_freezing_does_not_change_the_verdict_of_an_earlier_trial(page, run):
    trial = {"tick": 1, "cell": 2, "side": 1, "helped": 1, "frozen": 0}
    run.states[0] |= {"trial": trial, "frozen": 1}
    run.send()
    wait_for_text(page, "#why", "It helped, so I remembered it!")

    run.states[0] |= {"trial": {**trial, "frozen": 1}, "frozen": 0}
    run.send()
    wait_for_text(page, "#why", "It helped, but my learning was frozen.")


def test_verdicts_are_those_of_the_terminal(page):
    trials = [
        None,
        *(
            {"tick": 1, "cell": 2, "side": 1, "helped": helped, "frozen": frozen}
            for helped in (None, 0, 1)
            for frozen in (0, 1)
        ),
    ]
    say = '(modules, trials) => trials.map((trial) => modules["core/phrases.ts"].verdict({ trial }))'

    assert page.evaluate(with_modules(say, "core/phrases.ts"), trials) == [phrases.verdict(trial) for trial in trials]


def test_cell_says_whether_it_was_told_or_learned_unless_empty(page, run):
    resize(page, (1920, 1000))
    run.states[0] |= {
        "memory": [0, 1, 2, 0, 0, 0, 0, 0],
        "learned": [-1, 50, 100, 150, -1, -1, -1, -1],
        "by_hand": [0, 1, 0, 1, 0, 0, 0, 0],
        "uses": [0, 4, 7, 322, 0, 0, 0, 0],
    }
    run.send()
    wait_for_text(page, "#cells", "told")

    said = page.locator(".cell-history").all_inner_texts()
    assert said[1:4] == ["told 0:01.0, used 4\u00d7", "learned 0:02.0, used 7\u00d7", ""]


def test_dragged_end_of_an_obstacle_turns_it(page, run):
    drag(page, (2600, 500), (2900, 1200))

    moved = commands(page, run, 1)[-1]
    (ax, ay), (bx, by) = moved["a"], moved["b"]
    assert [bx, by] == [3400, 700]
    assert ((ax - bx) ** 2 + (ay - by) ** 2) ** 0.5 == pytest.approx(824.6, abs=2)
    assert ay > by


def marks(page: Page) -> list[int]:
    """Where marks are drawn above the scrubber, as shares of its length, in percent."""
    return page.evaluate("""() => {
      const { width, height } = octet.marks;
      const { data } = octet.marks.getContext("2d").getImageData(0, height - 1, width, 1);
      const drawn = Array.from({ length: width }, (_, x) => data[4 * x + 3] > 0);
      const begins = drawn.flatMap((isDrawn, x) => (isDrawn && !drawn[x - 1] ? [x] : []));
      return begins.map((x) => Math.round((100 * (x - 8)) / (width - 16)));
    }""")


def test_event_marks_appear_while_the_run_goes_on(page, run):
    run.states[0]["tick"] = 1000
    run.send(events=[[[0, "environment"], [250, "lesson"]]])
    wait_for(page, "octet.tick === 1000 && !octet.stale")
    assert marks(page) == [0, 25]

    run.states[0]["tick"] = 2000
    run.send(events=[[[1500, "eat"]]])
    wait_for(page, "octet.tick === 2000 && !octet.stale")
    assert marks(page) == [0, 12, 75]

    run.send(measures=MEASURES, environment=ENVIRONMENT, events=[[[1000, "eat"]]])
    wait_for(page, "octet.live.message.measures && !octet.stale")
    assert marks(page) == [50]


def test_legend_names_all_that_is_drawn(page):
    assert page.inner_text("#legend-title") == "Legend"
    assert page.get_attribute("#legend", "aria-labelledby") == "legend-title"
    said = page.inner_text("#legend")
    for thing in ("wanders", "is bored", "sensor", "food", "eaten", "obstacle", "looks for food"):
        assert thing in said


def test_printing_keeps_colours_and_whole_cells(page):
    page.emulate_media(media="print")

    assert page.evaluate("getComputedStyle(document.querySelector('.cell')).printColorAdjust") == "exact"
    cut = """() => [...document.querySelectorAll(".cell")]
      .filter((cell) => cell.scrollWidth > cell.clientWidth + 1 || cell.scrollHeight > cell.clientHeight + 1)"""
    assert page.evaluate(cut) == []
    assert not page.locator("#tabs").is_visible()


def test_page_left_open_reports_its_run_ended_and_cannot_join_the_next(watch, open_page):
    first = watch("--seed", "1")
    page = open_page(first.url)
    assert first.end() == 0
    wait_for_text(page, "#status", "The run has ended")
    port = re.search(r":(\d+)/", first.url)

    second = watch("--port", port[1], "--seed", "9")

    assert second.url != first.url
    new = open_page(second.url)
    assert new.evaluate("octet.scene.environment.seed") == 9
    assert page.evaluate("octet.scene.environment.seed") == 1
    wait_for_text(page, "#status", "The run has ended")
