"""What is changed in octet.html makes another future beside the first, and the host replays it."""

import json

import pytest
from playwright.sync_api import Page

from tests.runs.support import octet
from tests.web.lab.support import saved, settle, simulated
from tests.web.support import run_in, wait_for, wait_for_text

TRAIL = "(({ x, y, length }) => [[...x].slice(0, length), [...y].slice(0, length)])(octet.scene.trail)"


@pytest.fixture
def page(page: Page) -> Page:
    """A run of one environment."""
    page.fill("#environments", "1")
    page.click("#new-run button")
    wait_for(page, "octet.lane.data && octet.lane.experiment.environments === 1")
    simulated(page)
    return page


def test_changed_cell_makes_another_future_beside_the_first(page):
    page.evaluate("octet.go(2200)")
    page.click("#what-if")
    page.click("#cells li:nth-child(2) button")
    simulated(page)

    wait_for_text(page, "#parting", "They diverge at 0:50.5 (tick 2523)")
    assert "Their memories differ: front-right." in page.inner_text("#parting")
    assert page.evaluate("octet.lanes.map((lane) => lane.experiment.changes.length)") == [0, 1]
    same = "octet.lanes.map((lane) => [...lane.data.robots[0].columns.x.slice(0, 2523)].join())"
    one, other = page.evaluate(same)
    assert one == other


def test_cell_shows_its_turn_when_pressed_and_the_next_when_pressed_again(page):
    cell = "#cells li:nth-child(5)"

    page.click(f"{cell} button")
    wait_for_text(page, f"{cell} .cell-side", "left")
    page.click(f"{cell} button")

    wait_for_text(page, f"{cell} .cell-side", "right")


def test_cell_pressed_twice_before_it_is_drawn_takes_the_second_turn(page):
    page.evaluate("octet.simulator.run = () => {}")  # as on a slow machine

    page.dblclick("#cells li:nth-child(5) button")

    assert page.evaluate("octet.lane.experiment.changes.map((change) => change.side)") == [1, 2]


def test_change_is_made_at_the_shown_tick_even_if_not_yet_simulated(page):
    page.evaluate("octet.go(2200)")
    page.evaluate("octet.simulator.run = () => {}")  # as on a slow machine
    page.click("#what-if")
    page.click("#cells li:nth-child(2) button")

    assert page.evaluate("octet.lane.experiment.changes.map((change) => change.tick)") == [2201]
    assert page.evaluate("octet.tick") == 2201


@pytest.mark.parametrize("change", ["behaviour", "parameter", "obstacle", "seed"])
def test_changed_behaviour_parameter_obstacle_or_seed_makes_another_future(page, change):
    page.evaluate("octet.go(1000)")
    page.click("#what-if")
    if change == "behaviour":
        page.select_option("#behaviour", "searcher")
    elif change == "parameter":
        page.click("#tab-parameters")
        page.locator(".slider input").first.fill("90")
        page.locator(".slider input").first.dispatch_event("change")
    elif change == "obstacle":
        page.click("#add-plant")
    else:
        page.fill("#robot-seed", "77")
        page.locator("#robot-seed").blur()
    simulated(page)

    wait_for_text(page, "#parting", "They diverge at")


def test_run_with_another_seed_shows_only_its_own_trail(page):
    page.evaluate("octet.go(600)")
    old = page.evaluate(TRAIL)

    page.fill("#robot-seed", "77")
    page.locator("#robot-seed").blur()
    simulated(page)

    assert page.evaluate("octet.tick") == 600
    trail = page.evaluate(TRAIL)
    assert trail != old
    assert trail == page.evaluate(f"(octet.go(0), octet.go(600), {TRAIL})")


def test_changes_made_on_the_page_are_replayed_by_the_host(page, tmp_path):
    page.evaluate("octet.go(400)")
    page.click("#add-plant")
    simulated(page)
    page.click("#grow")
    page.click("#lift")
    simulated(page)
    page.click("#lift")
    page.evaluate("octet.go(700)")
    page.click("#cells li:nth-child(3) button")
    page.click("#freeze")
    page.select_option("#behaviour", "adaptive")
    simulated(page)
    (tmp_path / "run.log").write_bytes(saved(page, "#save-log"))
    (tmp_path / "run.world.json").write_bytes(saved(page, "#save-world"))

    assert "no difference" in octet("replay", tmp_path / "run.log").stdout
    done = octet("replay", tmp_path / "run.log", "--html", tmp_path / "replay.html")
    assert (done.returncode, done.stderr) == (0, "")
    edits = json.loads((tmp_path / "run.world.json").read_text())["edits"]
    assert [edit["do"] for edit in edits] == ["plant", "grow_plant", "lift", "put"]


def test_impossible_change_is_reported_and_dropped(page):
    page.evaluate("octet.go(300)")
    page.evaluate(
        "(() => { const { x, y } = octet.scene.state; const at = [Math.round(x), Math.round(y)];"
        " octet.change({ do: 'add_bar', a: at, b: [at[0] + 300, at[1]] }); })()"
    )

    wait_for_text(page, "#note", "the robot stands there")
    wait_for(page, "octet.lane.experiment.changes.length === 0")


