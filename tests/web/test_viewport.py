"""An arena is zoomed and moved by wheel, pointer, keys and buttons, and can follow its robot."""

from collections.abc import Callable
from pathlib import Path

import pytest
from playwright.sync_api import Page

from tests.web.support import next_frame

AT = """([x, y]) => {
  const place = octet.lane.renderer.placeOf({ clientX: x, clientY: y });
  return [place.x, place.y];
}"""

SEVERAL = """([type, ...each]) => {
  const canvas = document.querySelector(".lane canvas");
  const box = canvas.getBoundingClientRect();
  const [clientX, clientY] = [box.x + 0.4 * box.width, box.y + 0.6 * box.height];
  const make = { keydown: (key) => new KeyboardEvent(type, { key, bubbles: true }),
                 wheel: (deltaY) => new WheelEvent(type, { deltaY, clientX, clientY, bubbles: true }) }[type];
  for (const it of each) canvas.dispatchEvent(make(it));
}"""
"""Events of one type in the arena, all before the next drawing."""


@pytest.fixture
def page(recorded: Path, open_page: Callable[..., Page]) -> Page:
    return open_page(recorded.as_uri())


def at(page: Page, x: float, y: float) -> list[float]:
    """The place in the arena at a part of its picture, mm."""
    next_frame(page)
    box = page.locator(".lane canvas").bounding_box()
    return page.evaluate(AT, [box["x"] + x * box["width"], box["y"] + y * box["height"]])


def point(page: Page, x: float, y: float) -> None:
    box = page.locator(".lane canvas").bounding_box()
    page.mouse.move(box["x"] + x * box["width"], box["y"] + y * box["height"])


def test_wheel_zooms_at_the_pointer(page):
    before, corner = at(page, 0.4, 0.6), at(page, 0, 0)
    point(page, 0.4, 0.6)
    page.mouse.wheel(0, -300)

    assert at(page, 0.4, 0.6) == pytest.approx(before, abs=3)
    assert at(page, 0, 0)[0] > corner[0] + 500
    page.mouse.wheel(0, 3000)
    assert at(page, 0, 0) == corner


def test_pointer_and_arrow_keys_move_the_view(page):
    page.click("#zoom-in")
    page.click("#zoom-in")
    before = at(page, 0.5, 0.5)
    point(page, 0.5, 0.5)
    page.mouse.down()
    point(page, 0.6, 0.7)
    page.mouse.up()
    assert at(page, 0.6, 0.7) == pytest.approx(before, abs=3)

    tick, before = page.evaluate("octet.tick"), at(page, 0.5, 0.5)
    page.focus(".lane canvas")
    page.keyboard.press("ArrowRight")
    page.keyboard.press("ArrowDown")
    x, y = at(page, 0.5, 0.5)
    assert (x > before[0] + 100, y > before[1] + 100) == (True, True)
    assert page.evaluate("octet.tick") == tick


def test_pointer_released_outside_the_arena_moves_nothing_later(page):
    point(page, 0.3, 0.02)
    page.mouse.down()
    page.mouse.move(2, 2)
    page.mouse.up()
    page.click("#zoom-in")
    before = at(page, 0.5, 0.5)

    point(page, 0.4, 0.4)
    point(page, 0.6, 0.7)

    assert at(page, 0.5, 0.5) == before


def test_events_before_the_next_drawing_are_not_lost(page):
    page.click("#zoom-in")
    before = at(page, 0.5, 0.5)
    page.evaluate(SEVERAL, ["keydown", "ArrowRight", "ArrowDown"])
    x, y = at(page, 0.5, 0.5)
    assert (x > before[0] + 100, y > before[1] + 100) == (True, True)

    before = at(page, 0.4, 0.6)
    page.evaluate(SEVERAL, ["wheel", -100, -100])
    assert at(page, 0.4, 0.6) == pytest.approx(before, abs=3)


def test_view_follows_the_robot_within_the_walls_until_zoomed_out(page):
    page.keyboard.press("f")
    page.keyboard.press("+")
    assert page.get_attribute("#follow", "aria-pressed") == "true"
    for tick in (200, 900):
        page.evaluate("tick => octet.go(tick)", tick)
        (x0, y0), (x1, y1) = at(page, 0, 0), at(page, 1, 1)
        robot = page.evaluate("[octet.scene.state.x, octet.scene.state.y]")
        assert x0 < robot[0] < x1
        assert y0 < robot[1] < y1
        assert min(x0, y0) >= -41
    for _ in range(6):
        page.keyboard.press("-")

    assert page.get_attribute("#follow", "aria-pressed") == "false"
    assert page.is_disabled("#zoom-out")
    assert at(page, 0, 0) == pytest.approx([-40, -40], abs=1)


def test_two_fingers_zoom(recorded, open_page):
    page = open_page(recorded.as_uri(), has_touch=True, viewport={"width": 390, "height": 844})
    fingers = page.context.new_cdp_session(page)
    box = page.locator(".lane canvas").bounding_box()

    def touch(kind: str, apart: float) -> None:
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        points = [{"x": x - apart, "y": y, "id": 0}, {"x": x + apart, "y": y, "id": 1}]
        fingers.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points if apart else []})

    for kind, apart in (("touchStart", 30), ("touchMove", 45), ("touchMove", 60), ("touchEnd", 0)):
        touch(kind, apart)

    assert page.evaluate("octet.viewport.zoom") == pytest.approx(2, abs=0.3)


FIRST_LOOK = """() => {
  const canvas = document.createElement("canvas");
  document.body.append(canvas);
  const { context, palette } = new octet.lane.renderer.constructor(canvas);
  const [r, g, b] = context.getImageData(150, 75, 1, 1).data;
  return [`#${[r, g, b].map((part) => part.toString(16).padStart(2, "0")).join("")}`, palette.of.floor];
}"""


def test_arena_has_the_colour_of_its_floor_before_there_is_a_run(page):
    shown, floor = page.evaluate(FIRST_LOOK)

    assert shown == floor
