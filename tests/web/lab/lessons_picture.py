"""Draws the picture of docs/lessons.md: `python -m tests.web.lab.lessons_picture FILE.png`."""

import io
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from PIL import Image

from host_sim.report.octet_page import write_octet_page
from tests.web.browsers import CHROMIUM, launched
from tests.web.lab.support import READY, go, settle
from tests.web.support import wait_for

_SIZE = {"width": 1280, "height": 800}
_TICK = 3000
"""By then several boxes of the robot hold beads."""
_AT_THE_TABLE = 3
"""The steps that need no computer."""


def main(file: Path) -> None:
    with TemporaryDirectory() as folder, launched(CHROMIUM) as browser:
        write_octet_page(Path(folder) / "octet.html")
        page = browser.new_page(viewport=_SIZE, locale="en", reduced_motion="reduce")
        page.goto(f"{(Path(folder) / 'octet.html').as_uri()}#matchboxes")
        wait_for(page, READY)
        page.click("#begin-lesson")
        for _ in range(_AT_THE_TABLE):
            page.click("#step-done")
        settle(page)
        go(page, _TICK)
        shown = Image.open(io.BytesIO(page.screenshot()))
    shown.convert("RGB").quantize(256, Image.Quantize.FASTOCTREE).save(file, optimize=True)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
