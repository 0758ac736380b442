"""The page of a run: small, whole, and true."""

import base64
import re
import zlib
from itertools import accumulate

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from host_sim.cli.main import main
from host_sim.recording.resimulation import resimulate
from host_sim.recording.state_types import State
from host_sim.recording.trajectory import Trajectory, at
from host_sim.report import page_bundle
from host_sim.report.replay_page import pack, page, run_data, write_page
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


def test_the_page_has_the_state_of_every_tick(kept, tmp_path):
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


def test_ten_robot_minutes_are_less_than_a_megabyte(tmp_path):
    trajectory = record_run(tmp_path, seed=1, environments=5, limit_s=120.0).trajectory
    assert trajectory.ticks >= 25_000

    text = page(run_data(trajectory, "ten minutes"))

    assert len(text.encode()) * 30_000 / trajectory.ticks < 1_000_000


def test_the_page_needs_nothing_from_anywhere(kept):
    text = page(run_data(kept.trajectory, "a run"))

    assert set(re.findall(r"\bhttps?://[^\s\"'`<)]*", text)) <= {SVG}
    assert not re.search(r"""(?:src|href)=["'](?!data:|#)|@import|\burl\((?!["']?data:|#)""", text)
    assert not re.search(r"^(import|export) ", text, re.MULTILINE)


def test_the_same_run_gives_the_same_bytes(tmp_path):
    texts = [page(run_data(record_run(tmp_path / name, seed=5, limit_s=20.0).trajectory, "x")) for name in "ab"]

    assert texts[0] == texts[1]


def test_a_run_leaves_the_page_that_its_log_makes(tmp_path):
    words = ["--seed", "4", "--environments", "1", "--limit-s", "20", "--bus", "none", "--quiet"]
    assert main(["run", *words, "--out", str(tmp_path)]) == 0
    again = tmp_path / "again.html"

    assert main(["replay", str(tmp_path / "run.log"), "--html", str(again)]) == 0

    assert again.read_bytes() == (tmp_path / "replay.html").read_bytes()


def test_nothing_in_a_run_ends_the_script_that_holds_it(kept):
    title = "</script><script>alert(1)</script><!--"

    text = page(run_data(kept.trajectory, title))

    assert title not in text
    assert run_in(text)["title"] == title


def test_modules_come_once_each_after_what_they_need(tmp_path, monkeypatch):
    for module in (languages, page_bundle):
        monkeypatch.setattr(module, "WEB", tmp_path)
    (tmp_path / "common").mkdir()
    (tmp_path / "common/style.html").write_text('<link rel="stylesheet" href="s.css">\n')
    (tmp_path / "page.html").write_text('  <!-- common/style.html -->\n<script type="module" src="a.js"></script>')
    (tmp_path / "s.css").write_text("p { margin: 0 }\n")
    (tmp_path / "a.js").write_text('import { b } from "./b.js";\nimport { C, d } from "./c.js";\nb(C, d);\n')
    (tmp_path / "b.js").write_text('import { C } from "./c.js";\nexport const b = C;\n')
    (tmp_path / "c.js").write_text('export class C {}\nexport async function d() { return "</script>"; }\n')

    text = page_bundle.page_of("page.html")
    script = text.partition('<script type="module">')[2].partition("</script>")[0]

    assert "<style>\np{margin:0}</style>" in text
    assert page_bundle.modules_of("a.js") == ["c.js", "b.js", "a.js"]
    assert re.findall(r"\$\[(.+)\] = ", script) == ["0", "1", "2"]
    assert "const { C, d } = $[0];" in script
    assert "return { C, d };" in script
    assert (text.count("</script>"), script.count("</script>")) == (1, 0)
    assert not re.search(r"^(import|export) ", script, re.MULTILINE)


def test_a_module_in_a_folder_finds_what_it_imports_from_there(tmp_path, monkeypatch):
    monkeypatch.setattr(page_bundle, "WEB", tmp_path)
    (tmp_path / "parts").mkdir()
    (tmp_path / "a.js").write_text('import { b } from "./parts/b.js";\nb();\n')
    (tmp_path / "parts/b.js").write_text(
        'import { c } from "./c.js";\nimport { d } from "../d.js";\nexport const b = c + d;\n'
    )
    (tmp_path / "parts/c.js").write_text('import { d } from "../d.js";\nexport const c = d;\n')
    (tmp_path / "d.js").write_text("export const d = 1;\n")

    text = page_bundle.bundle("a.js")

    assert page_bundle.modules_of("a.js") == ["d.js", "parts/c.js", "parts/b.js", "a.js"]
    assert re.findall(r"^\$\[(.+)\] = ", text, re.MULTILINE) == ["0", "1", "2", "3"]
    assert text.count("const { d } = $[0];") == 2
    assert "const { c } = $[1];" in text


@given(st.lists(st.lists(st.integers(-(2**29), 2**29), min_size=3, max_size=3), min_size=1, max_size=5))
def test_columns_come_out_as_they_went_in(columns):
    assert unpacked(pack(columns), len(columns)) == columns


def test_a_reckoned_way_makes_a_page_as_well(kept):
    trajectory: Trajectory = resimulate(kept.log, ignore_world=True).trajectory

    run = run_in(page(run_data(trajectory, "somewhere")))

    assert run["scenes"][0][1]["food"] == []
    assert run["ticks"] == kept.trajectory.ticks


@pytest.mark.parametrize("name", ["nowhere/page.html", "."])
def test_a_page_that_cannot_be_written_is_one_line(short, tmp_path, capsys, name):
    before = set(tmp_path.rglob("*"))
    assert main(["replay", str(short.log), "--html", str(tmp_path / name)]) == 2
    assert set(tmp_path.rglob("*")) == before
    assert re.fullmatch(r"octet: cannot write .*\n", capsys.readouterr().err)


def test_a_page_that_is_written_as_a_file_may_load_nothing():
    text = page_bundle.page_of("octet.html")

    policy = re.search(r'<meta http-equiv="Content-Security-Policy" content="([^"]*)">', text)
    assert policy is not None
    assert policy[1].startswith("default-src 'none'; ")
    assert "http" not in policy[1]
    assert text.index(policy[0]) < text.index("<script")
