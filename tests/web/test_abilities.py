"""What can be done with a simulated, a recorded and a live run: the table in docs/page.md is tried in the pages."""

import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest
from playwright.sync_api import Page

from tests.runs.support import ROOT, octet
from tests.web.lab.support import READY as LAB_READY
from tests.web.sim.page_runs import page_file
from tests.web.support import wait_for

SIMULATED = "octet.simulator.running === undefined && octet.simulator.queued.size === 0"
DIRECT, WHAT_IF = "yes", "in a copy"
SOURCES = ("simulated", "recorded", "live")


@dataclass(frozen=True)
class Ability:
    """Something to be done on a page.

    Attributes:
        control: What is pressed or set, last.
        happened: Becomes something else by it.
        tab: The tab to open before, if any.
        value: What is chosen or typed; none if the control is a button.
    """

    control: str
    happened: str
    tab: str = ""
    value: str = ""

    def does(self, page: Page) -> bool:
        """Does it, and waits for what happens."""
        wait_for(page, "octet.scene")  # a copy of a recorded run may be on its way
        before = page.evaluate(f"JSON.stringify({self.happened})")
        if self.tab:
            page.click(self.tab)
        self._do(page)
        wait_for(page, f"(before) => octet.scene && JSON.stringify({self.happened}) !== before", before)
        if self.control == "#play":
            page.click(self.control)  # a change of a paused run happens with its next tick
        return True

    def _do(self, page: Page) -> None:
        control = page.locator(self.control).first
        if not self.value:
            control.click()
        elif control.evaluate("element => element.tagName") == "SELECT":
            control.select_option(self.value)
            if self.control == "#kind":
                page.click("#before")
        else:
            control.fill(self.value)
            control.dispatch_event("change")
            control.press("Enter")


MEMORY = "octet.scene.state.memory[1]"
OTHER_FUTURE = "octet.lane.experiment"
ABILITIES = {
    "play and pause": Ability("#play", "octet.play?.playing ?? octet.playing"),
    "go to any time": Ability("#scrub", "octet.tick", value="40"),
    "go to the next trial or other event": Ability("#kind", "octet.tick", value="environment"),
    "zoom": Ability("#zoom-in", "document.querySelector('#zoom-out').disabled"),
    "change the memory": Ability("#cells li:nth-child(2) button:enabled", MEMORY),
    "parameters": Ability("#panel-parameters input", OTHER_FUTURE, "#tab-parameters", "90"),
    "behaviours": Ability("#behaviour", OTHER_FUTURE, "#tab-run", "never"),
    "move and add obstacles, pick up the robot": Ability("#add-bar", "octet.scene.environment.bars.length"),
    "plants": Ability("#add-plant", "(octet.scene.environment.plants ?? []).length"),
    "faults of the body": Ability("#break", "octet.scene.lastNews", "#tab-run"),
    "a program of your own": Ability("#program-run", "octet.lanes.length", "#tab-program"),
    "talk": Ability("#talk-line", "document.querySelector('#talk-said').children.length", "#tab-talk", "Why?"),
    "curves": Ability("#curve", "document.querySelector('#results').rows.length", "#tab-curves", "meals"),
    "the atlas": Ability("#atlas-map", "octet.lanes.length", "#tab-atlas"),
    "lessons": Ability("#begin-lesson", "octet.course.begun", "#tab-lessons"),
}


def table() -> dict[str, dict[str, str]]:
    """The cells of the table, by ability and source."""
    text = (ROOT / "docs/page.md").read_text().partition("## What each source can do")[2].partition("\n## ")[0]
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in re.findall(r"^\|.*\|$", text, re.M)]
    found = {name: dict(zip(SOURCES, cells, strict=True)) for names, *cells in rows[2:] for name in names.split("; ")}
    return dict(sorted(found.items(), key=lambda it: [*ABILITIES].index(it[0])))


@pytest.fixture(scope="module")
def replay(tmp_path_factory) -> Path:
    """The page of a recorded run, with its firmware."""
    out = tmp_path_factory.mktemp("abilities")
    words = ("--environments", "1", "--limit-s", "30", "--quiet", "--out", out)
    assert octet("run", "--bus", "none", *words).returncode in (0, 1)
    assert octet("replay", out / "run.log", "--html", out / "page.html", "--what-if").returncode == 0
    return out / "page.html"


@pytest.fixture
def source(replay: Path, watch, open_page, tmp_path) -> Callable[[str], Page]:
    """Opens the page of a run from a source."""

    def show(name: str) -> Page:
        if name == "simulated":
            page = open_page(page_file(tmp_path).as_uri(), ready=LAB_READY, reduced_motion="reduce")
            wait_for(page, SIMULATED)
            return page
        page = open_page(replay.as_uri() if name == "recorded" else watch("--seed", "2").url)
        wait_for(page, "!octet.live || octet.tick > 60")
        return page

    return show


def test_table_lists_all_abilities_and_how_each_is_reached():
    assert set(table()) == set(ABILITIES)
    assert {cell for row in table().values() for cell in row.values()} <= {DIRECT, WHAT_IF}


@pytest.mark.parametrize("name", SOURCES)
def test_abilities_in_the_table_work_on_the_page_of_each_source(source, name):
    page = source(name)

    for ability, cells in table().items():
        if name == "live" and not page.evaluate("Boolean(octet.live)"):
            page.click("#back")
            wait_for(page, "octet.live")
        assert ABILITIES[ability].does(page), ability
        if cells[name] == WHAT_IF:
            wait_for(page, "octet.lanes.length > 1")
        elif name == "live" and cells["recorded"] == WHAT_IF:
            assert page.evaluate("Boolean(octet.live)"), ability  # the run itself was changed
