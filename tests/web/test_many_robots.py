"""Pages that show many robots: all are drawn, one is selected, commands name theirs."""

import json

import pytest

from host_sim.recording.state_types import State
from tests.runs.support import octet
from tests.web.fake_run import ENVIRONMENT, HOME, FakeRun, robot_state, write_replay
from tests.web.support import drag, next_frame, pause, place_on_page, wait_for, wait_for_text

# The colour of the canvas at a place of the arena, and the one that the style sheet has by a name.
COLOUR_AT = """([x, y]) => {
  const { canvas, scale } = octet.lane.renderer;
  const [px, py] = [(x + 40) * scale, (y + 40) * scale].map(Math.round);
  const [r, g, b] = canvas.getContext("2d").getImageData(px, py, 1, 1).data;
  return "#" + [r, g, b].map((part) => part.toString(16).padStart(2, "0")).join("");
}"""
COLOUR_OF = "name => getComputedStyle(document.body).getPropertyValue(`--${name}`).trim()"


def number_of(x: float, y: float) -> tuple[float, float]:
    """A place below the digits of the number beside a robot."""
    return x + 165, y + 165 + 55


def three() -> list[State]:
    return [
        robot_state(1, 800, 700),
        robot_state(2, 2000, 1500, reason=4, pattern=1, left=1, right=2, memory=[0, 1, 0, 0, 0, 0, 0, 0]),
        robot_state(12, 3300, 1500, reason=0, memory=[0, 0, 0, 0, 2, 0, 0, 0]),
    ]


@pytest.fixture
def run() -> FakeRun:
    return FakeRun(three())


@pytest.fixture
def page(run, open_page):
    return open_page(HOME, prepare=run.serve, viewport={"width": 1366, "height": 768})


def selected(page) -> int:
    return page.evaluate("octet.scene.node")


def test_robots_are_drawn_in_the_colours_of_their_reasons(page):
    for x, y, reason in ((800, 700, "wander"), (2000, 1500, "remembered"), (3300, 1500, "stop")):
        assert page.evaluate(COLOUR_AT, [x - 60, y]) == page.evaluate(COLOUR_OF, f"reason-{reason}")


def test_robots_have_their_numbers_beside_them(page):
    ink, paper = (page.evaluate(COLOUR_OF, name) for name in ("ink", "paper"))

    inside = [page.evaluate(COLOUR_AT, number_of(x, y)) for x, y in ((800, 700), (2000, 1500), (3300, 1500))]

    assert inside == [ink, paper, paper]


def test_robot_alone_has_no_number_and_no_buttons(open_page):
    page = open_page(HOME, prepare=FakeRun([robot_state(1, 800, 700)]).serve)

    assert page.evaluate(COLOUR_AT, number_of(800, 700)) == page.evaluate(COLOUR_OF, "floor")
    assert not page.is_visible("#robots")
    assert page.inner_text("#memory-title") == "Memory: eight bytes"


def test_robots_leave_one_trail_each(page, run):
    for state in run.states:
        state["x"] += 40
    run.send()
    wait_for(page, "octet.scene.state.x === 840")

    assert page.evaluate("octet.scene.trails.map(({ length, x }) => [length, ...x.slice(0, 2)])") == [
        [2, 800, 840],
        [2, 2000, 2040],
        [2, 3300, 3340],
    ]


def test_keys_for_digits_and_brackets_select_a_robot(page):
    seen = [selected(page)]
    for key in ("2", "]", "]", "[", "1", "7"):
        page.keyboard.press(key)
        seen.append(selected(page))

    assert seen == [1, 2, 12, 1, 12, 1, 1]


def test_click_selects_a_robot(page):
    page.mouse.click(*place_on_page(page, 3300, 1500))
    assert selected(page) == 12
    page.click("#robots >> text='2'")
    assert selected(page) == 2
    wait_for(page, "document.querySelector('#robots [aria-pressed=true]').value === '2'")


