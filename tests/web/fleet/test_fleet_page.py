"""fleet.html: the robots of a fleet on the move, in one file."""

import math
from pathlib import Path

import pytest

from host_sim.sim.fleet import FleetResult, run_fleet
from host_sim.sim.fleet_film import SAMPLE_TICKS, FleetFilm
from host_sim.sim.run_config import RunConfig
from host_sim.world.memory_kinds import sides_of
from tests.runs.support import octet
from tests.web.looks import PHONES, TOO_SMALL, resize, violations_at
from tests.web.support import next_frame, wait_for

READY = "window.octet?.picture"
POSE = "robot => octet.data.poseOf(robot, octet.at)"
SIDES = "robot => octet.data.sidesAt(robot, octet.at)"


@pytest.fixture(scope="module", params=["own", "one"])
def page_of(request: pytest.FixtureRequest, tmp_path_factory) -> tuple[str, Path]:
    out = tmp_path_factory.mktemp("fleet")
    words = ("--robots", "40", "--worlds", request.param, "--environments", "1", "--limit-s", "10", "--seed", "7")
    assert octet("run", "--bus", "none", "--quiet", "--out", out, *words).returncode in (0, 1)
    return request.param, out / "fleet.html"


@pytest.fixture(scope="module")
def filmed(page_of) -> tuple[FleetFilm, list[FleetResult]]:
    film = FleetFilm()
    config = RunConfig(seed=7, robots=40, worlds=page_of[0], environments=1, limit_s=10.0)
    return film, list(run_fleet(config, film=film))


def test_each_robot_is_where_it_was_and_knows_what_it_knew(page_of, filmed, open_page):
    film, results = filmed
    page = open_page(page_of[1].as_uri(), ready=READY)

    assert len(film.poses) == 1 + math.ceil(max(result.ticks for result in results) / SAMPLE_TICKS)
    page.evaluate("octet.at = 4")
    assert page.evaluate(POSE, 39)[:2] == film.poses[4][39, :2].tolist()
    page.evaluate("octet.at = octet.last")
    for result in results:
        assert page.evaluate(POSE, result.robot - 1)[:2] == pytest.approx(result.pose[:2], abs=0.5)
        assert page.evaluate(SIDES, result.robot - 1) == list(sides_of(result.memory))


def test_its_counts_are_those_of_the_results_and_the_histogram_has_every_robot(page_of, filmed, open_page):
    results = filmed[1]
    worlds = results if page_of[0] == "own" else results[:1]
    page = open_page(page_of[1].as_uri(), ready=READY)

    page.evaluate("octet.at = octet.last")
    wait_for(page, "document.querySelector('#clock').textContent !== '0:00.0'")
    next_frame(page)

    assert int(page.inner_text("#fact-eaten")) == sum(sum(result.eaten) for result in worlds)
    assert page.inner_text("#fact-finished") == f"{sum(result.finished for result in worlds)} of {len(worlds)}"
    levels = [sum(map(bool, sides_of(result.memory))) for result in results]
    assert list(map(int, page.locator("#histogram b").all_text_contents())) == [levels.count(i) for i in range(8)]


def test_one_robot_can_be_opened_and_closed(page_of, open_page):
    page = open_page(page_of[1].as_uri(), ready=READY)
    x, y, scale, left, top = page.evaluate("""() => {
      const { picture, data } = octet;
      const [x, y] = picture.placesOf(0).find(({ robot }) => robot === 16).place;
      return [x + 60, y + 60, picture.scale / devicePixelRatio, picture.margin.x, picture.margin.y];
    }""")

    page.click("#robots", position={"x": x * scale + left, "y": y * scale + top})

    wait_for(page, "document.querySelectorAll('#opened-cells li').length === 7")
    assert page.inner_text("#opened-name") == "Robot 17"
    if page_of[0] == "own":
        assert page.inner_text("#opened-run").startswith("tools/run --seed 23 --environments 1 --profile article")
    assert violations_at(page, PHONES[:1]) == []
    page.click("#close")
    assert not page.is_visible("#opened")
    page.fill("#open", "3")
    page.click("#open-form button")
    assert page.inner_text("#opened-name") == "Robot 3"


def test_it_plays_to_the_end_and_goes_to_any_time(page_of, open_page):
    page = open_page(page_of[1].as_uri(), ready=READY)
    page.select_option("#speed", "16")
    page.click("#play")
    wait_for(page, "octet.at === octet.last && !octet.playing")

    page.locator("#scrub").fill("2")

    wait_for(page, "document.querySelector('#clock').textContent === '0:02.0'")


def test_each_line_of_the_legend_has_its_mark(page_of, open_page):
    page = open_page(page_of[1].as_uri(), ready=READY)

    widths = page.eval_on_selector_all(
        "#legend li:not([hidden], [data-thing='level'])",
        "items => items.map((item) => parseFloat(getComputedStyle(item, '::before').width))",
    )

    assert len(widths) >= 3
    assert all(width >= 8 for width in widths)


def test_axe_finds_nothing_and_fingers_hit_everything(page_of, open_page):
    page = open_page(page_of[1].as_uri(), ready=READY)

    assert violations_at(page, PHONES[:1]) == []
    resize(page, PHONES[0])
    assert page.evaluate(TOO_SMALL) == []
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
