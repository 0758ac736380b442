"""A person watches a run and interacts with it."""

import math
import re
from collections.abc import Callable

import pytest
from playwright.sync_api import Page

from host_sim.lab.bench.page_figures import TIME_DRAWING
from host_sim.protocol.generated import Opcode
from tests.runs.support import octet
from tests.web.support import (
    Watched,
    drag,
    full_speed,
    pause,
    place_on_page,
    run_in,
    state,
    wait_for,
    wait_for_text,
)

BEGIN = "[{ do: 'speed', factor: 1 }, { do: 'seed', seed: 3, keep: 0 }, { do: 'play' }]"


@pytest.fixture
def page(module_watch: Watched, open_page: Callable[..., Page]) -> Page:
    """A page of a run that all these tests share: it has just been started over."""
    page = open_page(module_watch.url)
    wait_for(page, "octet.scene.state.tick > octet.scene.environment.start_tick")
    start_tick = page.evaluate("octet.scene.environment.start_tick")
    page.evaluate(f"{BEGIN}.forEach((command) => octet.send(command))")
    wait_for(page, "before => octet.scene.environment.start_tick > before && octet.play.playing", start_tick)
    return page


def test_page_shows_behaviour_and_parameters_of_the_run(watch, open_page):
    page = open_page(watch("--profile", "adaptive", "--set", "turn_deg=20").url)
    wait_for(page, "octet.live")

    assert page.input_value("#behaviour") == "adaptive"
    page.click("#tab-parameters")
    assert page.input_value(".slider input[title=turn_deg]") == "20"


def test_page_shows_the_run_as_it_goes_on(page):
    first = state(page)["tick"]
    wait_for(page, "tick => octet.scene.state.tick > tick + 25", first)
    assert page.inner_text("#fact-environment") == "1 of 5"
    assert page.inner_text("#fact-food") == "3 of 3"
    assert len(page.inner_text("#doing")) > 10


def test_page_shows_the_pin_readings_of_a_robot_on_its_pins(page):
    assert not page.is_visible("#pins")
    draw = "octet.showLive({ ...octet.live.message, pins: [{ volts: 7.4, counts: [5, 6], duty: [30, -31] }] })"
    read = "(({ innerText, clientWidth }) => [innerText, clientWidth > 0])(document.getElementById('pins'))"
    assert page.evaluate(f"{draw}, {read}") == ["7.4 V, encoders 5, 6, duty 30, -31 %", True]


def test_drawing_of_frames_can_be_timed(page):
    page.evaluate(TIME_DRAWING)
    wait_for(page, "octet.times.length > 2")


def test_token_leaves_the_address_and_a_reload_needs_none(page):
    assert "token" not in page.url
    assert page.evaluate("document.cookie") == ""
    page.reload()
    wait_for(page, "window.octet?.scene && octet.scene.state.tick > octet.scene.environment.start_tick")


def test_page_pauses_and_plays_again(page):
    pause(page)
    tick = state(page)["tick"]
    page.click("#freeze")
    wait_for(page, "octet.scene.state.frozen === 1")
    assert state(page)["tick"] == tick
    page.click("#play")
    wait_for(page, "tick => octet.scene.state.tick > tick", tick)


def test_single_decision_plays_more_than_a_step(page):
    pause(page)
    full_speed(page)
    before = state(page)
    page.click("#after")
    wait_for(page, "tick => octet.scene.state.tick > tick && !octet.play.playing", before["tick"])
    assert not {before["reason"], state(page)["reason"]} <= {1, 3}


def test_next_environment_and_new_seed_are_started_from_the_page(watch, open_page):
    watched = watch("--seed", "5")
    page = open_page(watched.url)
    page.select_option("#kind", "environment")
    page.click("#after")
    wait_for(page, "octet.scene.environment.number === 2")
    page.fill("#seed", "77")
    page.click("text=Start over")
    wait_for(page, "octet.scene.environment.seed === 77 && octet.scene.environment.number === 1")
    assert watched.end() == 0
    begun = [(entry["seed"], entry["number"]) for entry in watched.params()["environments"]]
    assert begun == [(5, 1), (5, 2), (77, 1)]


