"""A run in the page is that of tools/run: the same layouts, the same bytes in its log, the same pictures."""

import json
from pathlib import Path
from typing import Any

import pytest

from host_sim.protocol.generated import PROFILES
from host_sim.report.octet_page import world_dimensions
from host_sim.sim.run_config import RunConfig
from host_sim.world.names import CRATES
from host_sim.world.reach import tour_mm
from host_sim.world.worlds import world_of
from tests.runs.support import octet
from tests.web.sim.node import in_node
from tests.web.sim.page_runs import experiment, run_in_page, with_changes_of, words
from tests.web.support import run_in
from tests.world.golden_layouts import DIGESTS, WRITTEN, digest
from tests.world.golden_layouts import WANTED as WANTED_LAYOUTS

MODULES = "sim/native_layouts.ts sim/native_run.ts sim/simulation.ts"
LAYOUTS = """
const [{ worlds, layouts }] = texts.map((text) => JSON.parse(text));
const { "sim/native_layouts.ts": { drawFrom, drawLayout }, "sim/simulation.ts": { worldOf } } = modules;
const { NativeRun } = modules["sim/native_run.ts"];
const native = new NativeRun(page, 4);
return layouts.map(({ world, ...which }) => {
  const { params, written } = worldOf(world, worlds);
  drawFrom(native, params, written);
  const { bars, food, starts } = drawLayout(native, which);
  return [...bars, ...food, ...starts].flat();
});
"""


@pytest.mark.parametrize("name", sorted(DIGESTS.keys() - {CRATES}))
def test_layouts_of_a_world_have_their_recorded_digest(tmp_path, name):
    asked, world = tmp_path / "layouts.json", {"name": name, **WRITTEN[name]} if name in WRITTEN else name
    layouts = [{"world": world, **which._asdict()} for which in WANTED_LAYOUTS]
    asked.write_text(json.dumps({"worlds": world_dimensions(), "layouts": layouts}))

    assert digest(in_node(tmp_path, MODULES, LAYOUTS, asked)) == DIGESTS[name]


TOURS = """
const [{ worlds, seeds }] = texts.map((text) => JSON.parse(text));
const { "sim/native_layouts.ts": { drawFrom, drawLayout }, "sim/simulation.ts": { worldOf } } = modules;
const { NativeRun } = modules["sim/native_run.ts"];
const native = new NativeRun(page, 1);
drawFrom(native, worldOf("crowded", worlds).params);
return seeds.map((seed) => {
  drawLayout(native, { seed, number: 1, robots: 1 });
  return native.c.page_tour();
});
"""


def test_shortest_tour_is_the_same_to_the_last_bit(tmp_path):
    asked, world = tmp_path / "asked.json", world_of("crowded")
    asked.write_text(json.dumps({"worlds": world_dimensions(), "seeds": [1, 2, 3, 4]}))

    in_page = in_node(tmp_path, MODULES, TOURS, asked)

    assert in_page == [tour_mm(world.generate(seed, 1), world.params) for seed in (1, 2, 3, 4)]


def comparable(run: dict[str, Any]) -> dict[str, Any]:
    """A run but for its title, log and packed columns, and without what was programmed before its first tick."""
    for robot in run["robots"]:
        robot["data"] = ""
        robot["lessons"] = [lesson for lesson in robot["lessons"] if not lesson["by_hand"]]
        robot["cells"] = [[tick, cell, uses] for tick, cell, uses, _, _ in robot["cells"] if tick]
    return {**run, "title": None, "log": None}


WANTED = [*(experiment(profile, 7 + number) for number, profile in enumerate(PROFILES)), experiment("article", 5, 4)]
NAMES = [f"{it['robots'][0]['profile']}-{len(it['robots'])}" for it in WANTED]


@pytest.fixture(scope="module")
def in_page(tmp_path_factory) -> dict[str, dict[str, Any]]:
    return dict(zip(NAMES, run_in_page(tmp_path_factory.mktemp("runs"), *WANTED), strict=True))


@pytest.mark.parametrize(("name", "wanted"), list(zip(NAMES, WANTED, strict=True)), ids=NAMES)
def test_page_run_has_the_log_and_the_states_of_tools_run(tmp_path, in_page, name, wanted):
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
def test_page_run_in_a_changing_world_is_that_of_tools_run(tmp_path, world, profile, robots, changes):
    assert_same_run(tmp_path, experiment(profile, 3, robots, world=world), changes, code=0)


LATER = "lag:60ms@2s slack:3deg@3s/1 slip:5%@4s latency:1@5s/2 dark-wall@8s repair@env2 weak-battery@env2+3s"


@pytest.mark.parametrize("body", ["ideal", "kit", "docs/bodies/late_body.toml", "docs/bodies/sharp_body.toml"])
def test_page_run_with_bodies_that_get_worse_is_that_of_tools_run(tmp_path, body):
    assert_same_run(tmp_path, experiment("adaptive", 3, 2, body=body), LATER, code=0)


@pytest.mark.parametrize("profile", ["searcher", "distance"])
def test_page_run_with_the_body_named_kit_is_that_of_tools_run(tmp_path, profile):
    wanted = experiment(profile, 3, body="kit")

    assert octet("run", "--bus", "none", "--quiet", "--out", tmp_path, *words(wanted)).returncode == 0

    assert run_in_page(tmp_path, wanted)[0]["log"] == (tmp_path / "run.log").read_text()


@pytest.mark.parametrize("body", ["ideal", "kit"])
def test_page_sets_robots_up_for_their_bodies_as_tools_run_does(tmp_path, body):
    settings = in_node(tmp_path, "sim/arena.ts", f'return modules["sim/arena.ts"].settingsOf("{body}");')

    assert settings == RunConfig(body=body).robot_settings


def test_page_run_with_robots_stopped_by_wheel_faults_is_that_of_tools_run(tmp_path):
    broken = "odometer:left:-100%@3s/2 odometer:left:0%@env2 odometer:right:0%@env2 repair@env2+9s"

    assert_same_run(tmp_path, experiment("article", 3, 2), broken, code=1)


def assert_same_run(tmp_path: Path, wanted: dict[str, Any], changes: str, code: int) -> None:
    what = [word for change in changes.split() for word in ("--change", change)]
    assert octet("run", "--bus", "none", "--quiet", "--out", tmp_path, *words(wanted), *what).returncode == code

    (there,) = run_in_page(tmp_path, with_changes_of(wanted, tmp_path))

    assert there["log"] == (tmp_path / "run.log").read_text()
    assert comparable(there["run"]) == comparable(run_in(tmp_path / "replay.html"))
