"""The tab with a program for a robot, and the link that holds an experiment."""

import json
import subprocess
from pathlib import Path

import pytest
from playwright.sync_api import Page

from host_sim.base.paths import ROOT
from host_sim.report.octet_page import programs
from host_sim.talk.languages import languages
from tests.runs.support import octet
from tests.web.lab.support import READY, go, settle
from tests.web.looks import violations_at
from tests.web.sim.page_runs import LOGS, experiment
from tests.web.support import wait_for

ARTICLE = programs()["article"]
SHOWN = "octet.programTab.steps.of[0] === octet.programTab.own?.data && !octet.programTab.steps.isAsking"


@pytest.fixture
def tab(page: Page) -> Page:
    page.click("#tab-program")
    return page


def run(page: Page, program: str = "") -> None:
    """Runs a program from its start, and stays there."""
    if program:
        page.fill("#program-text", program)
    page.click("#program-run")
    page.click("#play")
    settle(page)
    go(page, 0)
    page.evaluate("octet.programTab.show()")
    wait_for(page, SHOWN)


def lit(page: Page) -> int:
    return page.evaluate("octet.programTab.editor.lines.lit")


def step(page: Page) -> int:
    before = page.evaluate("[octet.tick, octet.programTab.steps.place]")
    page.click("#program-step")
    wait_for(
        page, f"{SHOWN} && `${{[octet.tick, octet.programTab.steps.place]}}` !== '{before[0]},{before[1] or ''}'"
    )
    settle(page)
    return lit(page)


def test_article_program_diverges_from_octet_where_it_waits_two_seconds(tab):
    run(tab)

    assert tab.inner_text("#program-parting") == "Your robot and Octet diverge at 1:28.3."
    first, second = tab.evaluate("octet.lanes.map(({ data }) => data.statesAt(data.last)[0].memory)")
    assert first == second


def test_article_program_without_its_pause_goes_the_same_way_as_octet(tab):
    run(tab, ARTICLE.replace("delay 2000", ""))

    assert tab.inner_text("#program-parting") == "Your robot and Octet go the same way to the end."


def test_stepping_highlights_one_line_and_shows_its_variables(tab):
    run(tab, "x = 1\nwhile x\nx = x + 1\nrForward x\nwend\n")

    assert [step(tab) for _ in range(6)] == [1, 2, 3, 4, 2, 3]
    assert tab.evaluate("document.querySelectorAll('.editor .lit:not([hidden])').length") == 1
    assert tab.inner_text("#program-variables").split() == ["x", "3"]


def test_next_decision_goes_to_the_next_command(tab):
    run(tab, "rForward 10\nrTurn 30\nrForward 10")

    tab.click("#program-decision")
    wait_for(tab, f"{SHOWN} && octet.tick > 0")
    settle(tab)

    assert lit(tab) == 2


def test_program_error_is_reported_and_marked_at_its_line(tab):
    run(tab, "x = 1\n  rTrun 5\n")

    assert tab.inner_text("#program-news") == (
        "Line 2: “rTrun”: expected a command, a label, or a variable with = after it."
    )
    assert tab.evaluate("octet.programTab.editor.lines") == {"lit": 0, "wrong": 2}


def test_endless_loop_is_stopped_and_reported(tab):
    run(tab, "while true\nwend")

    assert tab.inner_text("#program-news").startswith(
        "Line 1: “while”: expected rForward, rTurn or delay in the loop"
    )


def test_ended_program_and_its_output_are_reported(tab):
    run(tab, 'xyString 1,1,"Grüße"')

    assert tab.inner_text("#program-news") == "The program has ended: the robot rests. It shows: Grüße"


def test_edited_program_pauses_and_asks_to_be_run_again(tab):
    run(tab)
    tab.locator("#program-text").press_sequentially("x")

    assert tab.inner_text("#program-news") == "Run it to see what it does now."
    assert tab.evaluate("octet.playing") is False


