"""Changes of the world and the bodies, as pages show them; a campaign's report; what pages and terminal say alike."""

import itertools

import pytest

from host_sim.lab.campaign.cell import Outcome
from host_sim.lab.campaign.html_report import page
from host_sim.lab.campaign.matrix import groups
from host_sim.protocol.generated import Reason
from host_sim.recording import phrases
from host_sim.report.drawing import MARKS
from tests.runs.support import octet
from tests.web.fake_run import HOME, FakeRun, robot_state
from tests.web.looks import THREE_SIZES, resize, violations_at
from tests.web.sim.node import with_modules
from tests.web.support import full_speed, wait_for, wait_for_text

CHANGES = ("--change", "plant@1s", "--change", "swap-motors@2s", "--change", "grow:900@3s")
GREEN = """() => {
  const [, x, y, radius] = octet.scene.environment.plants[0];
  const { canvas, context, scale } = octet.lane.renderer;
  const at = [x + 0.9 * radius * Math.cos(0.2), y + 0.9 * radius * Math.sin(0.2)].map((mm) => (mm + 40) * scale);
  const [red, green, blue] = context.getImageData(...at, 1, 1).data;
  return green > red && red > blue;
}"""


@pytest.fixture(scope="module")
def surprised(tmp_path_factory):
    """The page of a run in which something happens."""
    out = tmp_path_factory.mktemp("surprised")
    words = ("--bus", "none", "--environments", "1", "--limit-s", "5", "--quiet", "--out", out)
    assert octet("run", *words, *CHANGES).returncode == 0
    return out / "replay.html"


def test_replay_goes_from_change_to_change_and_says_what_happened(surprised, open_page):
    page = open_page(surprised.as_uri())
    page.select_option("#kind", "change")
    assert page.inner_text("#news") == ""

    seen = []
    for _ in range(3):
        page.click("#after")
        wait_for(page, "!octet.stale")
        seen.append(page.inner_text("#news"))

    assert seen[:2] == ["0:01.0 A plant was put down.", "0:02.0 The motor plugs were swapped."]
    assert seen[2].startswith("0:03.0 grow:900@3s could not happen: a plant has a radius of 20 to 500 mm")
    wait_for(page, GREEN)


def test_live_page_shows_changes_when_they_happen(watch, open_page):
    later = ("--change", "plant@61s", "--change", "swap-motors@62s")  # a page may take its time to open
    page = open_page(watch("--environments", "1", "--limit-s", "70", *later).url)
    assert page.inner_text("#news") == ""
    full_speed(page)

    wait_for_text(page, "#news", "The motor plugs were swapped.")
    wait_for(page, GREEN)


def test_page_that_joins_late_is_told_of_the_changes(watch, open_page):
    watched = watch("--environments", "1", "--limit-s", "30", *CHANGES[:4])
    full_speed(open_page(watched.url))
    page = open_page(watched.url)

    wait_for_text(page, "#news", "The motor plugs were swapped.")


SAY = """(modules, lists) => {
  const { lessonSentence, sentence } = modules["core/phrases.ts"];
  return [lists[0].map((state) => sentence(state, false)), lists[1].map((lesson) => lessonSentence(lesson))];
}"""
LEFT, RIGHT = {"left": -9, "right": 9}, {"left": 9, "right": -9}
STATES = [
    robot_state(1, 0, 0, **fields)
    for reason in Reason
    for pattern in range(8)
    for fields in (
        {"reason": reason, "pattern": pattern, **LEFT, "repeat_count": 10},
        {"reason": reason, "pattern": pattern, **LEFT, "by_hand": [0, 0, 0, 0, 1, 1, 1, 1]},
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


def test_sentences_are_those_of_the_terminal(open_page):
    page = open_page(HOME, prepare=FakeRun([robot_state(1, 800, 700)]).serve)

    assert page.evaluate(with_modules(SAY, "core/phrases.ts"), [STATES, LESSONS]) == IN_TERMINAL


def test_reasons_have_colours_names_and_widths(open_page):
    page = open_page(HOME, prepare=FakeRun([robot_state(1, 800, 700)]).serve)

    assert page.evaluate("octet.lane.renderer.palette.reasons.every((colour) => /^#/.test(colour))")
    assert page.locator("#legend [data-reason]").count() == len(Reason) == len(MARKS)
    widths = with_modules('(modules) => modules["draw/trail.ts"].WIDTH_MM.size', "draw/trail.ts")
    assert page.evaluate(widths) == len(Reason)


ENDS = ("", "somebody else stopped node 1: it rests")


def test_axe_finds_nothing_on_the_report_of_a_campaign_and_it_fits(tmp_path, open_page):
    (cells, _) = groups(["article"], ["none", "fd"], ["lockstep"], lambda _: 8.0)
    outcomes = [
        Outcome(cell, seen="12 lost", end=end) for cell, end in zip(cells, itertools.cycle(ENDS), strict=False)
    ]
    outcomes[1].oldest = 9
    report = tmp_path / "campaign.html"
    report.write_text(page(outcomes))

    shown = open_page(report.as_uri(), ready="() => document.readyState === 'complete'")

    assert violations_at(shown) == []
    for size in THREE_SIZES:
        resize(shown, size)
        assert shown.evaluate("document.documentElement.scrollWidth") <= size[0]
