"""How soon a changed run of ten robot minutes shows its new future: `python -m tests.web.replay.what_if_speed`."""

import sys
import time
from pathlib import Path
from tempfile import TemporaryDirectory

from playwright.sync_api import Page

from tests.runs.support import octet
from tests.web.browsers import CHROMIUM, launched
from tests.web.replay.test_replay_what_if import COPIED
from tests.web.support import READY, wait_for

_WORDS = ("--environments", "8", "--limit-s", "120", "--seed", "1", "--profile", "never", "--quiet")
_CHANGE = """async (cell) => {
  const began = performance.now();
  octet.change({ do: "write", robot: 0, cell, side: 1 });
  await octet.lane.done;
  await new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
  return performance.now() - began;
}"""
"""The time from a change to the picture of its future, ms."""


def main() -> int:
    with TemporaryDirectory() as folder, launched(CHROMIUM) as browser:
        out = Path(folder)
        octet("run", "--bus", "none", "--out", out, *_WORDS)
        octet("replay", out / "run.log", "--html", out / "page.html", "--what-if")
        page = browser.new_page()
        page.goto((out / "page.html").as_uri())
        wait_for(page, READY)
        _measure(page)
    return 0


def _measure(page: Page) -> None:
    ticks = page.evaluate("octet.last + 1")
    began = time.monotonic()
    page.click("#what-if")
    wait_for(page, COPIED)
    opened_s = time.monotonic() - began
    times = []
    for cell, share in enumerate((0.0, 0.25, 0.5, 0.75, 0.99), start=1):
        page.evaluate("tick => octet.go(tick)", int(share * ticks))
        times.append(page.evaluate(_CHANGE, cell))
    words = ", ".join(f"{ms:.0f}" for ms in times)
    sys.stdout.write(f"{ticks} ticks: the copy is there in {opened_s:.2f} s; new futures after {words} ms\n")


if __name__ == "__main__":
    sys.exit(main())
