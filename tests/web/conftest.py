"""Chromium, runs to watch, and pages that are held to their manners."""

import signal
from collections.abc import Callable, Iterator
from pathlib import Path
from urllib.parse import urldefrag, urljoin

import pytest
from playwright.sync_api import Browser, Page, Playwright, sync_playwright

from tests.runs.support import octet, start_octet
from tests.web.browsers import CHROMIUM, launch
from tests.web.support import DEADLINE_S, READY, Faults, Watched, next_frame, start_watched, wait_for


@pytest.fixture(scope="session")
def playwright() -> Iterator[Playwright]:
    with sync_playwright() as playwright:
        yield playwright


@pytest.fixture(scope="session")
def browser(playwright: Playwright) -> Iterator[Browser]:
    with launch(playwright, CHROMIUM) as browser:
        yield browser


@pytest.fixture
def watch(tmp_path: Path) -> Iterator[Callable[..., Watched]]:
    """Starts runs to watch; ends what is left of them."""
    started = []

    def start(*words: str) -> Watched:
        started.append(start_watched(tmp_path / f"run{len(started)}", *words))
        return started[-1]

    yield start
    for watched in started:
        watched.process.kill()
        watched.process.communicate()


@pytest.fixture
def hold_class(tmp_path: Path) -> Iterator[Callable[..., tuple[str, str]]]:
    """Begins classes; returns the addresses of a class's page and of its board."""
    begun = []

    def begin(*words: str) -> tuple[str, str]:
        file = tmp_path / "class.json"
        begun.append(start_octet("class", "--listen", "127.0.0.1", "--port", "0", "--file", file, *words))
        lines = {}
        for line in begun[-1].stdout:
            word, _, rest = line.partition(" ")
            lines[word] = rest.strip().partition(" ")[0]
            if word == "ends":
                return lines["class"], lines["board"]
        raise AssertionError(f"the class does not begin: {begun[-1].stderr.read()}")

    yield begin
    for process in begun:
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=DEADLINE_S)


@pytest.fixture(scope="module")
def module_watch(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Watched]:
    """A run to watch, for all tests of a module that only ask its server."""
    watched = start_watched(tmp_path_factory.mktemp("watched") / "run")
    yield watched
    watched.process.kill()
    watched.process.communicate()


def pages(browser: Browser) -> Iterator[Callable[..., Page]]:
    """Opens pages in fresh profiles; none may complain or ask anyone but its own server."""
    opened = []

    def open_one(url: str, ready: str = READY, prepare: Callable[[Page], object] = lambda _: None, **context) -> Page:
        faults = Faults(urljoin(url, "/") if url.startswith("http") else urldefrag(url).url)
        page = browser.new_context(**context).new_page()
        page.set_default_timeout(DEADLINE_S * 1000)
        opened.append((page, faults))
        faults.listen(page)
        prepare(page)
        page.goto(url)
        wait_for(page, ready)
        next_frame(page)
        return page

    yield open_one
    for page, faults in opened:
        page.context.close()
        assert faults.seen == []


open_page = pytest.fixture(pages, name="open_page")
open_shared = pytest.fixture(pages, scope="module", name="open_shared")  # for pages that several tests look at


@pytest.fixture(scope="session")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The page of a run of two environments."""
    out = tmp_path_factory.mktemp("recorded")
    assert octet("run", "--bus", "none", "--environments", "2", "--quiet", "--out", out).returncode == 0
    return out / "replay.html"