def test_cell_erase_and_freeze_buttons_send_commands_on_the_bus(watch, open_page):
    watched = watch()
    page = open_page(watched.url)
    pause(page)
    page.click("#cells li:nth-child(8) button")
    wait_for(page, "octet.scene.state.memory[7] === 1")
    wait_for_text(page, "#cells li:nth-child(8)", "left")
    page.click("#erase")
    wait_for(page, "octet.scene.state.memory.every(side => side === 0)")
    page.click("#freeze")
    wait_for(page, "octet.scene.state.frozen === 1")
    assert watched.end() == 0
    names = ("opcode", "half", "mask", "byte_3", "freeze")
    write, erase, freeze = [{name: c[name] for name in names if name in c} for c in watched.commands()][-4:-1]
    assert write == {"opcode": Opcode.WRITE, "half": 1, "mask": 8, "byte_3": 1}
    assert erase == {"opcode": Opcode.ERASE}
    assert freeze == {"opcode": Opcode.FREEZE, "freeze": 1}


def test_obstacle_dragged_into_its_way_makes_an_erased_robot_learn(watch, open_page):
    watched = watch("--seed", "1")
    page = open_page(watched.url)
    pause(page)
    page.click("#erase")
    wait_for(page, "octet.scene.state.memory.every(side => side === 0)")
    now, bar = state(page), page.evaluate("octet.scene.environment.bars[0]")
    middle = ((bar[1] + bar[3]) / 2, (bar[2] + bar[4]) / 2)
    heading = now["heading"] / 1000
    ahead = (now["x"] + 330 * math.cos(heading), now["y"] + 330 * math.sin(heading))
    drag(page, middle, (min(3700, max(300, ahead[0])), min(2700, max(300, ahead[1]))))
    wait_for(page, "old => octet.scene.environment.bars[0][1] !== old", bar[1])
    full_speed(page)
    page.click("#play")
    wait_for(page, "octet.scene.state.memory.some(side => side > 0)")
    wait_for_text(page, "#lessons", "Learned:")
    assert watched.end() == 0
    assert {edit["do"] for edit in watched.params()["edits"]} == {"move_bar"}


def test_dragged_robot_is_picked_up_and_put_down_elsewhere(watch, open_page):
    watched = watch("--seed", "1")
    page = open_page(watched.url)
    pause(page)
    now = state(page)
    food = page.evaluate("octet.scene.environment.food[1]")
    drag(page, (now["x"], now["y"]), (food[0] - 180, food[1]))
    wait_for(page, "x => octet.scene.state.x !== x && !octet.scene.state.lifted", now["x"])
    assert abs(state(page)["x"] - (food[0] - 180)) < 20
    assert watched.end() == 0
    assert [edit["do"] for edit in watched.params()["edits"]] == ["lift", "put"]


def test_food_is_dragged_elsewhere(page):
    pause(page)
    drag(page, page.evaluate("octet.scene.environment.food[0]"), (300, 2700))
    wait_for(page, "octet.scene.environment.food[0][1] > 2680")


def test_run_changed_by_a_person_replays(watch, open_page):
    watched = watch("--seed", "4")
    page = open_page(watched.url)
    page.select_option("#kind", "environment")
    cell = "#cells li:nth-child(3) button"
    for control in ("#lift", "#add-bar", cell, "#freeze", "#lift", "#after", "#erase", "#add-plant", "#break"):
        tick = state(page)["tick"]
        page.click(control)
        wait_for(page, "tick => octet.scene.state.tick > tick", tick)
    page.fill("#seed", "8")
    page.press("#seed", "Enter")
    wait_for(page, "octet.scene.environment.seed === 8 && octet.scene.trail.length > 5")
    assert watched.end() == 0
    assert re.findall(r"^environment (\d+)", watched.process.stdout.read(), re.MULTILINE) == ["1", "2", "1"]
    log, again = watched.out / "run.log", watched.out / "again.html"
    assert octet("replay", log).returncode == 0
    assert octet("replay", log, "--html", again).returncode == 0
    assert run_in(again) == run_in(watched.out / "replay.html")


def test_lifted_robot_senses_nothing(page):
    page.click("#lift")
    wait_for(page, "octet.scene.state.lifted === 1 && octet.scene.state.feel === 0 && octet.scene.state.beacon === 0")
    wait_for_text(page, "#doing", "picked me up")


