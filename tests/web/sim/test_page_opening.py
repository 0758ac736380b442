"""What the page makes of the logs and world files that people open in it."""

import json
from pathlib import Path

import pytest

from host_sim.report.octet_page import world_dimensions
from tests.runs.support import octet
from tests.web.sim.node import in_node

OPEN = """
const [worlds, log, world] = texts;
try {
  return modules["sim/log_opening.js"].openLog(page, JSON.parse(worlds), log, world ?? "").news;
} catch (error) {
  return error.message;
}
"""
NO_WORLD = "that is not a world file: open a run.world.json"
EDIT = {"tick": 3, "do": "add_bar", "a": [100, 100], "b": [900, 100]}


@pytest.fixture(scope="module")
def run(tmp_path_factory) -> Path:
    out = tmp_path_factory.mktemp("run")
    words = ("--environments", "1", "--limit-s", "4", "--robots", "2", "--set", "turn_deg=20")
    assert octet("run", "--bus", "none", "--quiet", "--out", out, *words).returncode == 0
    return out


def opened(folder: Path, log: str, *world: str) -> str:
    texts = [json.dumps(world_dimensions()), log, *world]
    files = [folder / str(i) for i in range(len(texts))]
    for file, text in zip(files, texts, strict=True):
        file.write_text(text)
    return in_node(folder, "sim/log_opening.js", OPEN, *files)


def changed(run: Path, **fields: object) -> str:
    return json.dumps({**json.loads((run / "run.world.json").read_text()), **fields})


def test_a_log_is_its_run_with_and_without_its_world(tmp_path, run):
    log, world = (run / "run.log").read_text(), (run / "run.world.json").read_text()

    assert opened(tmp_path, log, world) == "This is the run of the log, byte for byte."
    assert opened(tmp_path, log) == "This is the run of the log, byte for byte."


def test_a_log_that_was_cut_off_is_the_run_so_far(tmp_path, run):
    lines = (run / "run.log").read_text().splitlines(keepends=True)

    assert opened(tmp_path, "".join(lines[:300])).startswith("The log ends before the run does")


def test_another_world_than_that_of_the_log_is_found(tmp_path, run):
    edit = {**EDIT, "tick": 0, "do": "move_food", "id": 0, "at": [10, 10]}
    lift = {"tick": 3, "do": "lift"}

    news = opened(tmp_path, (run / "run.log").read_text(), changed(run, edits=[edit, lift]))

    assert news.endswith("open the log together with its run.world.json.")


@pytest.mark.parametrize(
    ("fields", "why"),
    [
        ({"format": 2}, NO_WORLD),
        ({"of": 0}, NO_WORLD),
        ({"limit_ticks": "many"}, NO_WORLD),
        ({"edits": [{**EDIT, "a": None}]}, NO_WORLD),
        ({"edits": [{**EDIT, "do": "jump"}]}, NO_WORLD),
        ({"edits": [None]}, NO_WORLD),
        ({"edits": [{"tick": 3, "do": "body", "what": "melt"}]}, NO_WORLD),
        ({"world": "nowhere"}, 'this page knows no world "nowhere"'),
        ({"world": {"name": "my.toml", "food": []}}, "a world needs food, such as food = [[3500, 400]]"),
    ],
    ids=str,
)
def test_a_world_file_that_is_none_is_refused_in_a_line(tmp_path, run, fields, why):
    assert opened(tmp_path, (run / "run.log").read_text(), changed(run, **fields)) == why


def test_what_is_no_json_is_no_world(tmp_path, run):
    assert opened(tmp_path, (run / "run.log").read_text(), "hello") == NO_WORLD


@pytest.mark.parametrize(
    "log", ["", "hello\n", "(0000000000.000000) octet 101#F612000000288002\n"], ids=["", "text", "unstarted"]
)
def test_what_is_no_run_is_refused_in_a_line(tmp_path, log):
    assert len(opened(tmp_path, log).splitlines()) == 1
    assert "byte for byte" not in opened(tmp_path, log)
