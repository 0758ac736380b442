"""What the tests of octet.html share: what to wait for, and how to move about in it."""

from pathlib import Path

from playwright.sync_api import Page

from host_sim.talk.languages import languages
from tests.web.support import next_frame, wait_for

LESSONS = tuple(languages()["en"]["lessons"]["lessons"])

READY = "window.octet?.scene?.state && octet.last > 0"
DONE = "document.querySelector('#status')?.textContent === 'the real firmware, in this page'"
REACHED = "[...document.querySelectorAll('#goals li')].map((goal) => goal.classList.contains('reached'))"
SIZES = [(1024, 768), (1366, 657), (1440, 900), (1920, 1080)]


def simulated(page: Page) -> None:
    """Waits until every run is simulated as it was changed."""
    wait_for(page, "octet.simulator.running === undefined && octet.simulator.queued.size === 0")


def saved(page: Page, button: str) -> bytes:
    with page.expect_download() as download:
        page.evaluate("id => document.querySelector(id).click()", button)
    return Path(download.value.path()).read_bytes()


def go(page: Page, tick: int) -> None:
    """Drags the strip below the arena, to its end at most."""
    page.locator("#scrub").fill(str(min(tick, page.evaluate("octet.last"))))
    settle(page)


def go_on(page: Page, ticks: int) -> None:
    go(page, page.evaluate("octet.tick") + ticks)


def go_to_the_end(page: Page) -> None:
    settle(page)
    go(page, page.evaluate("octet.last"))


def settle(page: Page) -> None:
    """Waits until what changed is simulated and shown."""
    simulated(page)
    next_frame(page)


def go_to_step(page: Page, number: int) -> None:
    """Presses the number of a step, counted from 1; its tools are in it."""
    page.click(f"#step .head button:nth-of-type({number})")
    settle(page)


def ticked(page: Page) -> list[int]:
    """The steps that are done, counted from 1."""
    marks = page.locator("#step .head button").all_inner_texts()
    return [place for place, mark in enumerate(marks, 1) if "✓" in mark]


def reached(page: Page) -> list[bool]:
    return page.evaluate(REACHED)


def write(page: Page, program: list[int]) -> None:
    """Presses each cell until it has its turn: 1 left, 2 right."""
    for cell, side in enumerate(program, 1):
        for _ in range(side):
            page.click(f"#cells li:nth-child({cell + 1}) button")
            settle(page)
