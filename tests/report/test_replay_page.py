"""The page of a run: small, whole, and true."""

import base64
import re
import zlib
from itertools import accumulate

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from host_sim.base.errors import PageNotBuiltError
from host_sim.cli.main import main
from host_sim.cli.outputs import Outputs
from host_sim.cli.run_options import RunOptions
from host_sim.client.frame_log import FrameLog
from host_sim.recording.resimulation import resimulate
from host_sim.recording.run_recorder import RunRecorder
from host_sim.recording.state_types import State
from host_sim.recording.trajectory import Trajectory, at
from host_sim.report import page_bundle, replay_page
from host_sim.report.octet_page import octet_page
from host_sim.report.replay_page import pack, page, run_data, write_page
from host_sim.sim.make import make
from host_sim.talk import languages
from tests.recording.support import record_run
from tests.runs.support import data_in

SVG = "http://www.w3.org/2000/svg"
"""The name of a language, which nobody fetches."""


def unpacked(data: str, columns: int) -> list[list[int]]:
    """As the page does it."""
    planes = np.frombuffer(zlib.decompress(base64.b64decode(data)), np.uint8).reshape(columns, 4, -1)
    zigzag = (planes.astype(np.int64) << np.array([[0], [8], [16], [24]])).sum(axis=1)
    return np.cumsum(zigzag >> 1 ^ -(zigzag & 1), axis=1).tolist()


def state_in(run: dict, robot: dict, columns: dict[str, list[int]], tick: int) -> State:
    """The state of a robot at a tick, from what the page holds."""
    row = {name: values[tick - run["first_tick"]] for name, values in columns.items()}
    cells = {it[1]: it for it in robot["cells"] if it[0] <= tick}.values()
    return State(
        **{**row, "x": row["x"] / 10, "y": row["y"] / 10},
        node=robot["node"],
        tick=tick,
        eaten=at(run["eaten"], tick),
        memory=at(robot["memory"], tick),
        **{name: [it[i] for it in cells] for i, name in enumerate(("uses", "learned", "by_hand"), 2)},
        trial=at(robot["trials"], tick),
    )


def run_in(text: str) -> dict:
    return data_in(text, "run")


def test_page_holds_the_state_of_every_tick(kept, tmp_path):
    write_page(tmp_path / "page.html", kept.trajectory, "a run")

    run = run_in((tmp_path / "page.html").read_text())

    robot = run["robots"][0]
    columns = dict(zip(robot["columns"], unpacked(robot["data"], len(robot["columns"])), strict=True))
    columns["right"] = [both - left for both, left in zip(columns["right"], columns["left"], strict=True)]
    turned = accumulate((left - right) >> 3 for left, right in zip(columns["left"], columns["right"], strict=True))
    columns["heading"] = [rest + so_far for rest, so_far in zip(columns["heading"], turned, strict=True)]
    for tick in (*range(0, kept.trajectory.ticks, 61), kept.trajectory.ticks - 1):
        assert state_in(run, robot, columns, tick) == kept.trajectory.at(tick)
    assert run["ticks"] == kept.trajectory.ticks
    assert run["scenes"] == [[tick, scene] for tick, scene in kept.trajectory.scenes]


def test_recording_is_packed_once_for_its_pages_and_its_file(tmp_path, monkeypatch):
    packed = []
    monkeypatch.setattr(replay_page, "pack", lambda columns: packed.append(len(list(columns))) or "")
    options = RunOptions(bus="none", environments=1, out=tmp_path, quiet=True)
    log = FrameLog(options.log)
    with make(options, log) as simulation:
        outputs = Outputs(options, simulation, RunRecorder.of(simulation, 10), log)
        simulation.enter(1)
        simulation.step()
        outputs.recording()
        simulation.step()

        outputs.recording()
        outputs.write()

    assert len(packed) == 2


def test_page_of_ten_robot_minutes_is_below_a_megabyte(tmp_path):
    trajectory = record_run(tmp_path, seed=1, environments=5, limit_s=120.0).trajectory
    assert trajectory.ticks >= 25_000

    text = page(run_data(trajectory, "ten minutes"))

    assert len(text.encode()) * 30_000 / trajectory.ticks < 1_000_000


def test_page_loads_nothing_from_outside(kept):
    text = page(run_data(kept.trajectory, "a run"))

    assert set(re.findall(r"\bhttps?://[^\s\"'`<)]*", text)) <= {SVG}
    assert not re.search(r"""(?:src|href)=["'](?!data:|#)|@import|\burl\((?!["']?data:|#)""", text)
    assert not re.search(r"^(import|export) ", text, re.MULTILINE)


