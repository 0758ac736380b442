"""octet.html in Chromium, as each test wants it."""

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page

from tests.web.lab.support import DONE, READY, SIZES, settle
from tests.web.looks import resize
from tests.web.sim.page_runs import page_file
from tests.web.support import Faults, wait_for

DESKTOP = (1280, 720)
"""Playwright's own size of a page, px."""


@pytest.fixture(scope="session")
def file(tmp_path_factory) -> Path:
    return page_file(tmp_path_factory.mktemp("page"))


@pytest.fixture
def page(file: Path, open_page: Callable[..., Page]) -> Page:
    page = open_page(file.as_uri(), ready=READY, reduced_motion="reduce")
    wait_for(page, DONE)
    return page


@pytest.fixture(scope="module")
def one_page(file: Path, browser: Browser) -> Iterator[Page]:
    """The page of `shared`."""
    page = browser.new_context(reduced_motion="reduce").new_page()
    faults = Faults(file.as_uri())
    faults.listen(page)
    page.goto(file.as_uri())
    wait_for(page, DONE)
    yield page
    page.context.close()
    assert faults.seen == []


@pytest.fixture
def shared(one_page: Page) -> Page:
    """One page for all tests of a module that only look around in it, or begin anew, at its first size again."""
    resize(one_page, DESKTOP)
    return one_page


@pytest.fixture
def lesson(shared: Page) -> Callable[[str], Page]:
    """Chooses a lesson, and begins it."""

    def begin(name: str) -> Page:
        resize(shared, SIZES[2])
        shared.emulate_media(color_scheme="light")
        shared.click("#tab-lessons")
        shared.select_option("#lesson", name)
        shared.click("#begin-lesson")
        wait_for(shared, DONE)
        settle(shared)
        return shared

    return begin
