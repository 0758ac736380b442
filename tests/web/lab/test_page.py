"""octet.html: one file without a server that runs the real robot, and shows what it does."""

import itertools

import pytest
from playwright.sync_api import Page

from host_sim.protocol.generated import PARAMETERS
from host_sim.world.names import STILL_WORLDS
from tests.runs.support import octet, octet_process
from tests.web.lab.support import READY, SIZES, go, saved, settle, simulated
from tests.web.looks import ARENA, PHONES, TOO_SMALL, check, out_of_view, resize, too_small, violations_at
from tests.web.support import next_frame, wait_for, wait_for_text

SIZE_MAX = 380_000
IN_VIEW = ("#floors", "#scrub", "#play", "#doing", "#what-if", "#tabs", "#cells")


def test_octet_html_is_one_file_below_380_kb(file):
    assert file.stat().st_size < SIZE_MAX


def test_browser_that_cannot_unpack_the_page_is_told_so(file, open_page):
    without = "delete window.DecompressionStream"
    page = open_page(file.as_uri(), ready="document.body", prepare=lambda page: page.add_init_script(without))

    wait_for(page, "document.body.innerText.startsWith('This page needs a newer browser')")


def test_page_has_the_same_bytes_from_the_same_sources(file, tmp_path):
    assert octet("page", tmp_path / "again.html").returncode == 0

    assert (tmp_path / "again.html").read_bytes() == file.read_bytes()


def test_unwritable_page_is_reported_in_one_line(tmp_path):
    done = octet("page", tmp_path / "no" / "such" / "octet.html")

    assert done.returncode != 0
    assert len(done.stderr.splitlines()) == 1


def test_results_table_is_saved_as_csv(shared):
    shared.click("#tab-curves")

    lines = saved(shared, "#save-csv").decode().splitlines()

    assert lines[0].startswith("run,robot,behaviour,seed,environment,finished,time (s),shortest tour (s),trials")
    assert len(lines) == 6


def test_debugger_takes_the_log_that_the_page_saves(page, tmp_path):
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    go(page, 371)
    page.click("#tab-listing")
    page.focus("#copy-debugger")
    page.keyboard.press("Enter")
    wait_for_text(page, "#note", "save it under Files")
    (tmp_path / "run.log").write_bytes(saved(page, "#save-log"))

    command, sensed = page.evaluate("(async () => [await navigator.clipboard.readText(), octet.scene.state.feel])()")

    assert command == "tools/octet debug run.log --node 1 --tick 371"
    shown = octet_process("debug", tmp_path / "run.log", *command.split()[3:], "--ex", "output/u sensed->feel").stdout
    assert shown.endswith(f"{sensed}")


def test_debugger_command_is_refused_for_a_program(page):
    page.click("#tab-program")
    page.click("#program-run")
    settle(page)
    page.evaluate("octet.select(octet.lanes[1])")
    page.click("#tab-listing")
    page.click("#copy-debugger")

    wait_for_text(page, "#note", "Your program is not C")


def test_parameters_have_sliders_with_their_ranges(shared):
    sliders = "[...document.querySelectorAll('.slider input')]"
    ranges = shared.evaluate(f"{sliders}.map(({{ title, min, max }}) => [title, Number(min), Number(max)])")

    assert ranges == [[name, it.minimum, it.maximum] for name, it in PARAMETERS.items()]


def test_arena_is_large_enough_with_one_run_and_with_two(shared):
    assert too_small(shared, ARENA, "#floors canvas") == []
    shared.click("#what-if")
    settle(shared)
    assert too_small(shared, {(1366, 657): (470, 350)}, "#floors canvas") == []
    shared.evaluate("octet.removeLane(octet.lane)")


def test_playback_continues_from_the_scrubbed_tick(shared):
    shared.evaluate("octet.go(0)")
    shared.click("#play")
    go(shared, 1000)
    settle(shared)
    tick = shared.evaluate("octet.tick")
    shared.click("#play")

    assert tick >= 1000


@pytest.mark.parametrize("kind", ["obstacle", "decision", "lesson"])
def test_next_button_goes_to_the_next_event_of_the_chosen_kind(shared, kind):
    shared.select_option("#kind", kind)
    shared.evaluate("octet.go(60)")
    shared.click("#after")
    here = shared.evaluate("octet.tick")
    actions, patterns = shared.evaluate(
        "[octet.lane.data.robots[0].columns.action, octet.lane.data.robots[0].columns.pattern].map((it) => [...it])"
    )
    lessons = [lesson["tick"] for lesson in shared.evaluate("octet.lane.data.robots[0].run.lessons")]

    wanted = {
        "obstacle": lambda tick: patterns[tick] and not patterns[tick - 1],
        "decision": lambda tick: actions[tick] != actions[tick - 1],
        "lesson": lambda tick: tick in lessons,
    }[kind]
    assert here == next(tick for tick in range(61, len(actions)) if wanted(tick))


