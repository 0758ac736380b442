"""octet.html in Chromium: one file without a server that runs the real robot."""

import hashlib
import itertools
import json
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, Page

from host_sim.protocol.generated import PARAMETERS
from tests.runs.support import ROOT, octet
from tests.web.page_runs import page_file
from tests.web.support import Faults, run_in, wait_for, wait_for_text
from tests.web.test_layout import TOO_SMALL, out_of_view, resize
from tests.web.test_screens import check

READY = "window.octet?.scene?.state && octet.last > 0"
DONE = "document.querySelector('#status').textContent === 'the real firmware, in this page'"
SIZE_MAX = 500_000
SIZES = [(1024, 768), (1366, 657), (1440, 900), (1920, 1080)]
PHONES = [(390, 844), (844, 390)]
IN_VIEW = ("#floors", "#scrub", "#play", "#doing", "#what-if", "#tabs", "#cells")


@pytest.fixture(scope="module")
def file(tmp_path_factory) -> Path:
    return page_file(tmp_path_factory.mktemp("page"))


@pytest.fixture
def page(file: Path, open_page: Callable[..., Page]) -> Page:
    page = open_page(file.as_uri(), ready=READY)
    wait_for(page, DONE)
    return page


@pytest.fixture(scope="module")
def shared(file: Path, browser: Browser) -> Iterator[Page]:
    """One page for all tests that only look around in it."""
    page = browser.new_context().new_page()
    faults = Faults(file.as_uri())
    faults.listen(page)
    page.goto(file.as_uri())
    wait_for(page, DONE)
    yield page
    page.context.close()
    assert faults.seen == []


def simulated(page: Page) -> None:
    """Waits until every run is simulated as it was changed."""
    wait_for(page, "octet.simulator.running === undefined && octet.simulator.queued.size === 0")


def saved(page: Page, button: str) -> bytes:
    with page.expect_download() as download:
        page.evaluate("id => document.querySelector(id).click()", button)
    return Path(download.value.path()).read_bytes()


def test_the_page_is_one_small_file(file):
    assert file.stat().st_size < SIZE_MAX


def test_the_page_is_the_same_from_the_same_sources(file, tmp_path):
    assert octet("page", tmp_path / "again.html").returncode == 0

    assert (tmp_path / "again.html").read_bytes() == file.read_bytes()


def test_a_page_that_cannot_be_written_is_told_in_one_line(tmp_path):
    done = octet("page", tmp_path / "no" / "such" / "octet.html")

    assert done.returncode != 0
    assert len(done.stderr.splitlines()) == 1


def test_its_log_is_that_of_tools_run(page, tmp_path):
    assert octet("run", "--bus", "none", "--seed", "1", "--quiet", "--out", tmp_path).returncode == 0

    log = saved(page, "#save-log")

    assert hashlib.sha256(log).hexdigest() == hashlib.sha256((tmp_path / "run.log").read_bytes()).hexdigest()


def test_a_changed_cell_makes_another_future_beside_the_first(page):
    page.evaluate("octet.go(2200)")
    page.click("#what-if")
    page.click("#cells li:nth-child(2) button")
    simulated(page)

    wait_for_text(page, "#parting", "A and B part at 0:50.5 (tick 2523)")
    assert "Their memories differ: front-right." in page.inner_text("#parting")
    assert page.evaluate("octet.lanes.map((lane) => lane.experiment.changes.length)") == [0, 1]
    same = "octet.lanes.map((lane) => [...lane.data.robots[0].columns.x.slice(0, 2523)].join())"
    one, other = page.evaluate(same)
    assert one == other


def test_a_pressed_cell_shows_its_turn_at_once_and_the_next_one_when_it_is_pressed_again(page):
    cell = "#cells li:nth-child(5)"

    page.click(f"{cell} button")
    wait_for_text(page, cell, "left")
    page.click(f"{cell} button")

    wait_for_text(page, cell, "right")


@pytest.mark.parametrize("change", ["behaviour", "parameter", "obstacle", "seed"])
def test_a_changed_behaviour_parameter_or_obstacle_makes_another_future(page, change):
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

    wait_for_text(page, "#parting", "A and B part at")


def test_what_was_changed_is_replayed_by_the_host(page, tmp_path):
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


def test_a_change_that_cannot_be_made_is_told_and_dropped(page):
    page.evaluate("octet.go(300)")
    page.evaluate(
        "(() => { const { x, y } = octet.scene.state; const at = [Math.round(x), Math.round(y)];"
        " octet.change({ do: 'add_bar', a: at, b: [at[0] + 300, at[1]] }); })()"
    )

    wait_for_text(page, "#note", "the robot stands there")
    wait_for(page, "octet.lane.experiment.changes.length === 0")


def test_a_recorded_log_is_opened_and_is_the_same_run(page, tmp_path):
    words = ("--profile", "adaptive", "--environments", "2", "--seed", "9", "--set", "turn_deg=20")
    assert octet("run", "--bus", "none", "--quiet", "--out", tmp_path, *words).returncode == 0
    page.click("#tab-files")

    page.set_input_files("#open", [tmp_path / "run.log", tmp_path / "run.world.json"])

    wait_for_text(page, "#file-news", "byte for byte")
    simulated(page)
    assert saved(page, "#save-log") == (tmp_path / "run.log").read_bytes()


def test_a_file_that_is_no_log_is_told(page, tmp_path):
    (tmp_path / "run.log").write_text("hello\n")
    page.click("#tab-files")

    page.set_input_files("#open", tmp_path / "run.log")

    wait_for_text(page, "#file-news", "line 1 is no frame of a log")