def test_impossible_drag_is_reported(page):
    pause(page)
    now, bar = state(page), page.evaluate("octet.scene.environment.bars[0]")
    drag(page, ((bar[1] + bar[3]) / 2, (bar[2] + bar[4]) / 2), (now["x"], now["y"]))
    wait_for_text(page, "#note", "the robot stands there")


def test_reloaded_page_continues_at_the_current_tick(page):
    wait_for(page, "octet.scene.state.tick > octet.scene.environment.start_tick + 20")
    tick = state(page)["tick"]
    page.reload()
    wait_for(page, "tick => window.octet?.scene?.state?.tick >= tick && octet.scene.trail.length > 5", tick)


def test_two_pages_see_the_same_run(page, module_watch, open_page):
    other = open_page(module_watch.url)
    pause(page)
    wait_for(other, "!octet.play.playing")
    tick = state(page)["tick"]
    wait_for(other, "tick => octet.scene.state.tick === tick", tick)
    assert state(page) == state(other)


def test_closed_page_does_not_stop_the_run(page, module_watch, open_page):
    other = open_page(module_watch.url)
    page.close()
    tick = state(other)["tick"]
    wait_for(other, "tick => octet.scene.state.tick > tick + 10", tick)


def test_keyboard_alone_controls_the_live_page(page):
    page.keyboard.press("Space")
    wait_for(page, "!octet.play.playing")
    page.evaluate("octet.send({ do: 'speed', factor: 0 })")
    action = state(page)["action"]
    page.keyboard.press("n")
    wait_for(page, "action => octet.scene.state.action !== action && !octet.play.playing", action)
    tools = ("what-if", "lift", "add-bar", "add-plant", "zoom-in", "follow", "to-legend")
    for element in (*tools, "copy-link", "show-link-code", "language", ""):
        page.keyboard.press("Tab")
        assert page.evaluate("document.activeElement.id") == element
    assert page.evaluate("document.activeElement === octet.lane.canvas")
    for _ in range(5):
        page.keyboard.press("e")
    bar = page.evaluate("octet.scene.environment.bars[0]")
    page.keyboard.press("r")
    wait_for(page, "old => String(octet.scene.environment.bars[0]) !== old", ",".join(map(str, bar)))
    page.keyboard.press("Delete")
    wait_for(page, "octet.scene.environment.bars.length === 5")
    page.keyboard.press("a")
    wait_for(page, "octet.scene.environment.bars.length === 6")
    page.select_option("#kind", "environment")
    page.locator("#after").focus()
    page.keyboard.press("n")
    wait_for(page, "octet.scene.environment.number === 2")


def test_tab_key_reaches_the_controls(page):
    pause(page)
    reached = set()
    for _ in range(60):
        page.keyboard.press("Tab")
        reached.add(page.evaluate("document.activeElement.id"))
    assert {"play", "scrub", "speed", "lift", "add-bar", "after", "seed", "freeze", "erase"} <= reached


def test_status_reports_the_end_of_the_run(watch, open_page):
    watched = watch("--environments", "1")
    page = open_page(watched.url)
    full_speed(page)
    wait_for(page, "octet.play.done")
    wait_for_text(page, "#status", "all done")
    assert watched.end() == 0
    wait_for_text(page, "#status", "The run has ended")


def test_click_at_the_robots_position_selects_it(page):
    pause(page)
    now = state(page)
    page.mouse.click(*place_on_page(page, now["x"], now["y"]))
    assert page.evaluate("octet.scene.item.kind") == "robot"


def test_robot_answers_while_it_runs(page):
    page.click("#tab-talk")
    page.fill("#talk-line", "Where are you?")
    page.press("#talk-line", "Enter")

    wait_for_text(page, "#talk-said", "FROM THE LEFT WALL")
    wait_for(page, "octet.scene.meant.places.length === 1")
    page.select_option("#talk-who", "eliza-de")
    page.fill("#talk-line", "Ich bin traurig.")
    page.press("#talk-line", "Enter")
    wait_for_text(page, "#talk-said", "[words] ES TUT MIR LEID , DASS DU TRAURIG BIST")
    assert page.evaluate("octet.scene.meant") is None
