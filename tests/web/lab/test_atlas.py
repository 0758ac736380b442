"""The map of all memories in octet.html: its colours, the ways of robots on it, and a robot for each square."""

import csv

import pytest
from playwright.sync_api import Page

from host_sim.lab.study.atlas import MEMORIES, map_of
from host_sim.lab.study.trial import Trial
from host_sim.sim.run_config import RunConfig
from tests.runs.support import ROOT
from tests.web.lab.support import DONE, go, settle, simulated
from tests.web.support import next_frame, wait_for

MAP = "#atlas-map"
TIME = 16 * 81 + 5
"""A memory's number in the table, neither the first nor of the first block."""


def digits(memory) -> str:
    return "".join(str(int(side)) for side in memory)


@pytest.fixture
def atlas(shared: Page) -> Page:
    """A new run of five environments, beside its map."""
    shared.click("#tab-run")
    shared.locator("#worlds input").first.check(force=True)
    shared.click("#new-run button")
    wait_for(shared, DONE)
    shared.click("#tab-atlas")
    settle(shared)
    return shared


def square_of(page: Page, memory: str) -> tuple[float, float]:
    """Where a memory lies, in CSS px from the canvas's corner: cells 1, 3, 2, 5 across and 4, 6, 7 down."""
    cells = [int(cell) for cell in memory]
    column, row = (sum(3**i * cells[cell] for i, cell in enumerate(order)) for order in ((5, 2, 3, 1), (7, 6, 4)))
    box = page.locator(MAP).bounding_box()
    return (column + 0.5) * box["width"] / 81, (row + 0.5) * box["height"] / 27


def press(page: Page, memory: str) -> None:
    x, y = square_of(page, memory)
    page.locator(MAP).click(position={"x": x, "y": y})
    settle(page)


def choose_corridors(page: Page) -> None:
    page.click("#tab-run")
    page.locator("#worlds input[value=corridors]").check(force=True)
    page.click("#new-run button")
    wait_for(page, DONE)
    page.click("#tab-atlas")
    settle(page)


def test_square_shows_the_mean_time_measured_by_the_study(atlas):
    with (ROOT / "docs/tables/atlas-map.csv").open(newline="") as file:
        row = [*csv.DictReader(file)][TIME]
    x, y = square_of(atlas, row["memory"])

    atlas.locator(MAP).hover(position={"x": x, "y": y})
    next_frame(atlas)

    assert atlas.inner_text("#atlas-square") == f"{row['memory']}: {round(float(row['mean_s']))} s"


def test_robot_of_a_pressed_square_has_its_memory_and_learns_nothing(atlas):
    press(atlas, "01021020")
    go(atlas, 10**6)

    assert atlas.evaluate("octet.lanes.map(({ scene }) => scene.state.memory.join(''))")[1] == "01021020"
    assert atlas.evaluate("octet.lanes[1].data.robots[0].run.lessons.filter((it) => !it.by_hand)") == []
    press(atlas, "02010010")
    assert atlas.evaluate("octet.lanes.map(({ scene }) => scene.state.memory.join(''))")[1:] == ["02010010"]


def test_trail_on_the_map_ends_at_the_memory_of_the_learner(atlas):
    go(atlas, 10**6)

    way, memory = atlas.evaluate("[octet.atlas.wayOf(octet.lane), octet.scene.state.memory]")

    box = atlas.locator(MAP).bounding_box()
    x, y = square_of(atlas, digits(memory))
    assert way[0] == [0, 0]
    assert way[-1] == [int(x * 81 / box["width"]), int(y * 27 / box["height"])]


def test_keys_choose_a_square_and_start_its_robot(atlas):
    atlas.locator(MAP).focus()
    x, y = square_of(atlas, "00000000")
    atlas.locator(MAP).hover(position={"x": x, "y": y})

    for key in ("ArrowRight", "ArrowDown", "ArrowDown", "Enter"):
        atlas.keyboard.press(key)
    settle(atlas)

    assert atlas.inner_text("#atlas-square").startswith("00000102: ")
    assert atlas.evaluate("octet.lanes[1].experiment.robots[0].memory.join('')") == "00000102"


def test_computed_map_has_the_times_of_the_fleet(atlas):
    choose_corridors(atlas)
    assert atlas.inner_text("#atlas-square").endswith("not yet known")
    memories = [memory for memory in MEMORIES if not (memory[2] or memory[5] or memory[7])]

    atlas.click("#atlas-extend")
    wait_for(atlas, "octet.atlas.map.environments === 1")
    atlas.click("#atlas-extend")
    wait_for(atlas, "!octet.atlas.map.isGrowing")

    values = map_of(Trial(RunConfig(seed=2, world="corridors", profile="article", environments=1))).values
    seconds = {memory: values[MEMORIES.index(memory), 0] / 50 for memory in memories}
    sums, counts = atlas.evaluate("[[...octet.atlas.map.sums], [...octet.atlas.map.counts]]")
    assert len(memories) == len(counts) == 81
    once = [(total, seconds[it]) for it, total, count in zip(memories, sums, counts, strict=True) if count == 1]
    assert len(once) >= 70
    assert [total for total, _ in once] == pytest.approx([second for _, second in once])


def test_fifth_run_is_refused(atlas):
    for _ in range(3):
        atlas.click("#what-if")
        simulated(atlas)

    press(atlas, "01000000")

    assert atlas.evaluate("octet.lanes.length") == 4
    assert atlas.inner_text("#note") == "Close a run first: no more than four fit."