def test_panel_shows_the_selected_robot(page, run):
    run.send(lessons=[{"node": 2, "tick": 5, "cell": 1, "side": 1, "by_hand": 0}])
    wait_for_text(page, "#memory-title", "Memory of robot 1: eight bytes")
    assert page.inner_text("#lessons") == "Nothing yet."

    page.keyboard.press("2")

    wait_for_text(page, "#doing", "Front-right blocked: I remember that turning left helped.")
    wait_for_text(page, "#memory-title", "Memory of robot 2: eight bytes")
    wait_for_text(page, "#cells li:nth-child(2)", "left")
    wait_for_text(page, "#lessons", "Learned: front-right blocked, turn left.")
    page.keyboard.press("]")
    wait_for_text(page, "#doing", "I am standing still.")
    wait_for_text(page, "#cells li:nth-child(5)", "right")
    assert page.inner_text("#lessons") == "Nothing yet."


def test_dragged_robot_is_lifted_and_put_by_its_number(page, run):
    drag(page, (2000, 1500), (2300, 1200))
    wait_for(page, "octet.scene.node === 2")

    lift, put = run.commands
    assert lift == {"do": "lift", "node": 2}
    assert {**put, "at": None} == {"do": "put", "node": 2, "at": None, "heading": 0}
    assert put["at"] == pytest.approx([2300, 1200], abs=10)


def test_two_robots_can_be_held_at_once(page, run):
    for node in (1, 2):
        page.keyboard.press(f"{node}")
        page.click("#lift")
        run.states[node - 1]["lifted"] = 1
        run.send()
        wait_for(page, "node => octet.scene.states[node - 1].lifted && octet.scene.ghosts.has(node)", node)
    wait_for_text(page, "#lift", "Put down robot 2")

    page.keyboard.press("1")
    page.click("#lift")

    assert run.commands[:2] == [{"do": "lift", "node": 1}, {"do": "lift", "node": 2}]
    assert run.commands[2:] == [{"do": "put", "node": 1, "at": [800, 700], "heading": 0}]


def test_cells_are_written_erased_and_frozen_in_the_selected_robot(page, run):
    page.keyboard.press("2")
    wait_for_text(page, "#memory-title", "robot 2")

    for button in ("#cells li:nth-child(4) button", "#erase", "#freeze"):
        page.click(button)

    assert run.commands == [
        {"do": "write", "node": 2, "cell": 3, "side": 1},
        {"do": "erase", "node": 2},
        {"do": "freeze", "node": 2, "on": 1},
    ]


def test_selected_robot_stays_selected_after_a_new_connection(page, run):
    page.keyboard.press("2")
    run.states[0]["x"] = 900
    run.send(measures=page.evaluate("octet.scene.measures"), environment=page.evaluate("octet.scene.environment"))
    wait_for(page, "octet.scene.states[0].x === 900")

    assert selected(page) == 2
    assert page.evaluate("octet.scene.trails.map(({ length }) => length)") == [1, 1, 1]


def test_trails_begin_anew_when_the_same_environment_starts_over(page, run):
    for state in run.states:
        state["x"] += 400
    run.send(environment={**ENVIRONMENT, "first_tick": 90, "start_tick": 90})
    wait_for(page, "octet.scene.environment.first_tick === 90")

    assert page.evaluate("octet.scene.trails.map(({ length }) => length)") == [1, 1, 1]


def test_lost_connection_stays_reported_when_the_page_is_redrawn(page):
    page.evaluate("octet.connection.open = () => {}")
    page.evaluate("octet.connection.socket.close()")
    wait_for_text(page, "#status", "no connection")

    page.click("#zoom-in")
    next_frame(page)

    assert page.inner_text("#status").startswith("no connection")


