"""Changes of the world and the bodies, as the pages show them."""

import pytest

from tests.runs.support import octet
from tests.web.support import full_speed, wait_for, wait_for_text

CHANGES = ("--change", "plant@1s", "--change", "swap-motors@2s", "--change", "grow:900@3s")
GREEN = """() => {
  const [, x, y, radius] = octet.scene.environment.plants[0];
  const { canvas, context, scale } = octet.renderer ?? octet.view.renderer;
  const at = [x + 0.9 * radius * Math.cos(0.2), y + 0.9 * radius * Math.sin(0.2)].map((mm) => (mm + 40) * scale);
  const [red, green, blue] = context.getImageData(...at, 1, 1).data;
  return green > red && red > blue;
}"""


@pytest.fixture(scope="module")
def surprised(tmp_path_factory):
    """The page of a run in which something happens."""
    out = tmp_path_factory.mktemp("surprised")
    words = ("--bus", "none", "--environments", "1", "--limit-s", "5", "--quiet", "--out", out)
    assert octet("run", *words, *CHANGES).returncode == 0
    return out / "replay.html"


def test_the_page_of_a_run_goes_from_change_to_change_and_says_what_happened(surprised, open_page):
    page = open_page(surprised.as_uri())
    page.select_option("#kind", "change")
    assert page.inner_text("#news") == ""

    seen = []
    for _ in range(3):
        page.click("#after")
        wait_for(page, "!octet.stale")
        seen.append(page.inner_text("#news"))

    assert seen[:2] == ["0:01.0 A plant was put down.", "0:02.0 The plugs of the motors were swapped."]
    assert seen[2].startswith("0:03.0 grow:900@3s could not happen: a plant has a radius of 20 to 500 mm")
    wait_for(page, GREEN)


def test_the_live_page_shows_what_happens_when_it_does(watch, open_page):
    page = open_page(watch("--environments", "1", "--limit-s", "20", *CHANGES[:4]).url)
    assert page.inner_text("#news") == ""
    full_speed(page)

    wait_for_text(page, "#news", "The plugs of the motors were swapped.")
    wait_for(page, GREEN)


def test_a_page_that_joins_late_is_told_what_happened(watch, open_page):
    watched = watch("--environments", "1", "--limit-s", "30", *CHANGES[:4])
    full_speed(open_page(watched.url))
    page = open_page(watched.url)

    wait_for_text(page, "#news", "The plugs of the motors were swapped.")