def test_page_has_the_same_bytes_for_the_same_run(tmp_path):
    texts = [page(run_data(record_run(tmp_path / name, seed=5, limit_s=20.0).trajectory, "x")) for name in "ab"]

    assert texts[0] == texts[1]


def test_run_leaves_the_page_that_its_log_makes(tmp_path):
    words = ["--seed", "4", "--environments", "1", "--limit-s", "20", "--bus", "none", "--quiet"]
    assert main(["run", *words, "--out", str(tmp_path)]) == 0
    again = tmp_path / "again.html"

    assert main(["replay", str(tmp_path / "run.log"), "--html", str(again)]) == 0

    assert again.read_bytes() == (tmp_path / "replay.html").read_bytes()


def test_title_cannot_end_the_script_that_holds_the_run(kept):
    title = "</script><script>alert(1)</script><!--"

    text = page(run_data(kept.trajectory, title))

    assert title not in text
    assert run_in(text)["title"] == title


def test_page_inlines_the_parts_styles_and_scripts_of_its_template(tmp_path, monkeypatch):
    for module in (languages, page_bundle):
        monkeypatch.setattr(module, "WEB", tmp_path)
    monkeypatch.setattr(page_bundle, "PAGE_SCRIPTS", tmp_path)
    (tmp_path / "common").mkdir()
    (tmp_path / "common/style.html").write_text('<link rel="stylesheet" href="s.css">\n')
    (tmp_path / "page.html").write_text('  <!-- common/style.html -->\n<script type="module" src="a.js"></script>')
    (tmp_path / "s.css").write_text("/* Says nothing. */\np { margin: 0 }\n")
    (tmp_path / "a.js").write_text('say("</script>");')

    text = page_bundle.page_of(languages.template("page.html"))

    assert text == '<style>\np{margin:0}</style>\n<script type="module">\nsay("<\\/script>");</script>'


@pytest.fixture
def no_scripts(tmp_path, monkeypatch):
    """The programs of the pages are not built."""
    monkeypatch.setattr(page_bundle, "PAGE_SCRIPTS", tmp_path)


@pytest.mark.usefixtures("no_scripts")
def test_run_without_built_scripts_leaves_its_page_out(tmp_path, capsys):
    out = tmp_path / "out"

    assert main(["run", "--bus", "none", "--environments", "1", "--limit-s", "2", "--out", str(out)]) == 0

    assert "left out  replay.html: cannot read" in capsys.readouterr().out
    assert (out / "run.log").exists()
    assert not (out / "replay.html").exists()


@pytest.mark.usefixtures("no_scripts")
def test_page_without_built_scripts_says_how_to_build_them():

    with pytest.raises(PageNotBuiltError, match=r"cannot read .*octet\.js: .*; build it with tools/setup$"):
        octet_page({"why": "nothing"})


@given(st.lists(st.lists(st.integers(-(2**29), 2**29), min_size=3, max_size=3), min_size=1, max_size=5))
def test_packed_columns_are_unpacked_unchanged(columns):
    assert unpacked(pack(columns), len(columns)) == columns


def test_page_is_made_of_dead_reckoning_without_the_world(kept):
    trajectory: Trajectory = resimulate(kept.log, ignore_world=True).trajectory

    run = run_in(page(run_data(trajectory, "somewhere")))

    assert run["scenes"][0][1]["food"] == []
    assert run["ticks"] == kept.trajectory.ticks


@pytest.mark.parametrize("name", ["nowhere/page.html", "."])
def test_unwritable_page_is_reported_in_one_line(short, tmp_path, capsys, name):
    before = set(tmp_path.rglob("*"))
    assert main(["replay", str(short.log), "--html", str(tmp_path / name)]) == 2
    assert set(tmp_path.rglob("*")) == before
    assert re.fullmatch(r"octet: cannot write .*\n", capsys.readouterr().err)


def test_page_file_may_load_nothing_by_its_security_policy():
    text = page_bundle.page_of(languages.template("octet.html"))

    policy = re.search(r'<meta http-equiv="Content-Security-Policy" content="([^"]*)">', text)
    assert policy is not None
    assert policy[1].startswith("default-src 'none'; ")
    assert "http" not in policy[1]
    assert text.index(policy[0]) < text.index("<script")
