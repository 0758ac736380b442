"""A run in the page is that of tools/run: the same layouts, the same bytes in its log, the same pictures."""

import json
from dataclasses import asdict
from typing import Any

import numpy as np
import pytest

from host_sim.protocol.generated import PROFILES
from host_sim.world.layouts import generate
from host_sim.world.params import SimParams
from tests.runs.support import octet
from tests.web.node import in_node
from tests.web.page_runs import experiment, run_in_page, words
from tests.web.support import run_in

LAYOUTS = """
const [{ params, layouts }] = texts.map((text) => JSON.parse(text));
return layouts.map(({ seed, number, robots }) => modules["layouts.js"].generate(seed, number, params, robots, Math));
"""


def numbers(layout: Any) -> list[float]:
    return [float(x) for part in layout for item in part for x in np.ravel(item)]


def page_numbers(layout: dict[str, Any]) -> list[float]:
    return numbers([layout["bars"], layout["food"], layout["starts"]])


def test_the_layouts_are_those_that_python_draws(tmp_path):
    wanted = [{"seed": seed, "number": 1 + seed % 3, "robots": 1 + seed % 4} for seed in (0, *range(1, 2**32, 2**27))]
    asked = tmp_path / "layouts.json"
    asked.write_text(json.dumps({"params": asdict(SimParams()), "layouts": wanted}))

    drawn = in_node(tmp_path, "layouts.js", LAYOUTS, asked)

    for it, layout in zip(wanted, drawn, strict=True):
        python = generate(it["seed"], it["number"], SimParams(), it["robots"])
        assert page_numbers(layout) == pytest.approx(numbers([python.bars, python.food, python.starts]), abs=1e-9)


def comparable(run: dict[str, Any]) -> dict[str, Any]:
    """A run but for its title and its packed columns, and without what was programmed before its first tick."""
    for robot in run["robots"]:
        robot["data"] = ""
        robot["lessons"] = [lesson for lesson in robot["lessons"] if not lesson["by_hand"]]
    return {**run, "title": None}


WANTED = [*(experiment(profile, 7 + number) for number, profile in enumerate(PROFILES)), experiment("article", 5, 4)]
NAMES = [f"{it['robots'][0]['profile']}-{len(it['robots'])}" for it in WANTED]


@pytest.fixture(scope="module")
def in_page(tmp_path_factory) -> dict[str, dict[str, Any]]:
    return dict(zip(NAMES, run_in_page(tmp_path_factory.mktemp("runs"), *WANTED), strict=True))


@pytest.mark.parametrize(("name", "wanted"), list(zip(NAMES, WANTED, strict=True)), ids=NAMES)
def test_a_run_has_the_log_and_the_page_of_tools_run(tmp_path, in_page, name, wanted):
    assert octet("run", "--bus", "none", "--quiet", "--out", tmp_path, *words(wanted)).returncode == 0

    assert in_page[name]["log"] == (tmp_path / "run.log").read_text()
    there, here = run_in(tmp_path / "replay.html"), in_page[name]["run"]
    assert comparable(here) == comparable(there)
