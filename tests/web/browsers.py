"""The browsers that the pages are tried in: Debian's own, each driven by Playwright."""

import shutil
from collections.abc import Iterator
from contextlib import contextmanager

import pytest
from playwright.sync_api import Browser, sync_playwright

CHROMIUM, FIREFOX = "chromium", "firefox"
BROWSERS = (CHROMIUM, FIREFOX)
# Where there is no graphics card, to do as if there was one takes time.
_CHROMIUM_ARGUMENTS = ["--no-sandbox", "--disable-gpu", "--disable-gpu-rasterization"]
_PROGRAMS = {CHROMIUM: "chromium-headless-shell", FIREFOX: "firefox-esr"}


@contextmanager
def launched(name: str) -> Iterator[Browser]:
    """One of `BROWSERS`, without a window. Meanwhile no other test in this process can run an event loop."""
    program = shutil.which(_PROGRAMS[name])
    if program is None:
        pytest.skip(f"{name}: {_PROGRAMS[name]} is missing")
    with sync_playwright() as playwright:
        if name == CHROMIUM:
            browser = playwright.chromium.launch(executable_path=program, args=_CHROMIUM_ARGUMENTS)
        else:
            # By WebDriver BiDi: without a channel, Playwright speaks a protocol that only its own Firefox knows.
            browser = playwright.firefox.launch(executable_path=program, channel="moz-firefox")
        yield browser
        browser.close()
