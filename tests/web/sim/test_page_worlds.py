"""World files in the page: the same worlds, and the same mistakes in the same lines, as on the command line."""

import json
from pathlib import Path

import pytest

from host_sim.base.errors import UsageError
from host_sim.base.paths import ROOT
from host_sim.protocol.words import KIT_SETTINGS
from host_sim.report.octet_page import world_dimensions
from host_sim.world.worlds import content_of, read_world_file
from tests.web.sim.node import in_node

OPEN = """
const [worlds, text] = texts;
const base = { seed: 7, environments: 3, robots: [{ profile: "article", settings: {}, memory: null }], changes: [] };
try {
  const parts = { module: page, worlds: JSON.parse(worlds) };
  return modules["sim/world_opening.ts"].openWorld(parts, { name: "my.toml", text }, base);
} catch (error) {
  return error.message;
}
"""
GOOD = (ROOT / "docs/worlds/two_walls.toml").read_text()
FOOD = "food = [[2000, 1500]]\n"
BAD = {
    "no food": "size = [3000, 2000]\n",
    "too small": f"size = [500, 2000]\n{FOOD}",
    "food outside": "# comment\nfood = [\n  [2000, 1500],\n  [9000, 10], # far away\n]\n",
    "food too near": f"{FOOD}bars = [[2000, 1600, 2400, 1600]]\n",
    "food in an obstacle": "food = [[500, 500], [2000, 1500]]\nbars = [[2000, 1400, 2000, 1600]]\n",
    "a short bar": f"{FOOD}bars = [\n  [100, 100, 900, 100],\n  [100, 200, 110, 200]]\n",
    "no way": f"start = [200, 200, 0]\n{FOOD}bars = [[1000, 0, 1000, 3000]]\n",
    "too few numbers": f"{FOOD}start = [1, 2]\n",
    "no list": "food = 3\n",
    "a number that is none": "food = [[2000, 1500], [inf, 3]]\n",
}


def opened(folder: Path, text: str, code: str = OPEN) -> object:
    files = [folder / "worlds.json", folder / "text"]
    for file, content in zip(files, (json.dumps(world_dimensions()), text), strict=True):
        file.write_text(content)
    return in_node(folder, "sim/world_opening.ts", code, *files)


def test_world_file_is_read_as_on_the_command_line(tmp_path):
    world = read_world_file(ROOT / "docs/worlds/two_walls.toml")

    read = opened(tmp_path, GOOD)["world"]

    assert {"name": "my.toml", **content_of(world.draw, world.params)} == read


@pytest.mark.parametrize("text", BAD.values(), ids=BAD)
def test_world_file_error_has_its_line_and_text_as_on_the_command_line(tmp_path, text):
    (tmp_path / "my.toml").write_text(text)
    with pytest.raises(UsageError) as error:
        read_world_file(tmp_path / "my.toml")
    where, _, what = str(error.value).removeprefix(f"{tmp_path}/").partition(": ")

    said = opened(tmp_path, text)

    assert str(said).startswith(where)
    assert what in said or "is not TOML" in said


def test_unknown_key_in_a_world_file_is_reported(tmp_path):
    said = opened(tmp_path, f"{FOOD}bar = []\n")

    assert said == "my.toml:2: there is no 'bar': a world has size, start, food, bars"


@pytest.mark.parametrize("text", ["food", "food = [", "= 3", "food = [[1, 2] 3]", "food = 1\nfood = 2", "[arena]"])
def test_malformed_toml_is_reported_with_its_line(tmp_path, text):
    assert str(opened(tmp_path, text)).startswith(f"my.toml:{text.count(chr(10)) + 1}: this is not TOML: ")


@pytest.mark.parametrize("body", ["ideal", "kit"])
def test_robots_of_a_world_file_have_the_settings_of_its_body(tmp_path, body):
    world = {"format": 1, "seed": 3, "of": 2, "limit_ticks": 500, "robots": 2, "edits": [], "body": body}
    code = OPEN.replace("my.toml", "run.world.json").replace("settings: {}", "settings: { turn_deg: 77 }")

    robots = opened(tmp_path, json.dumps(world), code)["robots"]

    assert [robot["settings"] for robot in robots] == [dict(KIT_SETTINGS) if body == "kit" else {}] * 2