def test_numbers_have_the_decimal_separator_of_the_language(run, open_page):
    page = open_page(HOME, prepare=run.serve, locale="de")
    run.send(pins=[{"volts": 7.4, "counts": [5, 6], "duty": [30, -31]}])
    wait_for_text(page, "#pins", "V")

    assert (page.inner_text("#fact-speed")[:3], page.inner_text("#pins")[:5]) == ("1,0", "7,4 V")


def test_right_mouse_button_does_not_move_a_robot(page, run):
    page.mouse.move(*place_on_page(page, 2000, 1500))
    page.mouse.down(button="right")
    page.mouse.move(*place_on_page(page, 2300, 1200))
    page.mouse.up(button="right")

    assert run.commands == []


@pytest.fixture
def replay(tmp_path, open_page):
    robots = [
        {"node": 3, "y": 800, "cell": 1, "learned_at": 50},
        {"node": 4, "y": 1600, "cell": 4, "learned_at": 120},
    ]
    return open_page(write_replay(tmp_path / "many.html", robots).as_uri())


def test_recorded_run_opens_at_the_tick_that_it_names(tmp_path, open_page):
    robots = [{"node": 3, "y": 800, "cell": 1, "learned_at": 50}]

    page = open_page(write_replay(tmp_path / "wrong.html", robots, shown=77).as_uri())

    assert page.evaluate("[octet.tick, octet.scene.states[0].x]") == [77, 654]


def test_recorded_run_has_the_states_of_all_robots(replay):
    replay.evaluate("octet.go(100)")

    assert replay.evaluate(
        "octet.scene.states.map(({ node, x, y, memory }) => [node, x, y, memory[1], memory[4]])"
    ) == [
        [3, 700, 800, 1, 0],
        [4, 700, 1600, 0, 0],
    ]


def test_recorded_run_goes_to_the_events_of_the_selected_robot(replay):
    replay.select_option("#kind", "lesson")
    replay.click("#after")
    assert replay.evaluate("octet.tick") == 50

    replay.keyboard.press("4")
    replay.click("#after")

    assert replay.evaluate("octet.tick") == 120
    wait_for_text(replay, "#memory-title", "robot 4")
    wait_for_text(replay, "#lessons", "Learned: front-left blocked, turn left.")


def test_click_selects_a_recorded_robot(replay):
    assert selected(replay) == 3
    replay.mouse.click(*place_on_page(replay, 500, 1600))
    assert selected(replay) == 4


def test_commands_act_on_one_robot_of_a_live_run(watch, open_page):
    watched = watch("--robots", "3", "--seed", "1")
    page = open_page(watched.url)
    pause(page)
    assert page.evaluate("octet.scene.states.map(({ node }) => node)") == [1, 2, 3]
    page.keyboard.press("2")
    wait_for_text(page, "#memory-title", "robot 2")

    page.click("#cells li:nth-child(8) button")
    wait_for(page, "octet.scene.states[1].memory[7] === 1")
    page.click("#lift")
    wait_for(page, "octet.scene.states[1].lifted === 1")

    assert page.evaluate("octet.scene.states.map(({ memory, lifted }) => [memory[7], lifted])") == [
        [0, 0],
        [1, 1],
        [0, 0],
    ]
    assert watched.end() == 0
    assert [(edit["do"], edit["robot"]) for edit in watched.params()["edits"]] == [("lift", 1)]


def test_recorded_run_ends_with_the_memory_of_each_robot(tmp_path, open_page):
    words = ("--robots", "2", "--seed", "3", "--environments", "1", "--limit-s", "20")
    assert octet("run", "--bus", "none", *words, "--quiet", "--out", tmp_path).returncode == 0
    page = open_page((tmp_path / "replay.html").as_uri())

    page.evaluate("octet.go(octet.last)")

    summary = json.loads((tmp_path / "summary.json").read_text())
    shown = page.evaluate("octet.scene.states.map(({ node, memory }) => [node, memory])")
    assert shown == [[robot["node"], robot["memory"]] for robot in summary["robots"]]