def test_undo_takes_back_the_newest_change_even_if_an_older_one_is_later(page):
    page.evaluate("octet.go(700)")
    page.click("#cells li:nth-child(3) button")
    page.evaluate("octet.go(400)")
    page.click("#freeze")
    page.click("#what-if")

    page.click("#undo")
    assert page.evaluate("octet.lane.experiment.changes.map((change) => change.do)") == ["write"]
    page.click("#undo")
    assert page.evaluate("octet.lane.experiment.changes.length") == 0
    assert page.evaluate("octet.lanes[0].experiment.changes.length") == 2


def test_list_of_lessons_is_that_of_the_selected_run(page):
    lists = []
    page.click("#what-if")
    for lane in (1, 0):
        page.evaluate("lane => { octet.go(10); octet.select(octet.lanes[lane]); }", lane)
        page.click(f"#cells li:nth-child({lane + 2}) button")
        settle(page)
        lists.append(page.inner_text("#lessons"))

    assert lists[0].partition(":")[2] != lists[1].partition(":")[2]
    page.evaluate("octet.select(octet.lanes[1])")
    settle(page)
    assert page.inner_text("#lessons") == lists[0]


def test_boredom_is_shown_with_the_limit_at_the_shown_tick(page):
    page.evaluate("octet.go(400)")
    page.evaluate("octet.change({ do: 'set', robot: 0, parameter: 'boredom_limit', value: 20 })")
    settle(page)
    assert page.inner_text("#boredom-count") == "0 of 20"

    page.evaluate("octet.go(300)")
    settle(page)
    assert page.inner_text("#boredom-count").endswith(" of 10")


def test_impossible_run_is_reported_and_not_simulated(page):
    page.evaluate(
        "() => { const world = { name: 'tight', size: [600, 600], food: [[300, 300]], bars: [] };"
        " octet.begin({ ...octet.lane.experiment, world, robots: Array(4).fill(octet.lane.setup) });"
        " octet.showStatus(); }"
    )

    wait_for_text(page, "#note", "there is room for")
    assert page.inner_text("#status") == "the real firmware, in this page"


def test_results_table_shows_the_behaviour_at_the_shown_tick(page):
    page.evaluate("octet.go(400)")
    page.select_option("#behaviour", "never")
    page.click("#tab-curves")
    settle(page)
    assert page.inner_text("#results tr td:nth-child(3)") == "never"

    page.evaluate("octet.go(300)")
    settle(page)
    assert page.inner_text("#results tr td:nth-child(3)") == "article"


def test_remove_button_needs_a_selection_in_the_selected_run(page):
    page.evaluate("octet.editor.select({ kind: 'bar', id: 0, part: 'whole' })")
    settle(page)
    assert page.is_enabled("#remove-bar")

    page.click("#what-if")
    settle(page)

    assert page.is_disabled("#remove-bar")


def test_closed_run_is_no_longer_simulated(page):
    waiting = page.evaluate(
        "(() => { octet.whatIf(), octet.whatIf(), octet.begin(octet.lane.experiment);"
        " return [...octet.simulator.queued.keys()].map((lane) => lane === octet.lane); })()"
    )

    assert waiting == [True]


PICTURES = """() => [...document.querySelectorAll("#worlds canvas")].map((canvas) => canvas.toDataURL())"""
DRAWN = "octet.desk.pictures.pictures.every(({ drawn }) => drawn)"


def test_world_pictures_show_the_seed_and_choose_the_world(page):
    simulated(page)
    wait_for(page, DRAWN)
    pictures = page.evaluate(PICTURES)
    assert len(set(pictures)) == len(pictures) == 6

    page.fill("#seed", "8")
    page.focus("#worlds input:checked")
    simulated(page)
    wait_for(page, DRAWN)
    assert not set(page.evaluate(PICTURES)) & set(pictures)

    page.keyboard.press("ArrowRight")
    page.keyboard.press("Enter")
    wait_for(page, "octet.lane.experiment.seed === 8 && octet.lane.experiment.world === 'corridors'")


def test_run_with_plants_and_a_broken_body_is_replayed_from_its_files(page, tmp_path):
    page.check("#worlds [value=posts]")
    page.click("#new-run button")
    wait_for(page, "octet.lane.data")
    page.evaluate("octet.go(150)")
    page.click("#add-plant")
    simulated(page)
    wait_for(page, "octet.scene.item?.kind === 'plant'")
    page.click("#grow")
    simulated(page)
    page.evaluate("octet.go(300)")
    page.evaluate("octet.editor.nudge({ x: 50, y: 50 })")
    page.select_option("#fault", "stuck-off:front")
    page.click("#break")
    simulated(page)
    wait_for_text(page, "#news", "The front sensor is dead")
    (tmp_path / "run.log").write_bytes(saved(page, "#save-log"))
    (tmp_path / "run.world.json").write_bytes(saved(page, "#save-world"))

    done = octet("replay", tmp_path / "run.log", "--html", tmp_path / "replay.html")

    assert (done.returncode, done.stderr) == (0, "")
    edits = json.loads((tmp_path / "run.world.json").read_text())["edits"]
    assert [edit["do"] for edit in edits] == ["plant", "grow_plant", "move_plant", "body"]
    assert run_in(tmp_path / "replay.html")["scenes"] == page.evaluate("octet.lane.data.run.scenes")
