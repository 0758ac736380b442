"""A run in the page is that of tools/run: the same layouts, the same bytes in its log, the same pictures."""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from host_sim.protocol.generated import PROFILES
from host_sim.report.octet_page import world_dimensions
from host_sim.world.layouts import Layout
from host_sim.world.world_names import WORLD_NAMES
from host_sim.world.worlds import world_of
from host_sim.world.written_world import world_from
from tests.runs.support import octet
from tests.web.node import in_node
from tests.web.page_runs import experiment, run_in_page, with_changes_of, words
from tests.web.support import run_in

LAYOUTS = """
const [{ worlds, layouts }] = texts.map((text) => JSON.parse(text));
const { "layouts.js": { generate }, "worlds.js": { worldOf } } = modules;
return layouts.map(({ world, ...which }) => generate(which, worldOf(world, worlds), Math));
"""


def numbers(layout: Any) -> list[float]:
    return [float(x) for part in layout for item in part for x in np.ravel(item)]


def page_numbers(layout: dict[str, Any]) -> list[float]:
    return numbers([layout["bars"], layout["food"], layout["starts"]])


def drawn_in_page(folder: Path, wanted: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    asked = folder / "layouts.json"
    asked.write_text(json.dumps({"worlds": world_dimensions(), "layouts": wanted}))
    return in_node(folder, "worlds.js", LAYOUTS, asked)


def assert_same(drawn: dict[str, Any], layout: Layout) -> None:
    assert page_numbers(drawn) == pytest.approx(numbers([layout.bars, layout.food, layout.starts]), abs=1e-9)


def test_the_layouts_are_those_that_python_draws(tmp_path):
    random = [(seed, 1 + seed % 3, 1 + seed % 4, "random") for seed in (0, *range(1, 2**32, 2**27))]
    others = [(seed, 1, 1 + seed % 2, world) for world in WORLD_NAMES for seed in range(3)]
    wanted = [dict(zip(("seed", "number", "robots", "world"), it, strict=True)) for it in (*random, *others)]

    for it, drawn in zip(wanted, drawn_in_page(tmp_path, wanted), strict=True):
        assert_same(drawn, world_of(it["world"]).generate(it["seed"], it["number"], it["robots"]))


@pytest.mark.parametrize("start", [{}, {"start": [300, 300, -270]}], ids=["drawn", "given"])
def test_the_layouts_of_a_written_world_are_those_that_python_draws(tmp_path, start):
    content = {"size": [3000, 2000], **start, "food": [[2700, 300], [1500, 1000]], "bars": [[1000, 0, 1000, 1400]]}
    wanted = [{"seed": seed, "number": 2, "robots": 2, "world": {"name": "my.toml", **content}} for seed in range(4)]

    for it, drawn in zip(wanted, drawn_in_page(tmp_path, wanted), strict=True):
        assert_same(drawn, world_from(content, "my.toml").generate(it["seed"], 2, 2))


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


CHANGED = {
    "plants": ("random", "article", 1, "plant@1s grow@3s plant@4s plant@env2 grow:100@env2+1s"),
    "bodies": (
        "crowded",
        "forgetful",
        2,
        "swap-motors@2s mirror@5s/2 stuck-on:front@8s weak-motor:left:60%@9s repair@env2",
    ),
    "odometers": (
        "random",
        "adaptive",
        2,
        "odometer:left:133%@1s odometer:right:-100%@4s/2 odometer:right:100%@4.4s/2 "
        "swap-odometers@9s swap-odometers@9.5s false-beacon:100@env2+2s odometer:right:0%@env2+3.5s/1 repair@env2+4s",
    ),
    "noise": ("posts", "adaptive", 2, "noise:10/1000@0s noise:200/1000@env2 stuck-off:left@3s/1"),
    "distances": ("small", "distance", 1, "plant@0s mirror@1s stuck-off:front@3s stuck-on:left@env2"),
    "corridors": ("corridors", "searcher", 1, "plant@2s"),
    "dead ends": ("dead-ends", "five", 3, "mirror@2s"),
    "written": ("docs/worlds/two_walls.toml", "article", 1, "plant@2s grow@3s"),
}


@pytest.mark.parametrize(("world", "profile", "robots", "changes"), CHANGED.values(), ids=CHANGED)
def test_a_run_in_another_world_that_changes_is_that_of_tools_run(tmp_path, world, profile, robots, changes):
    assert_same_run(tmp_path, experiment(profile, 3, robots, world=world), changes, code=0)


def test_a_run_in_which_robots_stop_because_of_their_wheels_is_that_of_tools_run(tmp_path):
    broken = "odometer:left:-100%@3s/2 odometer:left:0%@env2 odometer:right:0%@env2 repair@env2+9s"

    assert_same_run(tmp_path, experiment("article", 3, 2), broken, code=1)


def assert_same_run(tmp_path: Path, wanted: dict[str, Any], changes: str, code: int) -> None:
    what = [word for change in changes.split() for word in ("--change", change)]
    assert octet("run", "--bus", "none", "--quiet", "--out", tmp_path, *words(wanted), *what).returncode == code

    (there,) = run_in_page(tmp_path, with_changes_of(wanted, tmp_path))

    assert there["log"] == (tmp_path / "run.log").read_text()
    assert comparable(there["run"]) == comparable(run_in(tmp_path / "replay.html"))
