"""Screenshots of the main states, for people to look at, and the checks that a machine can make of them."""

from collections.abc import Callable

import pytest
from playwright.sync_api import Page

from tests.web.fake_run import HOME, FakeRun, robot_state
from tests.web.looks import check
from tests.web.support import next_frame, pause, wait_for

SIZES = {"phone": (390, 844, 2), "laptop": (1280, 800, 1), "projector": (1920, 1080, 1)}
SCHEMES = ("light", "dark")


@pytest.fixture
def look(open_page) -> Callable[..., Page]:
    def open_look(url: str, size: str, **more) -> Page:
        width, height, ratio = SIZES[size]
        viewport = {"width": width, "height": height}
        return open_page(url, viewport=viewport, device_scale_factor=ratio, reduced_motion="reduce", **more)

    return open_look


def check_schemes(page: Page, name: str) -> None:
    for scheme in SCHEMES:
        page.emulate_media(color_scheme=scheme)
        next_frame(page)
        check(page, name.format(scheme))


def test_live_screens_are_readable_and_fit_the_width(watch, look):
    url = watch("--seed", "2").url
    for size in SIZES:
        page = look(url, size)
        wait_for(page, "octet.scene.trail.length > 20")
        if page.evaluate("octet.play.playing"):
            pause(page)
        check_schemes(page, f"live-{{}}-{size}")
        assert page.evaluate("octet.lane.renderer.canvas.width") == page.evaluate(
            "Math.round(octet.lane.renderer.canvas.clientWidth * devicePixelRatio)"
        )


def test_interaction_screen_is_readable_and_fits_the_width(watch, look):
    page = look(watch("--seed", "2").url, "laptop")
    pause(page)
    page.click("#add-bar")
    wait_for(page, "octet.scene.item?.kind === 'bar'")
    page.click("#lift")
    wait_for(page, "octet.scene.ghosts.size === 1")
    page.click("#cells li:nth-child(3) button")
    wait_for(page, "octet.scene.state.memory[2] === 1")
    page.click("#reference summary")
    check(page, "interaction-light-laptop")


def test_replay_screens_are_readable_and_fit_the_width(recorded, look):
    for size in SIZES:
        page = look(recorded.as_uri(), size)
        page.click("#pin")
        page.evaluate("octet.go(Math.floor(octet.last * 0.4))")
        next_frame(page)
        check_schemes(page, f"replay-{{}}-{size}")


def test_screens_of_many_robots_are_readable_and_fit_the_width(look):
    states = [
        robot_state(node, 350 + 470 * (node - 1), 400 + 310 * (node - 1), reason=node - 1) for node in range(1, 9)
    ]
    run = FakeRun(states)
    for size in SIZES:
        page = look(HOME, size, prepare=run.serve)
        run.send(
            trails=[
                [n for step in range(40) for n in (s["x"] + 9 * step, s["y"] - step * step / 4, 1)] for s in states
            ]
        )
        page.keyboard.press("6")
        wait_for(
            page,
            "octet.scene.trail.length > 20 && document.querySelector('#robots [aria-pressed=true]').value === '6'",
        )
        check_schemes(page, f"many-{{}}-{size}")
