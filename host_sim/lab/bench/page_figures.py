"""Speed of the pages in a real browser: drawing, cost of watching, start of a recorded page.

`tools/setup tests` installs the browser.
"""

import json
import os
import re
import statistics
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

from playwright.sync_api import Browser, Page, sync_playwright

from host_sim.base.errors import OctetError
from host_sim.lab.bench.figure import Figure, Value, cost, rate

_CHROMIUM = "/usr/bin/chromium-headless-shell"
_READY = "window.octet?.scene?.state"
_WIDTH, _HEIGHT = 1280, 800
_FRAMES, _SCREEN_MS = 200, 1000.0 / 60.0
_WATCHED_ENVIRONMENTS = 150  # some 5 s at full speed, so that opening the page matters little
_TIMEOUT_S = 30.0
_LOOK_PAUSE_S = 0.01  # polling without a pause would take half a core from the measured run
# Reading a pixel makes the browser finish the drawing.
TIME_DRAWING = """() => {
    const draw = octet.lane.renderer.draw.bind(octet.lane.renderer);
    octet.times = [];
    octet.lane.renderer.draw = (scene) => {
        const began = performance.now();
        draw(scene);
        octet.lane.renderer.context.getImageData(0, 0, 1, 1);
        octet.times.push(performance.now() - began);
    };
}"""


def page_figures() -> list[Figure]:
    """The rows of the pages."""
    with sync_playwright() as playwright, TemporaryDirectory() as name:
        browser, folder = playwright.chromium.launch(executable_path=_CHROMIUM, args=["--no-sandbox"]), Path(name)
        try:
            drawing = Value("drawing one frame, median", partial(_drawing_ms, browser, folder))
            watched = Value("a run at full speed with a page", partial(_watched_ticks_per_second, browser, folder))
            unwatched = Value("without a page", partial(_watched_ticks_per_second, None, folder))
            recorded = Value("a recorded page, to its first picture", partial(_first_picture_ms, browser, folder))
            return [
                cost(drawing, Value("a frame of the screen", lambda: _SCREEN_MS), 0.25),
                rate(watched, unwatched, 0.9),
                cost(recorded, Value("an empty page", partial(_empty_page_ms, browser)), 20),
            ]
        finally:
            browser.close()


@contextmanager
def _watched_run(folder: Path, *words: str) -> Iterator[tuple[subprocess.Popen[str], str]]:
    """Starts a run that serves a page; yields its process and the page's address."""
    command = [sys.executable, "-m", "host_sim", *words, "--bus", "none", "--port", "0", "--out", os.fspath(folder)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        try:
            address = next(match[0] for line in process.stdout if (match := re.search(r"http://\S+", line)))
            yield process, address
        finally:
            process.terminate()


def _wait_for(page: Page, expression: str) -> None:
    """Waits for an expression by polling, since the page's content security policy forbids evaluation in the page."""
    give_up = time.monotonic() + _TIMEOUT_S
    while not page.evaluate(f"Boolean({expression})"):
        if time.monotonic() > give_up:
            raise OctetError(f"on the page, {expression} did not become true within {_TIMEOUT_S:g} s")
        time.sleep(_LOOK_PAUSE_S)


def _open(browser: Browser, address: str, ready: str = _READY) -> Page:
    page = browser.new_page(viewport={"width": _WIDTH, "height": _HEIGHT})
    page.goto(address)
    _wait_for(page, ready)
    return page


def _drawing_ms(browser: Browser, folder: Path) -> float:
    with _watched_run(folder, "watch", "--environments", "100") as (_, address):
        page = _open(browser, address)
        page.evaluate(TIME_DRAWING)
        _wait_for(page, f"octet.times.length > {_FRAMES}")
        drawing_ms = float(statistics.median(page.evaluate("octet.times")))
        page.close()
    return drawing_ms


def _watched_ticks_per_second(browser: Browser | None, folder: Path) -> float:
    """Ticks per second of a run at full speed that serves a page, open in the browser if one is given."""
    words = ("run", "--watch", "--environments", str(_WATCHED_ENVIRONMENTS))
    with _watched_run(folder, *words) as (process, address):
        page = None if browser is None else _open(browser, address)
        assert process.stdout is not None
        process.stdout.read()
        if page is not None:
            page.close()
    summary = json.loads((folder / "summary.json").read_text())
    ticks = sum(entry["ticks"] for entry in summary["environments"])
    return float(ticks / summary["wall_s"])


def _first_picture_ms(browser: Browser, folder: Path) -> float:
    return _opening_ms(browser, (folder / "replay.html").as_uri(), _READY)


def _empty_page_ms(browser: Browser) -> float:
    return _opening_ms(browser, "about:blank", "document.body")


def _opening_ms(browser: Browser, address: str, ready: str) -> float:
    began = time.perf_counter()
    page = _open(browser, address, ready)
    taken_ms = (time.perf_counter() - began) * 1e3
    page.close()
    return taken_ms