def test_digits_and_brackets_are_typed_into_the_program_with_two_robots(page):
    page.evaluate("octet.begin({ ...octet.lane.experiment, robots: Array(2).fill(octet.lane.setup) })")
    settle(page)
    page.click("#tab-program")
    page.fill("#program-text", "")
    page.locator("#program-text").press_sequentially("x[1] = 2")

    assert page.input_value("#program-text") == "x[1] = 2"


def test_example_programs_can_be_chosen(tab):
    for name, text in programs().items():
        tab.select_option("#program-choice", name)
        assert tab.input_value("#program-text") == text


def test_chosen_behaviour_replaces_the_program(tab):
    run(tab)
    tab.click("#tab-run")
    tab.select_option("#behaviour", "never")
    settle(tab)

    assert tab.inner_text("figure:nth-child(2) figcaption") == "copy: never, seed 1"


def test_program_in_the_page_sends_the_frames_of_the_command_line(page, tmp_path):
    wanted = experiment("article", seed=6)
    wanted["robots"] = [{**wanted["robots"][0], "program": ARTICLE}]
    options = ("--seed", "6", "--environments", "2", "--limit-s", "20", "--bus", "none", "--out", tmp_path)
    octet("run", "--profile", ROOT / "host_sim/program/examples/article.bas", *options)

    (log,) = page.evaluate(LOGS, [wanted])

    assert without_boot(log) == without_boot((tmp_path / "run.log").read_text())


def without_boot(log: str) -> list[str]:
    """The frames of senses and drives."""
    return [line for line in log.splitlines() if " 101#" in line or " 041#" in line]


def test_link_restores_the_experiment(tab, open_page):
    run(tab, "rForward 10\nrTurn 90 // größer & mehr\n")
    tab.click("#program-link")
    address = tab.evaluate("location.href")

    again = open_page(address, ready=READY)
    settle(again)

    assert again.input_value("#program-text") == "rForward 10\nrTurn 90 // größer & mehr\n"
    assert again.evaluate("octet.lanes.map(({ experiment }) => experiment)") == tab.evaluate(
        "octet.lanes.map(({ experiment }) => experiment)"
    )


def test_link_holds_parameters_changes_robots_time_and_lesson(open_page, file):
    page = open_page(file.as_uri() + "#share", ready=READY)
    page.click("#begin-lesson")
    settle(page)
    page.evaluate("octet.lane.setUp({ seed: 77, settings: { turn_deg: 20 } })")
    page.evaluate("octet.change({ do: 'plant', at: [1200, 900], radius: 120 })")
    page.evaluate("octet.change({ do: 'write', robot: 1, cell: 3, side: 2 })")
    settle(page)
    page.evaluate("octet.seek(371)")
    page.click("#copy-link")

    again = open_page(page.evaluate("location.href"), ready=READY)
    settle(again)
    wait_for(again, "octet.tick === 371")

    assert again.evaluate("octet.lane.experiment") == page.evaluate("octet.lane.experiment")
    assert len(again.evaluate("octet.lane.experiment.changes")) == 2
    assert again.evaluate("[octet.course.plan.id, octet.course.begun]") == ["share", True]
    assert "Loaded" not in again.inner_text("#program-news")


def test_zbar_reads_the_link_from_its_qr_code(page, tmp_path):
    page.evaluate("octet.seek(371)")
    page.click("#show-link-code")
    page.locator("#link-code canvas").screenshot(path=tmp_path / "code.png")
    command = ("zbarimg", "--quiet", "--raw", tmp_path / "code.png")
    read = subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()

    assert page.inner_text("#link-code") == "Only this computer can open this address."
    page.keyboard.press("Escape")
    assert not page.is_visible("#link-code")
    page.click("#copy-link")
    assert read == page.evaluate("location.href")
    assert "tick=371" in read


def test_link_too_long_for_a_qr_code_is_reported(page):
    page.evaluate("octet.lane.setUp({ program: 'rem ' + 'x'.repeat(4000) })")
    page.click("#show-link-code")

    assert page.inner_text("#link-code") == "This address is too long for a QR code: copy the link instead."
    assert not page.is_visible("#link-code canvas")


