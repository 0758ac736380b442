"""The browsers that the pages are tried in: Debian's own, each driven by Playwright."""

import shutil
from collections.abc import Iterator
from contextlib import contextmanager

from playwright.sync_api import Browser, Playwright, sync_playwright

CHROMIUM, FIREFOX = "chromium", "firefox"
BROWSERS = (CHROMIUM, FIREFOX)
# Where there is no graphics card, to do as if there was one takes time.
_CHROMIUM_ARGUMENTS = ["--no-sandbox", "--disable-gpu", "--disable-gpu-rasterization"]
_PROGRAMS = {CHROMIUM: "chromium-headless-shell", FIREFOX: "firefox-esr"}


def launch(playwright: Playwright, name: str) -> Browser:
    """One of `BROWSERS`, without a window.

    Raises:
        FileNotFoundError: It is not installed, which fails a test: `tools/setup browsers` installs both.
    """
    program = shutil.which(_PROGRAMS[name])
    if program is None:
        raise FileNotFoundError(f"{_PROGRAMS[name]} is missing: run tools/setup browsers")
    if name == CHROMIUM:
        return playwright.chromium.launch(executable_path=program, args=_CHROMIUM_ARGUMENTS)
    # By WebDriver BiDi: without a channel, Playwright speaks a protocol that only its own Firefox knows.
    return playwright.firefox.launch(executable_path=program, channel="moz-firefox")


@contextmanager
def launched(name: str) -> Iterator[Browser]:
    """One of `BROWSERS`, for a program of its own."""
    with sync_playwright() as playwright, launch(playwright, name) as browser:
        yield browser
