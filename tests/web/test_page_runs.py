"""A run in the page is that of tools/run: the same layouts, the same bytes in its log, the same pictures."""

import json
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from host_sim.protocol.generated import PROFILES
from host_sim.world.layouts import generate
from host_sim.world.params import SimParams
from tests.runs.support import octet
from tests.web.node import in_node
from tests.web.support import run_in

LAYOUTS = """
const [{ params, layouts }] = texts.map((text) => JSON.parse(text));
return layouts.map(({ seed, number, robots }) => modules["layouts.js"].generate(seed, number, params, robots, Math));
"""
RUNS = """
const [params, ...experiments] = texts.map((text) => JSON.parse(text));
return experiments.map((experiment) => {
  const simulation = new modules["simulation.js"].Simulation(page, experiment, params, true);
  for (const _ of simulation.run());
  const log = Buffer.concat(simulation.log).toString("latin1");
  return { log, ...simulation.result() };
});
"""
"""What the log, the run and its columns are, for each experiment."""


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


def experiment(profile: str, seed: int, robots: int = 1, **more: Any) -> dict[str, Any]:
    setup = {"profile": profile, "settings": {}, "memory": None}
    return {"seed": seed, "environments": 2, "limit_ticks": 1000, "robots": [setup] * robots, "changes": [], **more}


def words(wanted: dict[str, Any]) -> list[str]:
    """The same for the command line."""
    profile = wanted["robots"][0]["profile"]
    options = {"seed": wanted["seed"], "environments": wanted["environments"], "limit-s": wanted["limit_ticks"] / 50}
    words = [word for name, value in options.items() for word in (f"--{name}", str(value))]
    return [*words, "--profile", profile, "--robots", str(len(wanted["robots"]))]


def run_in_page(folder: Path, *wanted: dict[str, Any]) -> Sequence[dict[str, Any]]:
    files = [folder / f"{i}.json" for i in range(len(wanted) + 1)]
    for file, content in zip(files, (asdict(SimParams()), *wanted), strict=True):
        file.write_text(json.dumps(content))
    return in_node(folder, "simulation.js", RUNS, *files)


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
    for robot in there["robots"]:
        robot["data"] = ""
    assert here | {"title": None} == there