FOUND = (
    "#v=1&seed=7&environments=2&world=posts&behaviour=never&memory=0.1.0.0.2.0.0.0&language=de&program=@one_rule&end"
)


def test_link_sets_seed_world_behaviour_memory_program_and_language(open_page, file):
    page = open_page(file.as_uri() + FOUND, ready=READY)
    settle(page)
    first, second = page.evaluate("octet.lanes.map(({ experiment }) => experiment)")

    assert (first["seed"], first["environments"], first["world"]) == (7, 2, "posts")
    assert first["robots"][0]["profile"] == "never"
    assert first["robots"][0]["memory"] == [0, 1, 0, 0, 2, 0, 0, 0]
    assert second["robots"][0]["program"] == programs()["one_rule"]
    assert page.inner_text("#program-run") == languages()["de"]["program"]["run"]


@pytest.mark.parametrize(
    ("link", "told"),
    [
        (
            FOUND[: FOUND.index("_rule")],
            "This link is incomplete. Loaded from it: seed, environments, world, behaviour, memory",
        ),
        (
            FOUND.replace("v=1", "v=2"),
            "This link is from another version of the page. Loaded from it: seed, environments",
        ),
        ("#v=1&seed=x&world=moon&seed2=3&end", "Not loaded: seed, world, seed2."),
        ("#v=1&program=%E2%8&environments=3&end", "Loaded from it: environments. Not loaded: program."),
        ("#v=1&memory=1.2.3&end", "Not loaded: memory."),
        (
            "#v=1&settings=turn_deg:0,x:1&changes=[{}]&setups=[{}]&lesson=dance&end",
            "parameters, changes, the robots'",
        ),
        ('#v=1&changes=[{"do":"lift","tick":1,"x":1}]&end', "Not loaded: changes."),
        ('#v=1&changes=[{"do":"lift","tick":2},{"do":"lift","tick":1}]&end', "Not loaded: changes."),
    ],
)
def test_faulty_link_is_reported_with_what_was_loaded_and_what_not(link, told, open_page, file):
    page = open_page(file.as_uri() + link.replace("&language=de", ""), ready=READY)
    settle(page)
    page.click("#tab-program")

    assert told in page.inner_text("#program-news")


def test_link_cannot_name_an_inherited_property_as_its_program(open_page, file):
    page = open_page(f"{file.as_uri()}#v=1&program=@constructor&end", ready=READY)
    page.click("#tab-program")

    assert "Not loaded: program." in page.inner_text("#program-news")


def test_link_pasted_into_the_address_of_the_open_page_is_followed(page, file):
    with page.expect_event("load"):
        page.goto(f"{file.as_uri()}#v=1&seed=7&end")

    wait_for(page, "window.octet?.lane.experiment.seed === 7")


def test_message_about_a_link_follows_the_chosen_language(open_page, file):
    page = open_page(f"{file.as_uri()}#v=1&seed=x&end", ready=READY)
    page.click("#tab-program")
    page.select_option("#language", "de")

    assert "Nicht übernommen: Startzahl." in page.inner_text("#program-news")


def test_axe_finds_nothing_on_the_program_tab(tab):
    run(tab, "x = 1\nrTrun 5")

    assert violations_at(tab) == []


def test_english_and_german_have_the_same_program_texts():
    english, german = (languages()[code]["program"] for code in ("en", "de"))
    expected = Path(ROOT / "host_sim/program/native/program.h").read_text().partition("EXPECTED_NOTHING,")[2]

    assert {key: type(value) for key, value in english.items()} == {key: type(value) for key, value in german.items()}
    assert english["names"].keys() == german["names"].keys() == programs().keys()
    assert len(german["expected"]) == expected.partition("EXPECTED_COUNT")[0].count("EXPECTED_") + 1
    assert json.dumps(german) != json.dumps(english)
