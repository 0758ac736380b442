"""How a page looks, as a machine can tell: what is in view, what fingers can hit, what can be read.

Screenshots are for people to look at.
"""

from collections.abc import Sequence

from axe_playwright_python.base import AXE_SCRIPT
from playwright.sync_api import Page

from tests.web.support import SCREENS, next_frame, wait_for

DESKTOPS = [(1024, 768), (1280, 720), (1366, 657), (1440, 900), (1920, 1080)]
PHONES = [(390, 844), (844, 390)]
SCHEMES = ("light", "dark")
THREE_SIZES = [(390, 844), (1024, 768), (1920, 1080)]
# The arena's least size at each size of the window, CSS px.
ARENA = {(1366, 657): (720, 540), (1920, 1000): (1150, 860), (1024, 768): (600, 450), (390, 844): (390, 290)}
TOO_SMALL = """() => [...document.querySelectorAll("button, select, input, summary")]
  .map((element) => element.closest("label.check") ?? element)
  .filter((element) => element.checkVisibility())
  .map((element) => [element.id || element.textContent, element.getBoundingClientRect()])
  .filter(([, { width, height }]) => width < 44 || height < 44)
  .map(([name, { width, height }]) => `${name}: ${width} x ${height}`)"""

# The contrast of every text with what lies behind it, as WCAG 2 works it out; the least, with its element.
LEAST_CONTRAST = """() => {
  const channel = (c) => (c /= 255) <= 0.03928 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
  const light = ([r, g, b]) => 0.2126 * channel(r) + 0.7152 * channel(g) + 0.0722 * channel(b);
  const parse = (colour) => colour.match(/[\\d.]+/g).map(Number);
  const behind = (element) => {
    for (let e = element; e; e = e.parentElement) {
      const colour = parse(getComputedStyle(e).backgroundColor);
      if (colour.length === 3 || colour[3] === 1) return colour;
    }
    return [255, 255, 255];
  };
  const texts = [...document.querySelectorAll("body *")].filter((e) => e.checkVisibility() && !e.disabled &&
    [...e.childNodes].some((n) => n.nodeType === 3 && n.textContent.trim()));
  return texts.map((e) => {
    const [a, b] = [light(parse(getComputedStyle(e).color)), light(behind(e))];
    return [(Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05), e.id || e.className || e.tagName];
  }).sort((p, q) => p[0] - q[0])[0];
}"""

# The share of the window's squares of 24 px that no line of text, picture, table cell or control touches.
BLANK = """(side) => {
  const things = [...document.querySelectorAll("canvas, svg, button, select, input, td")];
  const boxes = things.filter((e) => e.checkVisibility()).map((e) => e.getBoundingClientRect());
  const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let text; (text = texts.nextNode()); ) {
    const range = document.createRange();
    range.selectNodeContents(text);
    if (text.textContent.trim() && text.parentElement.checkVisibility()) boxes.push(...range.getClientRects());
  }
  const [across, down] = [innerWidth, innerHeight].map((px) => Math.floor(px / side));
  const touched = (x, y) => boxes.some((b) => b.left < x + side && b.right > x && b.top < y + side && b.bottom > y);
  const places = Array.from({ length: across * down }, (_, i) => [i % across, Math.floor(i / across)]);
  return places.filter(([x, y]) => !touched(x * side, y * side)).length / places.length;
}"""

# What lies over the middle or over a corner of an arena, each 30 px inside of it.
COVERED = """() => [...document.querySelectorAll(".lane canvas")].flatMap((canvas) => {
  const { x, y, width, height } = canvas.getBoundingClientRect();
  return [[30, 30], [width - 30, 30], [30, height - 30], [width - 30, height - 30], [width / 2, height / 2]]
    .map(([right, down]) => document.elementFromPoint(x + right, y + down)).filter((it) => it !== canvas)
    .map((it) => it?.id || it?.className);
})"""

# The first element of each selector, if it is not shown or not wholly in a window of this size; one call, since
# Firefox takes 0.1 s for each bounding box that is asked for from outside.
OUT_OF_VIEW = """([selectors, [width, height]]) => selectors.flatMap((selector) => {
  const element = document.querySelector(selector);
  if (!element?.checkVisibility()) return [`${selector} is not shown`];
  const { left, top, right, bottom } = element.getBoundingClientRect();
  const isOut = left < 0 || top < 0 || right > width + 0.5 || bottom > height + 0.5;
  return isOut ? [`${selector} ${left},${top} to ${right},${bottom}`] : [];
})"""


def blank(page: Page) -> float:
    """The part of the window in which there is nothing within about 24 px."""
    next_frame(page)
    return page.evaluate(BLANK, 24)


def out_of_view(page: Page, selectors: tuple[str, ...], size: tuple[int, int]) -> list[str]:
    """What is not wholly in the window."""
    return page.evaluate(OUT_OF_VIEW, [list(selectors), list(size)])


def resize(page: Page, size: tuple[int, int]) -> None:
    page.set_viewport_size({"width": size[0], "height": size[1]})
    wait_for(page, "([width, height]) => innerWidth === width && innerHeight === height", list(size))
    next_frame(page)


def too_small(page: Page, bars: dict[tuple[int, int], tuple[int, int]], arena: str) -> list[str]:
    """The sizes at which an arena is smaller than it has to be, or something lies over it."""
    found = []
    for size, (width, height) in bars.items():
        resize(page, size)
        box = page.locator(arena).first.bounding_box()
        assert box is not None
        if box["width"] < width or box["height"] < height or page.evaluate(COVERED):
            found.append(f"{size}: {box} {page.evaluate(COVERED)}")
    return found


def violations(page: Page, rules: str = "") -> list[str]:
    """What axe-core finds: by all of its rules, or by those with a tag."""
    if not page.evaluate("Boolean(window.axe)"):
        page.evaluate(AXE_SCRIPT)
    options = {"resultTypes": ["violations"], **({"runOnly": [rules]} if rules else {})}
    found = page.evaluate("options => axe.run(options).then(({ violations }) => violations)", options)
    return [f"{it['id']}: {it['nodes'][0]['html'][:90]}" for it in found]


def violations_at(page: Page, sizes: Sequence[tuple[int, int]] = THREE_SIZES) -> list[str]:
    """What axe-core finds at some sizes; in the dark at the last one only, where nothing differs but colours."""
    found = []
    before = page.viewport_size
    page.emulate_media(color_scheme="light")
    for size in sizes:
        resize(page, size)
        found += [f"{size}: {it}" for it in violations(page)]
    page.emulate_media(color_scheme="dark")
    found += [f"dark: {it}" for it in violations(page, "cat.color")]
    page.set_viewport_size(before)
    return found


def check(page: Page, name: str) -> None:
    """Takes the picture; nothing sticks out sideways, and every text can be read."""
    SCREENS.mkdir(parents=True, exist_ok=True)
    page.screenshot(path=SCREENS / f"{name}.png", full_page=True)
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    contrast, where = page.evaluate(LEAST_CONTRAST)
    assert contrast >= 4.5, where
