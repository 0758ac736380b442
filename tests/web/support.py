"""A run that is watched, and pages that watch it in a real browser."""

import json
import re
import signal
import subprocess
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from playwright.sync_api import Frame, Page

from host_sim.protocol.codec import DecodedFrame, Protocol
from host_sim.recording.log_reader import read_log
from tests.runs.support import ROOT, data_in, start_octet

READY = "window.octet?.scene?.state"
"""Whether a page shows a run."""

SCREENS = ROOT / "build/reports/screens"
DEADLINE_S = 120.0
"""How long a test waits for a page or a server before it fails; a busy machine may take much of it."""


@dataclass
class Watched:
    """A run that goes on, and its page's address."""

    process: subprocess.Popen
    url: str
    out: Path

    def end(self) -> int:
        """Ctrl-C; returns the exit code."""
        self.process.send_signal(signal.SIGINT)
        return self.process.wait(DEADLINE_S)

    def commands(self) -> list[dict[str, int]]:
        """The COMMAND frames of the ended run, decoded."""
        return [said.signals for said in self.said() if said.name == "COMMAND"]

    def said(self) -> list[DecodedFrame]:
        protocol = Protocol()
        return [said for line in read_log(self.out / "run.log") if (said := protocol.decode(line.frame))]

    def params(self) -> dict[str, Any]:
        return json.loads((self.out / "run.world.json").read_text())

    def summary(self) -> dict[str, Any]:
        return json.loads((self.out / "summary.json").read_text())


def start_watched(out: Path, *words: str) -> Watched:
    """Starts a run that people can watch, on a port of its own, and waits until it serves."""
    process = start_octet("watch", "--bus", "none", "--port", "0", "--out", out, *words)
    give_up = threading.Timer(DEADLINE_S, process.kill)
    give_up.start()
    try:
        return Watched(process, _address(process), out)
    except AssertionError:
        process.communicate()
        raise
    finally:
        give_up.cancel()


def _address(process: subprocess.Popen) -> str:
    assert process.stdout is not None
    assert process.stderr is not None
    for line in process.stdout:
        if match := re.search(r"http://\S+", line):
            return match[0]
    raise AssertionError(f"the run does not serve: {process.stderr.read()}")


@dataclass
class Faults:
    """What a page must not do: complain, or ask anyone but its server."""

    home: str
    seen: list[str] = field(default_factory=list)

    def listen(self, page: Page) -> None:
        page.on("console", lambda message: self._console(message.type, message.text))
        page.on("pageerror", lambda error: self.seen.append(f"error: {error}"))
        page.on("request", lambda request: self._request(request.url))
        page.on("websocket", lambda socket: self._request(socket.url.replace("ws:", "http:")))

    def _console(self, kind: str, text: str) -> None:
        # Reading pixels is the tests' own doing, and so is the end of a server that a page tries to reach again.
        if kind in ("error", "warning") and not re.search(
            "getImageData|ERR_CONNECTION_REFUSED|ERR_INTERNET_DISCONNECTED|response code: 403", text
        ):
            self.seen.append(f"console {kind}: {text}")

    def _request(self, url: str) -> None:
        if not url.startswith((self.home, "data:", "blob:")):
            self.seen.append(f"request: {url}")


def run_in(page: Path) -> dict[str, Any]:
    """The run in the page of a recorded run, but for its title."""
    return {**data_in(page.read_text(), "run"), "title": None}


def state(page: Page) -> dict[str, Any]:
    """The state that the page shows."""
    return page.evaluate("octet.scene.state")


# The page asks itself: a question from Python takes 5 ms of processor time. Playwright's own wait needs `eval`.
_WAIT = """async ([argument, deadline]) => {
  for (const began = performance.now(); ; await new Promise((resolve) => setTimeout(resolve, 10))) {
    const found = CONDITION;
    if (typeof found === "function" ? found(argument) : found) return true;
    if (performance.now() - began > deadline) return false;
  }
}"""


def wait_for(page: Page | Frame, condition: str, argument: Any = None) -> None:
    """Waits until an expression, or a function of the argument, is true on a page."""
    found = page.evaluate(_WAIT.replace("CONDITION", condition), [argument, DEADLINE_S * 1000])
    assert found, f"timed out waiting for: {condition}"


def next_frame(page: Page) -> None:
    """Waits until what the page knows by now is laid out and drawn."""
    page.evaluate("new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)))")


def wait_for_text(page: Page, selector: str, text: str) -> None:
    """Waits until an element says something; what is known is shown with the next frame only."""
    wait_for(page, "([where, text]) => document.querySelector(where).innerText.includes(text)", [selector, text])


def pause(page: Page) -> None:
    page.click("#play")
    wait_for(page, "!octet.play.playing")


def full_speed(page: Page) -> None:
    page.select_option("#speed", "0")
    wait_for(page, "octet.play.speed === 0")


def place_on_page(page: Page, x: float, y: float) -> tuple[float, float]:
    """Where a place of the arena is on the page."""
    box = page.locator(".lane canvas").first.bounding_box()
    assert box is not None
    per_mm = box["width"] / (4000 + 80)
    return box["x"] + (x + 40) * per_mm, box["y"] + (y + 40) * per_mm


def drag(page: Page, start: tuple[float, float], end: tuple[float, float]) -> None:
    """Drags from one place of the arena to another."""
    page.mouse.move(*place_on_page(page, *start))
    page.mouse.down()
    page.mouse.move(*place_on_page(page, *end), steps=8)
    page.mouse.up()


def eventually(is_so: Callable[[], bool], what: str) -> None:
    """Waits for something outside of the browser."""
    give_up = time.monotonic() + DEADLINE_S
    while not is_so():
        assert time.monotonic() < give_up, f"timed out waiting for: {what}"
        time.sleep(0.02)
