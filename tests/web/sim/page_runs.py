"""Experiments that a page runs, in Node or in a browser, and how the command line says them."""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from host_sim.report.octet_page import world_dimensions
from host_sim.sim.run_config import RunConfig
from tests.runs.support import octet
from tests.web.sim.node import in_node

RUNS = """
const [worlds, ...experiments] = texts.map((text) => JSON.parse(text));
return experiments.map((experiment) => {
  const simulation = new modules["sim/simulation.ts"].Simulation(page, experiment, worlds, true);
  for (const _ of simulation.run());
  const log = Buffer.concat(simulation.log).toString("latin1");
  return { log, run: simulation.result().run };
});
"""
"""The log and the run of each experiment."""

LOGS = """async (experiments) => {
  const logs = [];
  for (const experiment of experiments) {
    const parts = await octet.simulator.ask("log", { experiment });
    logs.push(await new Blob(parts).text());
  }
  return logs;
}"""
"""The log of each experiment, for `Page.evaluate` in the page of `tools/octet page`."""


def experiment(profile: str, seed: int, robots: int = 1, **more: Any) -> dict[str, Any]:
    setup = {"profile": profile, "settings": RunConfig(body=more.get("body", "ideal")).robot_settings, "memory": None}
    return {"seed": seed, "environments": 2, "limit_ticks": 1000, "robots": [setup] * robots, "changes": [], **more}


def words(wanted: dict[str, Any]) -> list[str]:
    """The same for the command line."""
    profile, world = wanted["robots"][0]["profile"], wanted.get("world", "random")
    options = {"seed": wanted["seed"], "environments": wanted["environments"], "limit-s": wanted["limit_ticks"] / 50}
    words = [word for name, value in options.items() for word in (f"--{name}", str(value))]
    body = wanted.get("body", "ideal")
    return [*words, "--profile", profile, "--robots", str(len(wanted["robots"])), "--world", world, "--body", body]


def with_changes_of(wanted: dict[str, Any], out: Path) -> dict[str, Any]:
    """The experiment with the world of a run that has ended, and with all that changed in it."""
    content = json.loads((out / "run.world.json").read_text())
    return {
        **wanted,
        "changes": content["edits"],
        "world": content.get("world", "random"),
        "body": content.get("body", "ideal"),
    }


def run_in_page(folder: Path, *wanted: dict[str, Any]) -> Sequence[dict[str, Any]]:
    files = [folder / f"{i}.json" for i in range(len(wanted) + 1)]
    for file, content in zip(files, (world_dimensions(), *wanted), strict=True):
        file.write_text(json.dumps(content))
    return in_node(folder, "sim/simulation.ts", RUNS, *files)


def page_file(folder: Path) -> Path:
    """`tools/octet page`."""
    path = folder / "octet.html"
    done = octet("page", path)
    assert (done.returncode, done.stderr) == (0, "")
    return path
