"""Every page in every browser: it opens without a complaint and runs, and the robot in it sends the host's bytes."""

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, Playwright

from tests.runs.support import octet
from tests.web.browsers import BROWSERS, launch
from tests.web.sim.page_runs import LOGS, experiment, page_file, words
from tests.web.support import wait_for

WANTED = [experiment(profile, 31, limit_ticks=500) for profile in ("article", "searcher", "distance")]


@pytest.fixture(scope="module", params=BROWSERS)
def browser(request: pytest.FixtureRequest, playwright: Playwright) -> Iterator[Browser]:
    """In place of Chromium alone."""
    with launch(playwright, request.param) as browser:
        yield browser


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return page_file(tmp_path_factory.mktemp("page"))


def test_page_runs_by_itself_and_its_logs_are_those_of_tools_run(file, open_page, tmp_path):
    page = open_page(file.as_uri(), ready="window.octet?.scene?.state && octet.last > 200")
    wait_for(page, "octet.tick > 100")  # it begins by itself

    logs = page.evaluate(LOGS, WANTED)

    for wanted, log in zip(WANTED, logs, strict=True):
        assert octet("run", "--bus", "none", "--quiet", "--out", tmp_path, *words(wanted)).returncode == 0
        assert log == (tmp_path / "run.log").read_text()


def test_recorded_run_plays(recorded: Path, open_page: Callable[..., Page]):
    page = open_page(recorded.as_uri())

    page.select_option("#speed", "16")
    page.click("#play")

    wait_for(page, "octet.tick > 100")


def test_live_run_goes_on_and_can_be_changed(watch, open_page):
    page = open_page(watch("--seed", "1").url)
    wait_for(page, "octet.scene.state.tick > 25")

    page.click("#cells li:nth-child(8) button")

    wait_for(page, "octet.scene.state.memory[7] === 1")
