"""octet.html with an emulated Pico: its image says the same as the page's robot, or the page says what differs."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest
from playwright.sync_api import Page

from host_sim.base.errors import OctetError
from host_sim.base.paths import PAGE_SCRIPTS, image_path
from host_sim.report import octet_page as octet_page_module
from host_sim.report.octet_page import octet_page, write_octet_page
from tests.runs.support import octet
from tests.web.lab.support import READY
from tests.web.support import wait_for

TICKS = 400
MORE_MAX = 100_000
MULTIPLIER = (0x21F0AAAD).to_bytes(4, "little")
"""Of the random numbers."""


def image() -> bytes:
    return image_path("pico", "slcan").with_suffix(".bin").read_bytes()


@pytest.fixture
def open_pico(tmp_path: Path, open_page: Callable[..., Page]) -> Callable[..., Page]:
    """Opens a page with an image, in which the Pico runs."""

    def opened(flash: bytes, **context: str) -> Page:
        write_octet_page(tmp_path / "octet.html", flash)
        page = open_page((tmp_path / "octet.html").as_uri(), ready=READY, reduced_motion="reduce", **context)
        page.click("#run-pico")
        return page

    return opened


def test_pico_sends_the_same_frames_for_400_ticks_and_when_run_again(open_pico):
    page = open_pico(image())
    for _ in range(2):
        wait_for(page, "ticks => pico.progress?.ticks >= ticks || pico.progress?.differs", TICKS)
        page.click("#run-pico")
        found = page.evaluate("pico.progress")
        shown = [row.split("\t") for row in page.locator("#panel-run tbody tr").all_inner_texts()]

        assert found["equal"] == found["frames"] > found["ticks"] >= TICKS
        assert page.inner_text("#pico-verdict").startswith(f"{found['equal']} of {found['frames']} frames equal in")
        assert [row[2] for row in shown] == [row[3] for row in shown] != []

        assert page.evaluate("(document.querySelector('#run-pico').click(), pico.progress)") is None


def test_image_with_another_constant_differs_in_a_named_tick(open_pico):
    assert image().count(MULTIPLIER) == 1
    page = open_pico(image().replace(MULTIPLIER, bytes([MULTIPLIER[0] ^ 2]) + MULTIPLIER[1:]))

    wait_for(page, "pico.progress?.done")

    found = page.evaluate("pico.progress")
    assert found["equal"] < found["frames"]
    assert [it for it in found["differs"] if it["page"] != it["pico"]] != []
    assert {it["tick"] for it in found["differs"]} == {found["ticks"] - 1}
    assert page.inner_text("#pico-verdict").startswith(f"The Pico differs in tick {found['ticks'] - 1}. ")


def test_image_that_does_not_start_is_reported(open_pico):
    page = open_pico(bytes([image()[0] ^ 1]) + image()[1:])

    wait_for(page, "document.querySelector('#pico-verdict').innerText.includes('second stage has a wrong checksum')")


def test_pico_does_not_run_for_a_robot_with_a_program(open_pico):
    page = open_pico(image(), locale="de")
    page.click("#run-pico")
    page.evaluate("octet.setUp({ program: '10 END' })")
    page.click("#run-pico")

    wait_for(
        page, "document.querySelector('#pico-verdict').innerText.startsWith('Roboter 1 führt dein Programm aus')"
    )


def test_pico_adds_less_than_100_kb_and_only_with_its_option(file, tmp_path):
    done = octet("page", "--pico", tmp_path / "pico.html")

    assert (done.returncode, done.stderr) == (0, "")
    assert (tmp_path / "pico.html").stat().st_size < file.stat().st_size + MORE_MAX
    assert "pico-verdict" not in octet_page()


def test_pico_scripts_have_the_rp2040js_licence_and_no_network_address():
    scripts = [(PAGE_SCRIPTS / name).read_text() for name in ("octet_pico.js", "pico_worker.js")]

    for text in scripts:
        assert "Copyright (c) 2021 Uri Shaked" in text
        assert "The above copyright notice and this permission notice shall be included" in text
        assert re.findall(r"\b(?:https?|wss?)://\w+", text.replace("http://www.w3.org/", "")) == []


def test_pico_page_names_missing_rp2040js(monkeypatch, tmp_path):
    monkeypatch.setattr(octet_page_module, "PAGE_SCRIPTS", tmp_path)

    with pytest.raises(OctetError, match="needs rp2040js, which is not installed: run tools/setup pico"):
        write_octet_page(tmp_path / "octet.html", image())
