"""fleet.html: the robots of a fleet on the move, in one file."""

import math
from pathlib import Path

import numpy as np
import pytest

from host_sim.sim.fleet import SAMPLE_TICKS, run_fleet
from host_sim.sim.run_config import RunConfig
from tests.runs.support import octet
from tests.web.looks import PHONES, TOO_SMALL, violations_at
from tests.web.support import wait_for

READY = "window.octet?.picture"
POSE = "robot => octet.picture.poseOf(robot, octet.at)"


@pytest.fixture(scope="module", params=["own", "one"])
def page_of(request: pytest.FixtureRequest, tmp_path_factory) -> tuple[str, Path]:
    out = tmp_path_factory.mktemp("fleet")
    words = ("--robots", "40", "--worlds", request.param, "--environments", "1", "--limit-s", "10", "--seed", "7")
    assert octet("run", "--bus", "none", "--quiet", "--out", out, *words).returncode in (0, 1)
    return request.param, out / "fleet.html"


def test_each_robot_is_where_it_was(page_of, open_page):
    worlds, file = page_of
    samples: list[np.ndarray] = []
    config = RunConfig(seed=7, robots=40, worlds=worlds, environments=1, limit_s=10.0)
    results = list(run_fleet(config, samples=samples))
    page = open_page(file.as_uri(), ready=READY)

    assert len(samples) == 1 + math.ceil(max(result.ticks for result in results) / SAMPLE_TICKS)
    page.evaluate("octet.at = 4")
    assert page.evaluate(POSE, 39)[:2] == samples[4][39, :2].tolist()
    page.evaluate("octet.at = octet.last")
    assert page.evaluate(POSE, 0)[:2] == pytest.approx(results[0].pose[:2], abs=0.5)


def test_it_plays_to_the_end_and_goes_to_any_time(page_of, open_page):
    page = open_page(page_of[1].as_uri(), ready=READY)
    page.select_option("#speed", "16")
    page.click("#play")
    wait_for(page, "octet.at === octet.last && !octet.playing")

    page.locator("#scrub").fill("2")

    wait_for(page, "document.querySelector('#clock').textContent === '0:02.0'")


def test_axe_finds_nothing_and_fingers_hit_everything(page_of, open_page):
    page = open_page(page_of[1].as_uri(), ready=READY)

    assert violations_at(page, PHONES[:1]) == []
    assert page.evaluate(TOO_SMALL) == []
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
