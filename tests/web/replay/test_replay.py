"""The page that a run leaves: one file, opened without a server, with all that the robot knew."""

import json
import shlex
from collections.abc import Callable
from pathlib import Path

import pytest
from playwright.sync_api import Page

from host_sim.recording import run_recorder as run_recorder_module
from host_sim.recording.run_recorder import RunRecorder
from host_sim.report.replay_page import run_data
from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig
from tests.runs.support import octet_process
from tests.web.sim.node import in_node
from tests.web.support import next_frame, wait_for, wait_for_text


@pytest.fixture
def page(recorded: Path, open_page: Callable[..., Page]) -> Page:
    return open_page(recorded.as_uri())


def tick(page: Page) -> int:
    return page.evaluate("octet.tick")


def test_replay_plays_and_pauses(page):
    page.select_option("#speed", "16")
    page.click("#play")
    wait_for(page, "octet.tick > 100")
    page.click("#play")
    now = tick(page)
    next_frame(page)
    assert tick(page) == now


def test_scrubbing_shows_the_state_that_playing_reaches(page):
    middle = page.evaluate("Math.floor(octet.last / 2)")
    page.locator("#scrub").fill(str(middle))
    assert tick(page) == middle
    scrubbed = page.evaluate("[octet.scene.state, octet.scene.trail.length]")
    page.evaluate("octet.go(0)")
    page.evaluate("tick => { for (let t = 0; t <= tick; t += 7) octet.go(t); octet.go(tick) }", middle)
    assert page.evaluate("octet.scene.state") == scrubbed[0]


@pytest.mark.parametrize("kind", ["trial", "lesson", "eat", "environment"])
def test_buttons_jump_to_the_next_event_and_back(page, kind):
    page.select_option("#kind", kind)
    page.evaluate("octet.go(10)")
    page.click("#after")
    at = tick(page)
    assert [at, kind] in page.evaluate("octet.lane.data.robots[0].run.events")
    assert at > 10
    page.evaluate("tick => octet.go(tick + 1)", at)
    page.click("#before")
    assert tick(page) == at


def test_pin_button_compares_the_memory_at_two_times(page):
    page.click("#pin")
    page.evaluate("octet.go(octet.last)")
    wait_for(page, "document.querySelectorAll('.cell.changed').length > 0")
    assert "then: empty" in page.inner_text("#cells .changed >> nth=0")
    page.click("#pin")
    wait_for(page, "document.querySelectorAll('.cell.changed').length === 0")


def test_keyboard_alone_controls_the_replay(page):
    page.select_option("#kind", "trial")
    page.focus("#scrub")
    page.keyboard.press("ArrowRight")
    page.keyboard.press("Shift+ArrowRight")
    assert tick(page) == 51
    page.keyboard.press("End")
    assert tick(page) == page.evaluate("octet.last")
    page.keyboard.press("Home")
    page.keyboard.press("n")
    assert page.evaluate("octet.scene.state.reason") == 5
    page.keyboard.press("Space")
    wait_for(page, "octet.playing")


def say(page: Page, sentence: str, who: str = "robot") -> str:
    """What is answered to a sentence."""
    page.click("#tab-talk")
    page.select_option("#talk-who", who)
    page.fill("#talk-line", sentence)
    page.press("#talk-line", "Enter")
    next_frame(page)
    return page.inner_text("#talk-said > li:last-child > p:last-child")


def test_robot_answers_from_the_log_and_its_cells_are_highlighted(page):
    page.evaluate("octet.go(octet.last)")

    assert say(page, "What have you learned?").startswith("[log]")

    learned = page.evaluate("octet.scene.state.memory.flatMap((side, cell) => (side ? [cell] : []))")
    lit = "[...document.querySelectorAll('.cell')].flatMap((it, i) => (it.classList.contains('meant') ? [i] : []))"
    assert page.evaluate(lit) == learned != []
    assert say(page, "Do you love me?").startswith("[words]")
    assert page.evaluate(lit) == []


def test_time_in_an_answer_shows_its_tick_and_marks_the_place(page):
    page.evaluate("octet.go(octet.last)")
    say(page, "When was your last meal?")
    at = page.evaluate("octet.talk.history.at(-1).said.ticks.at(-1)")
    place = page.evaluate("octet.scene.meant.places.at(-1)")

    page.click("#talk-said > li:last-child button >> nth=-1")

    assert tick(page) == at
    assert [page.evaluate("octet.scene.state.x"), page.evaluate("octet.scene.state.y")] == place
    assert len(page.evaluate("octet.scene.meant.food")) == 3


def test_keys_typed_into_the_talk_line_do_not_control_the_page(page):
    page.click("#tab-talk")
    page.click("#talk-line")
    page.keyboard.type("n w p end")

    assert tick(page) == 0
    assert page.input_value("#talk-line") == "n w p end"


def test_eliza_answers_in_german_and_the_robot_answers_any_text(page):
    assert say(page, "Ich bin traurig.", "eliza-de") == "[words] ES TUT MIR LEID , DASS DU TRAURIG BIST"
    assert say(page, "\u0007 <b>\U0001f600 my \U0001f600", "robot").startswith("[words]")
    assert page.locator("#talk-said b").count() == 0


def test_copied_debugger_command_stops_at_the_shown_tick(recorded, page):
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    page.evaluate("octet.go(octet.last)")
    page.click("#tab-listing")
    page.click("#copy-debugger")
    wait_for_text(page, "#note", "The command is copied")

    command = page.evaluate("navigator.clipboard.readText()")

    at, memory = page.evaluate("[octet.tick, octet.scene.state.memory]")
    assert (
        command
        == f"tools/octet debug {recorded.parent / 'run.log'} --node 1 --tick {at}"
        == page.inner_text("#debugger")
    )
    words = shlex.split(command.removeprefix("tools/octet"))
    shown = octet_process(*words, "--ex", "cells").stdout
    assert f"tick {at}," in shown
    assert shown.endswith("{" + ", ".join(map(str, memory)) + "}\n")


STATES = """
const data = await modules["core/run_data.ts"].RunData.from(JSON.parse(texts[0]));
const states = [];
for (let tick = data.first; tick <= data.last; tick += 7) states.push(...data.statesAt(tick));
return states;
"""


def test_states_of_the_retained_ticks_are_those_of_the_run(tmp_path, monkeypatch):
    monkeypatch.setattr(run_recorder_module, "TICKS_MAX", 1000)
    with make(RunConfig(seed=5, environments=30, limit_s=4.0)) as simulation:
        trajectory = RunRecorder.of(simulation, boredom_limit=10).trajectory
        for _ in simulation.run():
            pass
    file = tmp_path / "run.json"
    file.write_text(json.dumps(run_data(trajectory, "a long run")))

    states = in_node(tmp_path, "core/run_data.ts", STATES, file)

    assert sum(cell.uses for cell in trajectory.tracks[0].cells[:8]) > 0
    assert states == [trajectory.at(tick) for tick in range(trajectory.first_tick, trajectory.ticks, 7)]