@pytest.mark.parametrize(
    ("reason", "line"), [(5, "if r=Turn"), (4, "if Mem[Senses] = Turn"), (1, "rForward Dist"), (7, "FoodCnt--")]
)
def test_listing_highlights_the_line_that_the_robot_executes(shared, reason, line):
    shared.click("#tab-listing")
    shared.evaluate("reason => octet.go(octet.lane.data.robots[0].columns.reason.indexOf(reason))", reason)

    wait_for(
        shared,
        "line => [...document.querySelectorAll('#listing [aria-current=true]')]"
        ".some((it) => it.innerText.includes(line))",
        line,
    )


def test_controls_are_in_view_at_every_size(shared):
    for size in SIZES:
        resize(shared, size)
        assert out_of_view(shared, IN_VIEW, size) == [], size
    for size in (*SIZES, *PHONES):
        resize(shared, size)
        assert shared.evaluate("document.documentElement.scrollWidth <= innerWidth"), size


def test_controls_are_large_enough_for_touch_on_a_phone(shared):
    for size, tab in itertools.product(PHONES, ("run", "parameters", "curves", "files")):
        resize(shared, size)
        shared.click(f"#tab-{tab}")
        assert shared.evaluate(TOO_SMALL) == [], (size, tab)


def test_replaced_runs_take_no_memory(page):
    for _ in range(3):
        page.evaluate("octet.begin(octet.lane.experiment)")
        simulated(page)

    assert {kind: alive(page, f"octet.lane{path}") for kind, path in (("run", ""), ("drawing", ".renderer"))} == {
        "run": 1,
        "drawing": 1 + len(STILL_WORLDS),  # each has its picture
    }


def alive(page: Page, one: str) -> int:
    """How many objects of the class of this one the browser cannot free."""
    debugger = page.context.new_cdp_session(page)
    kind = debugger.send("Runtime.evaluate", {"expression": f"{one}.constructor.prototype"})["result"]["objectId"]
    found = debugger.send("Runtime.queryObjects", {"prototypeObjectId": kind})["objects"]["objectId"]
    count = {"functionDeclaration": "function () { return this.length; }", "objectId": found, "returnByValue": True}
    return debugger.send("Runtime.callFunctionOn", count)["result"]["value"]


def test_comparison_of_two_runs_follows_the_runs_that_are_shown(page):
    page.click("#what-if")
    simulated(page)
    page.select_option("#behaviour", "never")
    settle(page)
    assert page.inner_text("#parting").startswith("They diverge at")

    # Another run of the same name, simulated as often; the next frame shows those that are there again.
    said = page.evaluate(
        "() => { const [a, b] = octet.lanes; const other = Object.assign(Object.create(Object.getPrototypeOf(b)), b,"
        " { data: a.data }); octet.parting.show([a, other], other);"
        " return document.querySelector('#parting').textContent; }"
    )

    assert said == "They do the same until the end."


def test_new_run_plays_at_once_unless_reduced_motion_is_wanted(file, open_page):
    playing = []
    for motion in ("no-preference", "reduce"):
        page = open_page(file.as_uri(), ready=READY, reduced_motion=motion)
        playing.append(page.evaluate("octet.playing"))
        page.evaluate("octet.setPlaying(false)")
        page.click("#new-run button")
        wait_for(page, "octet.scene && octet.last > 0")
        next_frame(page)
        playing.append(page.evaluate("octet.playing"))

    assert playing == [True, True, False, False]


def test_sentence_cells_and_meter_are_of_the_same_tick(page):
    page.evaluate(
        "const { scene, panel } = octet;"
        "scene.shown.set(scene.state.node, { ...scene.state, repeat_count: 7, memory: [0, 1, 2, 0, 0, 0, 0, 0] });"
        "panel.show(scene, { exact: true });"
    )

    assert page.inner_text("#boredom-count") == "7 of 10"
    assert page.locator("#cells .cell").evaluate_all("cells => cells.slice(0, 3).map((it) => it.dataset.side)") == [
        "nothing",
        "left",
        "right",
    ]


def test_number_field_reports_wrong_input_in_the_pages_language(page):
    page.select_option("#language", "de")
    page.locator("#seed").press_sequentially("7a")

    assert page.evaluate("document.querySelector('#seed').validationMessage").startswith("Bitte eine ganze Zahl")
    page.fill("#seed", "7")
    assert page.evaluate("document.querySelector('#seed').validationMessage") == ""


def test_axe_finds_nothing(page):
    page.click("#what-if")
    page.evaluate("octet.go(3000)")
    simulated(page)
    assert violations_at(page, (PHONES[0], SIZES[0], SIZES[-1])) == []
    for tab in ("parameters", "listing", "curves", "files"):
        page.click(f"#tab-{tab}")
        assert violations_at(page, (SIZES[-1],)) == [], tab


def test_page_screens_are_readable_and_fit_the_width(shared):
    shared.evaluate("octet.go(3000)")
    for scheme, size in itertools.product(("light", "dark"), (*SIZES[:1], *SIZES[2:3], PHONES[0])):
        shared.emulate_media(color_scheme=scheme)
        resize(shared, size)
        check(shared, f"octet-{scheme}-{size[0]}")