def test_a_memory_goes_out_and_comes_back(page, tmp_path):
    page.evaluate("octet.go(octet.last)")
    memory = saved(page, "#save-memory")
    (tmp_path / "robot.mem").write_bytes(memory)
    page.click("#tab-files")

    page.set_input_files("#open", tmp_path / "robot.mem")

    wait_for_text(page, "#file-news", "The robot begins with robot.mem.")
    simulated(page)
    page.evaluate("octet.go(0)")
    assert bytes(page.evaluate("octet.scene.state.memory")) == memory


def test_a_memory_is_saved_with_its_confidence(page, tmp_path):
    page.select_option("#behaviour", "adaptive")
    page.fill("#environments", "1")
    page.click("text=New run")
    wait_for(page, "octet.lane.data")
    simulated(page)
    page.evaluate("octet.go(octet.last)")
    words = ("--profile", "adaptive", "--environments", "1", "--memory", tmp_path / "host.mem")
    assert octet("run", "--bus", "none", "--quiet", "--out", tmp_path, *words).returncode == 0

    memory = saved(page, "#save-memory")

    assert memory == (tmp_path / "host.mem").read_bytes()
    assert max(memory) > 2


def test_a_file_that_is_no_memory_is_told(page, tmp_path):
    (tmp_path / "robot.mem").write_bytes(bytes([0, 99, 0, 0, 0, 0, 0, 0]))
    page.click("#tab-files")

    page.set_input_files("#open", tmp_path / "robot.mem")

    wait_for_text(page, "#file-news", "these eight bytes are no memory of a robot")
    assert page.evaluate("octet.lane.experiment.robots[0].memory") is None


def test_a_world_file_begins_a_run_in_it(page, tmp_path):
    world = ROOT / "docs/worlds/two_walls.toml"
    assert octet("run", "--bus", "none", "--world", world, "--quiet", "--out", tmp_path).returncode == 0
    page.click("#tab-files")

    page.set_input_files("#open", world)

    wait_for_text(page, "#file-news", "A new run in two_walls.toml.")
    assert saved(page, "#save-log") == (tmp_path / "run.log").read_bytes()
    assert page.evaluate("document.querySelector('#world').value") == "two_walls.toml"


def test_a_run_in_another_world_with_plants_and_a_broken_body_can_be_repeated_from_its_files(page, tmp_path):
    page.select_option("#world", "posts")
    page.click("text=New run")
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


def test_the_table_is_saved_for_a_spreadsheet(shared):
    shared.click("#tab-curves")

    lines = saved(shared, "#save-csv").decode().splitlines()

    assert lines[0].startswith("run,robot,behaviour,seed,environment,finished,time s,trials")
    assert len(lines) == 6


def test_each_parameter_has_a_slider_with_its_range(shared):
    sliders = "[...document.querySelectorAll('.slider input')]"
    ranges = shared.evaluate(f"{sliders}.map(({{ title, min, max }}) => [title, Number(min), Number(max)])")

    assert ranges == [[name, it.minimum, it.maximum] for name, it in PARAMETERS.items()]


@pytest.mark.parametrize("kind", ["obstacle", "decision", "lesson"])
def test_it_goes_to_the_next_one(shared, kind):
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
def test_the_line_is_lit_that_the_robot_executes(shared, reason, line):
    shared.click("#tab-listing")
    shared.evaluate("reason => octet.go(octet.lane.data.robots[0].columns.reason.indexOf(reason))", reason)

    wait_for(
        shared,
        "line => [...document.querySelectorAll('#listing [aria-current]')].some((it) => it.innerText.includes(line))",
        line,
    )


def test_all_that_matters_is_in_view(shared):
    for size in SIZES:
        resize(shared, size)
        shared.wait_for_timeout(50)
        assert out_of_view(shared, IN_VIEW, size) == [], size
    for size in (*SIZES, *PHONES):
        resize(shared, size)
        assert shared.evaluate("document.documentElement.scrollWidth <= innerWidth"), size


def test_fingers_can_hit_everything_on_a_phone(shared):
    for size, tab in itertools.product(PHONES, ("run", "parameters", "curves", "files")):
        resize(shared, size)
        shared.click(f"#tab-{tab}")
        assert shared.evaluate(TOO_SMALL) == [], (size, tab)


def violations(page: Page) -> list[str]:
    return [f"{it['id']}: {it['nodes'][0]['html'][:90]}" for it in Axe().run(page).response["violations"]]


def test_axe_finds_nothing(page):
    page.click("#what-if")
    page.evaluate("octet.go(3000)")
    simulated(page)
    for scheme, size in itertools.product(("light", "dark"), (PHONES[0], SIZES[0], SIZES[-1])):
        page.emulate_media(color_scheme=scheme)
        resize(page, size)
        assert violations(page) == [], (scheme, size)
    for scheme, tab in itertools.product(("light", "dark"), ("parameters", "listing", "curves", "files")):
        page.emulate_media(color_scheme=scheme)
        page.click(f"#tab-{tab}")
        assert violations(page) == [], (scheme, tab)


def test_screens(shared):
    shared.evaluate("octet.go(3000)")
    for scheme, size in itertools.product(("light", "dark"), (*SIZES[:1], *SIZES[2:3], PHONES[0])):
        shared.emulate_media(color_scheme=scheme)
        resize(shared, size)
        shared.wait_for_timeout(60)
        check(shared, f"octet-{scheme}-{size[0]}")
