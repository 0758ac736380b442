"""What the page makes of what people open in it or ask of it; its firmware gives the answers of this machine's."""

import json
from pathlib import Path

import pytest

from host_sim.protocol.generated import PROFILES
from host_sim.report.octet_page import world_dimensions
from tests.runs.support import octet
from tests.web.sim.node import in_node
from tests.web.sim.page_runs import page_file
from tests.web.support import wait_for, wait_for_text

OPEN = """
const [worlds, log, world] = texts;
try {
  return modules["sim/log_opening.ts"].openLog(page, JSON.parse(worlds), log, world ?? "").news;
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
    return in_node(folder, "sim/log_opening.ts", OPEN, *files)


def changed(run: Path, **fields: object) -> str:
    return json.dumps({**json.loads((run / "run.world.json").read_text()), **fields})


def test_log_opens_as_its_run_with_and_without_its_world(tmp_path, run):
    log, world = (run / "run.log").read_text(), (run / "run.world.json").read_text()

    assert opened(tmp_path, log, world) == "This is the run of the log, byte for byte."
    assert opened(tmp_path, log) == "This is the run of the log, byte for byte."


def test_truncated_log_opens_as_the_run_so_far(tmp_path, run):
    lines = (run / "run.log").read_text().splitlines(keepends=True)

    assert opened(tmp_path, "".join(lines[:300])).startswith("The log ends before the run does")


def test_world_that_does_not_fit_the_log_is_found(tmp_path, run):
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
        ({"edits": [{**EDIT, "tick": -1}]}, NO_WORLD),
        ({"edits": [{**EDIT, "tick": 5}, EDIT]}, NO_WORLD),
        ({"edits": [{"tick": 3, "do": "lift", "robot": "two"}]}, NO_WORLD),
        ({"edits": [{"tick": 3, "do": "body", "what": "melt"}]}, NO_WORLD),
        ({"world": "nowhere"}, 'this page has no world "nowhere"'),
        ({"world": {"name": "my.toml", "food": []}}, "a world needs food, such as food = [[3500, 400]]"),
    ],
    ids=str,
)
def test_malformed_world_file_is_refused_in_one_line(tmp_path, run, fields, why):
    assert opened(tmp_path, (run / "run.log").read_text(), changed(run, **fields)) == why


def test_text_that_is_not_json_is_refused_as_a_world_file(tmp_path, run):
    assert opened(tmp_path, (run / "run.log").read_text(), "hello") == NO_WORLD


@pytest.mark.parametrize(
    "log", ["", "hello\n", "(0000000000.000000) octet 101#F612000000288002\n"], ids=["", "text", "unstarted"]
)
def test_log_without_a_run_is_refused_in_one_line(tmp_path, log):
    assert len(opened(tmp_path, log).splitlines()) == 1
    assert "byte for byte" not in opened(tmp_path, log)


READY = "window.octet?.scene?.state && octet.last > 0"
CHANGES = """
octet.lane.change({ do: "remove_bar", id: 98, tick: 5 });
octet.lane.change({ do: "move_food", id: 0, at: [5000, 0], tick: 5 });
octet.lane.change({ do: "freeze", robot: 0, on: 1, tick: 6 });
octet.simulate(octet.lane);
"""


def test_impossible_changes_are_taken_back_and_the_others_stay(open_page, tmp_path):
    page = open_page(page_file(tmp_path).as_uri(), ready=READY)

    page.evaluate(f"() => {{ {CHANGES} }}")

    wait_for_text(page, "#note", "there is no such number; that is outside of the arena")
    wait_for(page, "octet.simulator.running === undefined && octet.simulator.queued.size === 0")
    assert page.evaluate("octet.lane.experiment.changes.map((change) => change.do)") == ["freeze"]


REPLAY = 'return texts.map((text) => modules["sim/log_replay.ts"].replayLog(page, text));'


def recorded(out: Path, *words: str) -> Path:
    assert octet("run", "--bus", "none", "--environments", "1", "--quiet", "--out", out, *words).returncode == 0
    return out / "run.log"


@pytest.fixture(scope="module")
def logs(tmp_path_factory) -> list[Path]:
    """A short run of each behaviour, and one of four robots."""
    folder = tmp_path_factory.mktemp("logs")
    runs = {name: ("--profile", name, "--limit-s", "20") for name in PROFILES}
    return [recorded(folder / name, *words) for name, words in (runs | {"four": ("--robots", "4")}).items()]


def test_recorded_logs_are_replayed_frame_by_frame(tmp_path, logs):
    compared = in_node(tmp_path, "sim/log_replay.ts", REPLAY, *logs)

    assert [it.get("difference") for it in compared] == [None] * len(logs)
    assert [it["frames"] for it in compared] == [len(log.read_text().splitlines()) for log in logs]


def test_drive_frame_that_differs_is_found_with_its_line(tmp_path, logs):
    lines = logs[0].read_text().splitlines()
    changed = next(i for i, line in enumerate(lines) if i > 100 and " 041#" in line)
    lines[changed] = lines[changed][:-1] + ("0" if lines[changed][-1] != "0" else "1")
    log = tmp_path / "run.log"
    log.write_text("\n".join(lines))

    (compared,) = in_node(tmp_path, "sim/log_replay.ts", REPLAY, log)

    assert compared["difference"]["line"] == changed + 1
